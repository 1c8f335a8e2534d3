#include "cli/report/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <tuple>

#include "bench/analyses.hpp"
#include "cli/report/assets.hpp"
#include "cli/report/main_chart.hpp"
#include "cli/report/page.hpp"
#include "cli/report/svg.hpp"
#include "core/build_info.hpp"
#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "core/units.hpp"
#include "core/utf8.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/format/si_units.hpp"
#include "scenarios/output.hpp"
#include "scenarios/scenario_format.hpp"

namespace dualdamp::cli {

namespace {

using Json = StoredRun::Json;

core::SourcePlace place_of(const StoredRun& run) { return {.file = (run.directory() / "result.json").string()}; }

/// A number of a resolved scenario, converted from SI to the unit that the user wrote, if there is one. `si` is
/// empty where the format does not know the key: that of a law whose plugin is not loaded.
std::string with_unit(double value, const std::string& written, const std::string& si) {
  const std::optional<double> factor = written.empty() ? std::nullopt : core::unit_factor(written, si).value;
  const bool has_factor = factor && *factor > 0.0;
  std::string unit = has_factor ? written : si == "1" ? "" : si;
  if (si.empty() && !written.empty()) unit = core::is_si(written) ? written : "in SI";
  return core::format_number(has_factor ? value / *factor : value, 6) + (unit.empty() ? "" : " " + unit);
}

/// The values of a scenario as text, by path. A list of numbers is one value.
/// `written`: the units that the user wrote; `si`: the units of the numbers here.
void flatten(const Json& json, const std::string& path, const Json& written,
             const std::map<std::string, std::string>& si, std::map<std::string, std::string>& values) {
  if (json.is_object()) {
    for (const auto& [key, value] : json.items())
      if (!path.empty() || (key != "title" && key != "expect" && key != "schema"))
        flatten(value, path.empty() ? key : path + "." + key, written, si, values);
  } else if (json.is_array() && !json.empty() && json.front().is_structured()) {
    for (std::size_t i = 0; i < json.size(); ++i)
      flatten(json[i], path + "[" + std::to_string(i) + "]", written, si, values);
  } else if (json.is_number_float()) {
    const auto unit = si.find(path);
    values[path] = with_unit(json.get<double>(), written.value(path, ""), unit == si.end() ? "" : unit->second);
  } else if (json.is_string() && json.get<std::string>().ends_with(" rad/s") && written.contains(path)) {
    const double value = core::read_number(json.get<std::string>()).value.value_or(0.0);
    const auto unit = written.at(path).get<std::string>();
    const auto factor = core::unit_factor(unit, "rad/s").value;
    values[path] = factor ? core::format_number(value / *factor, 6) + " " + unit : json.get<std::string>();
  } else {
    constexpr std::size_t longest = 60;
    values[path] = core::shortened(json.is_string() ? json.get<std::string>() : json.dump(), longest);
  }
}

/// The parts of a result that a comparison needs.
struct Compared {
  std::string directory;
  std::string analysis;
  std::string title;
  std::string started;
  std::string sha256;                         ///< of the resolved scenario
  std::map<std::string, std::string> values;  ///< of the scenario, by path
  std::set<std::string> written;              ///< paths of quantities that the user wrote
  std::set<std::string> swept;                ///< paths of a sweep; its curves state their values
  Chart chart;
  std::string label;  ///< in the legend
};

class Comparison {
 public:
  Comparison(const std::vector<std::string>& directories, const std::string& units) {
    const StoredRun first(directories.front(), units);
    analysis_ = first.document().at("analysis");
    for (const std::string& directory : directories) {
      const StoredRun run(directory);
      run.read([&] { take(run, first); });
    }
    find_differences();
    name_results();
    overlay();
  }

  [[nodiscard]] const Chart& chart() const { return chart_; }

  [[nodiscard]] Json document() const {
    const auto axis = [](const ChartAxis& a) {
      return Json{{"label", a.label}, {"unit", a.unit}, {"log", a.is_log}, {"whole", a.is_whole}};
    };
    Json json = {{"program", {{"name", "dualdamp"}, {"version", core::build_info().version}}},
                 {"analysis", analyses()},
                 {"title", chart_.title},
                 {"chart", {{"x", axis(chart_.x)}, {"y", axis(chart_.y)}, {"series", Json::array()}}},
                 {"results", Json::array()},
                 {"differing", Json::array()}};
    for (const ChartSeries& series : chart_.series) json["chart"]["series"].push_back(series_json(series));
    for (const Compared& one : compared_)
      json["results"].push_back(
          {{"label", one.label}, {"title", one.title}, {"directory", one.directory}, {"started", one.started}});
    for (const std::string& key : differing_) {
      Json list = Json::array();
      for (const Compared& one : compared_) list.push_back(value_of(one, key, "-"));
      json["differing"].push_back({{"key", key}, {"values", std::move(list)}});
    }
    return json;
  }

