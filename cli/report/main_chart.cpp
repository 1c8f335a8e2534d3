#include "cli/report/main_chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <ranges>
#include <set>

#include "bench/analyses.hpp"
#include "cli/report/overlay.hpp"
#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "scenarios/format/excitations.hpp"
#include "scenarios/results/shown_units.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::cli {

namespace {

using Json = StoredRun::Json;
using scenarios::MainChart;
using scenarios::ShownUnit;

/// The units in which a run's numbers are shown.
scenarios::ShownUnits shown_units_of(const StoredRun& run) { return scenarios::shown_units(written_units(run)); }

/// The prefix for numbers up to `largest`: 0.004 m becomes 4 mm.
ShownUnit readable(const std::string& unit, double largest) {
  constexpr std::array scalable = {"m", "m/s", "s", "N", "N.m", "J"};
  constexpr std::array<std::pair<double, const char*>, 4> prefixes = {
      {{1.0, ""}, {1e-3, "m"}, {1e-6, "u"}, {1e-9, "n"}}};
  if (std::ranges::find(scalable, unit) == scalable.end() || !(largest > 0.0)) return {unit, 1.0};
  for (const auto& [size, prefix] : prefixes)
    if (largest >= size) return {prefix + unit, 1.0 / size};
  return {unit, 1.0};
}

double largest_of(const std::vector<ChartSeries>& series, std::vector<double> ChartSeries::* list) {
  double largest = 0.0;
  for (const ChartSeries& one : series)
    for (const double value : one.*list)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

std::vector<double> all_of(const std::vector<ChartSeries>& series, std::vector<double> ChartSeries::* list) {
  std::vector<double> all;
  for (const ChartSeries& one : series) all.insert(all.end(), (one.*list).begin(), (one.*list).end());
  return all;
}

/// A column that every run writes. Throws `ChangedResult` if the table was changed.
const StoredColumn& needed(const StoredTable& table, const std::string& name) {
  const StoredColumn* column = table.find(name);
  if (column == nullptr) throw ChangedResult("a table has no column '" + name + "'");
  return *column;
}

/// The rows with one value of a column, in order.
struct Group {
  std::string label;
  Rows rows;
};

std::vector<Group> groups_of(const StoredTable& table, std::string_view by) {
  const StoredColumn* column = by.empty() ? nullptr : table.find(by);
  std::vector<Group> groups;
  if (column == nullptr) return groups;
  const auto label_of = [&](std::size_t row) {
    if (column->is_text || column->name != "stable") return column->texts[row];
    return std::string(column->numbers[row] == 1.0 ? "attracts" : "does not attract");
  };
  std::map<std::string, std::size_t> numbers;
  for (std::size_t row = 0; row < column->texts.size(); ++row) {
    const auto [entry, is_new] = numbers.emplace(label_of(row), groups.size());
    if (is_new) groups.push_back({entry->first, {}});
    groups[entry->second].rows.push_back(row);
  }
  return groups;
}

Rows rows_of(const StoredColumn& column) {
  Rows rows(column.numbers.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return rows;
}

/// The lines of rows that follow each other.
std::vector<Rows> runs_of(const Rows& rows) {
  std::vector<Rows> lines;
  for (const std::size_t row : rows) {
    if (lines.empty() || row != lines.back().back() + 1) lines.emplace_back();
    lines.back().push_back(row);
  }
  return lines;
}

/// What the axis of a column of measured and computed curves shows.
std::string label_of_axis(const std::string& column) {
  static const std::map<std::string, std::string> labels = {
      {"t", "time t"}, {"Y", "input amplitude Y"}, {"omega", "frequency"}, {"x", "displacement x"}};
  const auto found = labels.find(column);
  return found == labels.end() ? column : found->second;
}

/// Empty if the document is that of a scenario that was refused.
std::string name_of_analysis(const StoredRun& run) {
  const Json& analysis = run.document().at("analysis");
  return analysis.is_string() ? analysis.get<std::string>() : std::string();
}

std::vector<std::string> swept_keys(const StoredRun& run) {
  const Json& sweep = run.document().at("scenario").at("sweep");
  if (!sweep.is_object() || sweep.empty()) throw ChangedResult("the scenario of a sweep says what is swept");
  std::vector<std::string> keys;
  for (const auto& [key, values] : sweep.items()) keys.push_back(key);
  return keys;
}

/// The points whose curves are drawn, at most twelve: evenly spaced values of each key, all of them combined.
std::set<std::size_t> points_drawn(const StoredRun& run) {
  constexpr std::size_t most = 12;
  constexpr std::size_t most_of_shorter = 3;
  std::vector<std::size_t> counts;
  for (const std::string& key : swept_keys(run))
    counts.push_back(std::max<std::size_t>(run.document()["scenario"]["sweep"][key].size(), 1));
  counts.resize(2, 1);
  std::vector<std::size_t> taken = counts;
  if (counts[0] * counts[1] > most) {
    const std::size_t shorter = counts[0] < counts[1] ? 0 : 1;
    taken[shorter] = std::min(counts[shorter], most_of_shorter);
    taken[1 - shorter] = std::min(counts[1 - shorter], most / taken[shorter]);
  }
  const auto place = [&](std::size_t key, std::size_t i) {  // the i-th value that is taken
    const std::size_t gaps = taken[key] - 1;
    return gaps == 0 ? 0 : (2 * i * (counts[key] - 1) + gaps) / (2 * gaps);
  };
  std::set<std::size_t> drawn;
  for (std::size_t i = 0; i < taken[0]; ++i)
    for (std::size_t j = 0; j < taken[1]; ++j) drawn.insert(place(0, i) * counts[1] + place(1, j));
  return drawn;
}

class ChartMaker {
 public:
  ChartMaker(const StoredRun& run, const StoredRun& other)
      : run_(run),
        units_(shown_units_of(other)),
        analysis_(scenarios::find_analysis(bench::analyses(), name_of_analysis(run))) {}

  std::optional<Chart> make() {
    const Json& result = run_.document().at("result");
    if (analysis_ == nullptr || !result.is_object()) return std::nullopt;
    chart_.title = title_of(run_);
    const bool is_made = result.contains("sweep") ? sweep() : ordinary();
    if (!is_made || chart_.series.empty()) return std::nullopt;
    return std::move(chart_);
  }

 private:
  [[nodiscard]] std::string unit_of(const StoredColumn& column) const {
    if (!column.unit.empty() || analysis_->chart.list.empty()) return column.unit;
    const std::string path = std::string(analysis_->chart.list) + "[]." + column.name;
    const Json units = run_.document().value("units", Json::object());
    if (units.contains(path)) return units.at(path).get<std::string>();
    const auto field = std::ranges::find(analysis_->results, path, &scenarios::ResultField::path);
    if (field == analysis_->results.end() || field->unit == "1") return {};
    if (field->unit != scenarios::unit_of_drive) return field->unit;
    const Json excitation = run_.document().at("scenario").value("excitation", Json::object());
    return scenarios::moves_base(excitation.value("type", "")) ? "m" : "N";
  }

  /// Converts numbers in SI to the unit that is shown.
  void show(ChartAxis& axis, const StoredColumn& column, std::vector<double> ChartSeries::* list) {
    const std::string unit = unit_of(column);
    axis.unit = unit;
    const auto shown = units_.find(scenarios::kind_of(unit, column.name));
    if (shown == units_.end()) return;
    axis.unit = shown->second.unit;
    axis.written_for = {unit, shown->second.factor};
    axis.is_asked = shown->second.is_asked;
    for (ChartSeries& series : chart_.series)
      for (double& value : series.*list) value *= shown->second.factor;
  }

  /// Adds a series with a gap between its lines.
  void add(std::string label, const StoredColumn& x, const StoredColumn& y, SeriesKind kind,
           const std::vector<Rows>& lines) {
    ChartSeries series{.label = std::move(label), .kind = kind, .colour = static_cast<int>(chart_.series.size())};
    for (const Rows& line : lines) {
      if (!series.x.empty()) {
        series.x.push_back(scenarios::none);
        series.y.push_back(scenarios::none);
      }
      for (const std::size_t row : line) {
        series.x.push_back(x.numbers[row]);
        series.y.push_back(y.numbers[row]);
      }
    }
    chart_.series.push_back(std::move(series));
  }

  static SeriesKind kind_of(MainChart::Kind kind) {
    return kind == MainChart::Kind::cells    ? SeriesKind::cells
           : kind == MainChart::Kind::points ? SeriesKind::points
                                             : SeriesKind::line;
  }

  bool ordinary() {
    const MainChart& spec = analysis_->chart;
    if (!spec.overlay.empty()) return overlay();
    const StoredTable table = spec.table.empty() ? run_.list(spec.list) : run_.table(spec.table);
    if (spec.x.empty()) return first_columns();
    const StoredColumn* x = table.find(spec.x);
    const bool is_otherwise = x == nullptr && !spec.x_otherwise.empty();
    if (is_otherwise) x = table.find(spec.x_otherwise);
    const StoredColumn* y = table.find(spec.y);
    if (x == nullptr || y == nullptr) return false;
    chart_.x.label = is_otherwise ? std::string(spec.x_otherwise) : std::string(spec.x_label);
    chart_.x.is_whole = is_otherwise;
    chart_.y.label = std::string(spec.y_label);
    const std::vector<Group> groups = groups_of(table, spec.by);
    const bool is_line = spec.kind == MainChart::Kind::line;
    for (const Group& group : groups)
      add(group.label, *x, *y, kind_of(spec.kind),
          is_line ? lines_of(*x, group.rows) : std::vector<Rows>{group.rows});
    if (groups.empty()) add(y->name, *x, *y, kind_of(spec.kind), {ordered(*x, rows_of(*x))});
    if (const StoredColumn* further = spec.further.empty() ? nullptr : table.find(spec.further))
      add(further->name, *x, *further, spec.kind == MainChart::Kind::points ? SeriesKind::line : SeriesKind::dashed,
          {ordered(*x, rows_of(*x))});
    finish(*x, *y);
    return true;
  }

  /// The measured points of the first record, and the curve that was computed for them.
  bool overlay() {
    const std::optional<Overlay> found = overlay_of(run_, analysis_->chart.overlay);
    if (!found) return false;
    const StoredColumn& x = needed(found->table, found->x);
    StoredColumn measured = needed(found->table, "measured");
    measured.name = found->signal;  // it says what a unit is of
    add("measured", x, measured, found->is_dense ? SeriesKind::line : SeriesKind::points, found->lines);
    chart_.series.back().colour = colour_of_data;
    chart_.series.back().is_measured = true;
    add(found->computed, x, needed(found->table, found->computed),
        found->is_dense ? SeriesKind::dashed : SeriesKind::line, found->lines);
    chart_.series.back().colour = 0;
    if (found->records > 1) chart_.note = "the first of " + std::to_string(found->records) + " records";
    chart_.x.label = label_of_axis(found->x);
    chart_.x.is_whole = found->x == "number";
    const bool is_amplitude = found->x == "Y" || found->x == "omega";
    chart_.y.label = is_amplitude ? "output amplitude x" : label_of_axis(found->signal);
    finish(x, measured);
    return true;
  }

  /// Rows as a line joins them.
  [[nodiscard]] Rows ordered(const StoredColumn& x, Rows rows) const {
    return analysis_->chart.is_by_x ? in_order_of(x, std::move(rows)) : std::move(rows);
  }

  /// The lines of a group: one in the order of x, or those of rows that follow each other.
  [[nodiscard]] std::vector<Rows> lines_of(const StoredColumn& x, const Rows& rows) const {
    return analysis_->chart.is_by_x ? std::vector<Rows>{in_order_of(x, rows)} : runs_of(rows);
  }

  void finish(const StoredColumn& x, const StoredColumn& y) {
    chart_.x.is_log = is_geometric(all_of(chart_.series, &ChartSeries::x));
    chart_.y.is_log =
        chart_.series.front().kind == SeriesKind::cells && is_geometric(all_of(chart_.series, &ChartSeries::y));
    show(chart_.x, x, &ChartSeries::x);
    show(chart_.y, y, &ChartSeries::y);
  }

  /// The chart of an analysis that names none: the first two columns of numbers of its first table.
  bool first_columns() {
    for (const std::filesystem::path& path : run_.tables()) {
      const StoredTable table = run_.table(path.stem().string());
      std::vector<const StoredColumn*> numbers;
      for (const StoredColumn& column : table.columns)
        if (!column.is_text) numbers.push_back(&column);
      if (numbers.size() < 2) continue;
      chart_.x.label = numbers[0]->name;
      chart_.y.label = numbers[1]->name;
      add(numbers[1]->name, *numbers[0], *numbers[1], SeriesKind::line, {rows_of(*numbers[0])});
      finish(*numbers[0], *numbers[1]);
      return true;
    }
    return false;
  }

  /// `point`: number of the point in the table of curves.
  [[nodiscard]] std::string label_of(const StoredTable& sweep, const std::string& point) const {
    std::string label;
    for (const std::string& key : swept_keys(run_)) {
      const StoredColumn& column = needed(sweep, key);
      const double row = core::parse_number(point).value.value_or(-1.0);
      if (!(row >= 0.0 && row < static_cast<double>(column.numbers.size())))
        throw ChangedResult("the sweep has no point " + point);
      label += (label.empty() ? "" : ", ") + key.substr(key.rfind('.') + 1) + " = " +
               core::format_number(column.numbers[static_cast<std::size_t>(row)], 6) +
               (column.unit.empty() ? "" : " " + column.unit);
    }
    return label;
  }

  /// The chart of a sweep: the curves of its points, or a number over a swept key.
  bool sweep() {
    const StoredTable points = run_.table("sweep");
    if (points.columns.empty()) return false;
    const std::optional<SweptCurves> drawn = swept_curves(run_);
    if (!drawn) return numbers(points);
    const StoredTable rows = run_.table(drawn->table);
    const StoredColumn* x = rows.find(drawn->x);
    const StoredColumn* y = rows.find(drawn->y);
    return x != nullptr && y != nullptr ? curves(points, drawn->points, rows, *x, *y) : numbers(points);
  }

  /// A selection of the curves, if there are many.
  bool curves(const StoredTable& points, const std::set<std::size_t>& drawn, const StoredTable& rows,
              const StoredColumn& x, const StoredColumn& y) {
    const std::vector<Group> all = groups_of(rows, "point");
    for (const Group& group : all) {
      std::string label = label_of(points, group.label);
      if (drawn.contains(static_cast<std::size_t>(*core::parse_number(group.label).value)))
        add(std::move(label), x, y, SeriesKind::line, {ordered(x, group.rows)});
    }
    if (const std::size_t shown = chart_.series.size(); shown < all.size())
      chart_.note = std::to_string(shown) + " of " + std::to_string(all.size()) + " curves";
    chart_.x.label = std::string(analysis_->chart.x_label);
    chart_.y.label = std::string(analysis_->chart.y_label);
    finish(x, y);
    return true;
  }

  bool numbers(const StoredTable& points) {
    const std::vector<std::string> keys = swept_keys(run_);
    for (const std::string& key : keys) static_cast<void>(needed(points, key));
    static_cast<void>(needed(points, "status"));
    const auto answers = points.columns | std::views::drop(keys.size() + 1);
    const auto y = std::ranges::find(answers, false, &StoredColumn::is_text);
    if (y == answers.end()) return false;
    const StoredColumn& x = needed(points, keys.front());
    chart_.x.label = x.name;
    chart_.y.label = y->name;
    for (const Group& group : keys.size() == 2 ? groups_of(points, keys.back()) : std::vector<Group>()) {
      const StoredColumn& other = needed(points, keys.back());
      add(keys.back().substr(keys.back().rfind('.') + 1) + " = " +
              core::format_number(other.numbers[group.rows.front()], 6) +
              (other.unit.empty() ? "" : " " + other.unit),
          x, *y, SeriesKind::line, {in_order_of(x, group.rows)});
    }
    if (chart_.series.empty()) add(y->name, x, *y, SeriesKind::line, {in_order_of(x, rows_of(x))});
    chart_.x.is_log = is_geometric(x.numbers);
    chart_.x.unit = x.unit;
    chart_.x.written_for = {x.unit, 1.0};
    StoredColumn with_unit = *y;
    if (y->unit.empty()) with_unit.unit = unit_beside(points, y->name);
    show(chart_.y, with_unit, &ChartSeries::y);
    return true;
  }

  /// The unit of a number that a text beside it names, the same in all rows that have one.
  static std::string unit_beside(const StoredTable& points, const std::string& name) {
    const StoredColumn* texts = points.find(name.substr(0, name.rfind('.') + 1) + "unit");
    std::set<std::string> units;
    if (texts != nullptr) units = {texts->texts.begin(), texts->texts.end()};
    units.erase("");
    return units.size() == 1 ? *units.begin() : std::string();
  }

  const StoredRun& run_;
  scenarios::ShownUnits units_;
  const scenarios::Analysis* analysis_;
  Chart chart_;
};

}  // namespace

std::optional<SweptCurves> swept_curves(const StoredRun& run) {
  const scenarios::Analysis* analysis = scenarios::find_analysis(bench::analyses(), name_of_analysis(run));
  if (analysis == nullptr || analysis->chart.list.empty() || analysis->chart.kind != MainChart::Kind::line)
    return std::nullopt;
  return SweptCurves{.table = "sweep_" + std::string(analysis->chart.list),
                     .x = std::string(analysis->chart.x),
                     .y = std::string(analysis->chart.y),
                     .is_by_x = analysis->chart.is_by_x,
                     .points = points_drawn(run)};
}

std::optional<Chart> main_chart(const StoredRun& run, const StoredRun& units_of) {
  return ChartMaker(run, units_of).make();
}

void make_readable(Chart& chart) {
  const auto scale = [&](ChartAxis& axis, std::vector<double> ChartSeries::* list) {
    double factor = 1.0;
    if (axis.written_for) {
      const auto& [unit, written] = *axis.written_for;
      const double largest = largest_of(chart.series, list) / written;
      if (axis.unit == unit || scenarios::is_legible(largest, {axis.unit, written, axis.is_asked})) return;
      axis.unit = unit;
      factor = 1.0 / written;
    }
    const ShownUnit shown = readable(axis.unit, factor * largest_of(chart.series, list));
    axis.unit = shown.unit;
    factor *= shown.factor;
    for (ChartSeries& series : chart.series)
      for (double& value : series.*list) value *= factor;
  };
  scale(chart.x, &ChartSeries::x);
  scale(chart.y, &ChartSeries::y);
}

core::Diagnostic without_chart(const StoredRun& run) {
  core::Diagnostic problem;
  problem.place.file = (run.directory() / "result.json").string();
  problem.message = "the result of analysis '" + name_of_analysis(run) + "' has no chart";
  const scenarios::Analysis* analysis = scenarios::find_analysis(bench::analyses(), name_of_analysis(run));
  const Json& result = run.document().at("result");
  if (analysis == nullptr || !result.is_object()) return problem;
  const std::string table = result.contains("sweep") ? "sweep" : std::string(analysis->chart.table);
  if (table.empty() || !run.table(table).columns.empty()) return problem;
  problem.allowed = "a result with " + table + ".csv of the same run beside it";
  if (table == analysis->chart.table && !analysis->chart.key.empty())
    problem.allowed += ", which needs the key " + std::string(analysis->chart.key);
  return problem;
}

Chart main_chart(const std::string& directory, const std::string& units) {
  const StoredRun run(directory, units);
  std::optional<Chart> chart;
  run.read([&] { chart = main_chart(run, run); });
  if (chart) {
    make_readable(*chart);
    return std::move(*chart);
  }
  throw core::InputError(without_chart(run));
}

std::string title_of(const StoredRun& run) {
  const Json& scenario = run.document().at("scenario");
  if (scenario.is_object() && scenario.contains("title")) return scenario.at("title").get<std::string>();
  return shown(run.directory().filename());
}

}  // namespace dualdamp::cli