  void write_csv(std::ostream& out) const {
    const core::BuildInfo build = core::build_info();
    out << "# program: dualdamp " << build.version << "\n# commit: " << build.commit << "\n";
    for (const Compared& one : compared_) out << "# result: " << one.directory << " " << one.sha256 << "\n";
    using scenarios::csv_field;
    const auto heading = [](const ChartAxis& axis) {
      return csv_field(axis.unit.empty() ? axis.label : axis.label + " [" + axis.unit + "]");
    };
    out << "result," << heading(numbers_.x) << "," << heading(numbers_.y) << "\n";
    for (const ChartSeries& series : numbers_.series)
      for (std::size_t i = 0; i < series.x.size(); ++i)
        out << csv_field(series.label) << "," << csv_field(series.x[i]) << "," << csv_field(series.y[i]) << "\n";
  }

 private:
  static Json series_json(const ChartSeries& series) {
    const char* kind = series.kind == SeriesKind::points   ? "points"
                       : series.kind == SeriesKind::dashed ? "dashed"
                                                           : "line";
    return {{"label", series.label},
            {"x", scenarios::finite_or_null(series.x)},
            {"y", scenarios::finite_or_null(series.y)},
            {"kind", kind},
            {"colour", series.colour}};
  }

  void take(const StoredRun& run, const StoredRun& first) {
    const Json& analysis = run.document().at("analysis");
    if (!draws_the_same(analysis, analysis_))
      core::refuse(place_of(run),
                   "this is the result of another analysis than " + (first.directory() / "result.json").string(),
                   analysis_.is_string() ? analysis_.get<std::string>() : "",
                   analysis.is_string() ? analysis.get<std::string>() : "none");
    std::optional<Chart> chart = main_chart(run, first);
    if (!chart) throw core::InputError(without_chart(run));
    if (chart->series.front().kind == SeriesKind::cells)
      core::refuse(place_of(run), "maps cannot be laid over each other", "results with curves");
    if (!compared_.empty() && describe(*chart) != describe(compared_.front().chart))
      core::refuse(place_of(run), "this curve is of other quantities than that of " + first.directory().string(),
                   describe(compared_.front().chart), describe(*chart));
    const Json provenance = run.document().value("provenance", Json::object());
    const Json units = provenance.value("written_units", Json::object());
    Compared one{.directory = shown(run.directory()),
                 .analysis = analysis.is_string() ? analysis.get<std::string>() : "",
                 .title = title_of(run),
                 .started = provenance.value("started", ""),
                 .sha256 = provenance.value("scenario_sha256", "")};
    const Json& scenario = run.document().at("scenario");
    const auto si = scenarios::si_units(scenario, scenarios::scenario_format(bench::analyses()));
    flatten(scenario, "", units, si, one.values);
    const Json sweep = scenario.value("sweep", Json::object());
    for (const auto& [key, values] : sweep.items()) {
      one.swept.insert(key);
      one.values[key] = "swept";
    }
    for (const auto& [path, unit] : units.items()) one.written.insert(path);
    one.chart = std::move(*chart);
    compared_.push_back(std::move(one));
  }

  /// Whether both analyses are one, or draw the same quantities: the points of a response lie on its branch.
  static bool draws_the_same(const Json& a, const Json& b) {
    if (a == b) return true;
    if (!a.is_string() || !b.is_string()) return false;
    const auto* first = scenarios::find_analysis(bench::analyses(), a.get<std::string>());
    const auto* second = scenarios::find_analysis(bench::analyses(), b.get<std::string>());
    if (first == nullptr || second == nullptr || first->chart.x.empty()) return false;
    const auto drawn = [](const scenarios::MainChart& chart) {
      return std::tie(chart.x, chart.y, chart.x_label, chart.y_label, chart.kind);
    };
    return drawn(first->chart) == drawn(second->chart);
  }

  /// Of the results, each once: "xy_curve, xy_branch".
  [[nodiscard]] std::string analyses() const {
    std::vector<std::string> names;
    for (const Compared& one : compared_)
      if (std::ranges::find(names, one.analysis) == names.end()) names.push_back(one.analysis);
    return core::joined(names);
  }

  static std::string describe(const Chart& chart) {
    const auto axis = [](const ChartAxis& a) { return a.label + (a.unit.empty() ? "" : " [" + a.unit + "]"); };
    return axis(chart.y) + " over " + axis(chart.x);
  }

  static std::string value_of(const Compared& one, const std::string& key, const char* otherwise) {
    const auto found = one.values.find(key);
    return found == one.values.end() ? otherwise : found->second;
  }

  void find_differences() {
    std::set<std::string> keys;
    for (const Compared& one : compared_)
      for (const auto& [key, value] : one.values) keys.insert(key);
    for (const std::string& key : keys)
      if (std::ranges::any_of(compared_, [&](const Compared& one) {
            return value_of(one, key, "") != value_of(compared_.front(), key, "");
          }))
        differing_.push_back(key);
  }

  /// Of the keys that differ, those that a user wrote. Others follow from them, as static friction from kinetic.
  [[nodiscard]] std::vector<std::string> telling_keys() const {
    std::vector<std::string> keys;
    for (const std::string& key : differing_)
      if (std::ranges::any_of(compared_, [&](const Compared& one) { return one.written.contains(key); }))
        keys.push_back(key);
    return keys.empty() ? differing_ : keys;
  }

  [[nodiscard]] bool are_distinct() const {
    std::set<std::string> labels;
    for (const Compared& one : compared_) labels.insert(one.label);
    return labels.size() == compared_.size();
  }

  void name_results() {
    for (Compared& one : compared_) one.label = one.title;
    if (are_distinct()) return;
    constexpr std::size_t most_keys = 3;
    const std::vector<std::string> keys = telling_keys();
    if (!keys.empty() && keys.size() <= most_keys)
      for (Compared& one : compared_) {
        one.label.clear();
        for (const std::string& key : keys)
          if (!one.swept.contains(key))
            one.label += (one.label.empty() ? "" : ", ") + key.substr(key.rfind('.') + 1) + " = " +
                         value_of(one, key, "none");
        if (one.label.empty()) one.label = "sweep";
      }
    if (are_distinct()) return;
    std::map<std::string, int> times;
    for (Compared& one : compared_) {
      one.label = one.directory;
      // The same directory may be named twice.
      if (const int time = ++times[one.directory]; time > 1) one.label += " (" + std::to_string(time) + ")";
    }
  }

  void overlay() {
    chart_.x = compared_.front().chart.x;
    chart_.y = compared_.front().chart.y;
    const bool has_one_title =
        std::ranges::all_of(compared_, [&](const Compared& one) { return one.title == compared_.front().title; });
    chart_.title =
        has_one_title ? compared_.front().title : "Comparison of " + std::to_string(compared_.size()) + " results";
    int colour = 0;
    for (const Compared& one : compared_)
      if (!one.chart.note.empty()) chart_.title += "; " + one.label + ": " + one.chart.note;
    const bool share_data = have_the_same_data();
    for (Compared& one : compared_) {
      const bool has_several = one.chart.series.size() > 1;
      bool is_first = true;
      for (ChartSeries& series : one.chart.series) {
        if (series.is_measured && share_data) {
          if (colour == 0) chart_.series.push_back(std::move(series));
          continue;
        }
        series.label = has_several ? one.label + ", " + series.label : one.label;
        series.colour = colour;
        if (!is_first && series.kind == SeriesKind::line) series.kind = SeriesKind::dashed;
        is_first = false;
        chart_.series.push_back(std::move(series));
      }
      ++colour;
    }
    numbers_ = chart_;
    make_readable(chart_);
  }

  /// Whether all results have the same measured points, as fits of several laws to one record.
  [[nodiscard]] bool have_the_same_data() const {
    const auto data_of = [](const Compared& one) {
      const auto found = std::ranges::find(one.chart.series, true, &ChartSeries::is_measured);
      return found == one.chart.series.end() ? nullptr : &*found;
    };
    const ChartSeries* first = data_of(compared_.front());
    const auto are_equal = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    return first != nullptr && std::ranges::all_of(compared_, [&](const Compared& one) {
             const ChartSeries* data = data_of(one);
             return data != nullptr && std::ranges::equal(data->x, first->x, are_equal) &&
                    std::ranges::equal(data->y, first->y, are_equal);
           });
  }

  Json analysis_;  ///< its name
  std::vector<Compared> compared_;
  std::vector<std::string> differing_;  ///< paths
  Chart numbers_;                       ///< in the units that are stated, else in SI
  Chart chart_;                         ///< in readable units
};

}  // namespace

std::vector<scenarios::OutputFile> comparison(const std::vector<std::string>& directories,
                                              const std::string& units) {
  const auto compared = std::make_shared<const Comparison>(directories, units);
  return {{"compare.csv", [compared](std::ostream& out) { compared->write_csv(out); }},
          {"compare.svg", [compared](std::ostream& out) { write_svg(out, compared->chart()); }},
          {"compare.html", [compared](std::ostream& out) {
             write_page(out, compared->document(), Json::object(), {assets::compare_js});
           }}};
}

}  // namespace dualdamp::cli
