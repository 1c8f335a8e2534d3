#include "scenarios/sweep/sweep.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <tuple>

#include "core/cancellation.hpp"
#include "core/numbers.hpp"
#include "friction_models/registry.hpp"
#include "scenarios/check_expectations.hpp"
#include "scenarios/format/checked_file.hpp"
#include "scenarios/format/limits.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/sweep/points.hpp"
#include "scenarios/sweep/question.hpp"

namespace dualdamp::scenarios {

namespace {

/// Problems of points; a problem of several points is reported once.
class Problems {
 public:
  void add(std::size_t point, const core::Diagnostic& problem) {
    const auto [entry, is_new] = known_.emplace(
        std::tuple(problem.place.file, problem.place.line, problem.place.column, problem.message), found_.size());
    if (is_new) found_.push_back({problem, point, 0});
    // Values of a grid have the place of the grid, so each counts as a separate problem.
    ++found_[entry->second].points;
  }

  [[nodiscard]] bool empty() const { return found_.empty(); }

  [[nodiscard]] std::vector<core::Diagnostic> take(std::size_t points, const std::vector<SweptColumn>& columns) {
    std::vector<core::Diagnostic> result;
    for (Found& one : found_) {
      if (one.points < points) {
        one.problem.message = "with " + describe_point(columns, one.first) + ": " + one.problem.message;
        if (one.points > 1) one.problem.message += " (so at " + std::to_string(one.points) + " points)";
      }
      if (result.size() < max_reported) result.push_back(std::move(one.problem));
    }
    return result;
  }

 private:
  struct Found {
    core::Diagnostic problem;
    std::size_t first = 0;
    std::size_t points = 0;
  };

  std::map<std::tuple<std::string, int, int, std::string>, std::size_t> known_;
  std::vector<Found> found_;
};

/// Reads and checks all points.
class Sweep {
 public:
  Sweep(SweepPoints points, const LoadOptions& options)
      : points_(std::move(points)), options_(options), columns_(points_.columns()) {}

  /// The scenario of the whole sweep; `expect`: its expected values.
  Scenario scenario(std::optional<Entry> expect) {
    refuse_sections();
    for (std::size_t point = 0; point < points_.size(); ++point) {
      core::stop_if_cancelled();
      try {
        check(point);
      } catch (const core::InputError& error) {
        for (const core::Diagnostic& problem : error.diagnostics()) problems_.add(point, problem);
      }
      // Here and not after the last point, because reading thousands of points with a million rows each takes half
      // a minute.
      if (problems_.empty()) check_size(point + 1);
    }
    if (!problems_.empty()) throw_sorted(problems_.take(points_.size(), columns_), points_.name());
    return whole(std::move(expect));
  }

 private:
  void complain(std::size_t point, Place place, std::string message, std::string allowed = {},
                std::string found = {}) {
    problems_.add(point,
                  {points_.base().locate(place), std::move(message), std::move(allowed), std::move(found), {}});
  }

  [[nodiscard]] core::Diagnostic no_number(const SweptKey& key) const {
    return {points_.base().locate(key.place),
            "'" + key.path + "' is no number of this scenario",
            "a key whose value is a number",
            {},
            {}};
  }

  /// Whether the file states a map or a list at this path.
  static bool is_section(const Node& root, std::string_view path) {
    const Node* node = &root;
    while (!path.empty()) {
      const std::size_t end = std::min(path.find('.'), path.size());
      const Entry* entry = node->find(path.substr(0, end));
      if (entry == nullptr) return false;
      node = &entry->value;
      path.remove_prefix(std::min(end + 1, path.size()));
    }
    return node->kind == Node::Kind::map || node->kind == Node::Kind::sequence;
  }

  /// A number in the place of a section would only be reported by the keys that are missing then.
  void refuse_sections() const {
    std::vector<core::Diagnostic> problems;
    for (const SweptKey& key : points_.swept().keys)
      if (is_section(points_.base().root(), key.path)) problems.push_back(no_number(key));
    if (!problems.empty()) throw_sorted(std::move(problems), points_.name());
  }

  void check(std::size_t point) {
    const Document document = points_.document(point);
    Reading reading = read(document, points_.format());
    const bool is_fine = reading.problems.empty();
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const SweptKey& key = points_.swept().keys[i];
      const std::optional<double> value = number_at(reading, key.path);
      if (value) columns_[i].si.push_back(*value);
      if (!value && is_fine) problems_.add(point, no_number(key));
    }
    if (point > 0 && is_fine && !first_values_.is_null())
      keep_common(first_values_, reading.values, reading.places, "");
    Json values = point == 0 ? reading.values : Json();
    Scenario scenario = points_.scenario(document, std::move(reading));
    rows_ += scenario.result_rows;
    if (dynamic_cast<const Campaign*>(scenario.question.get()) != nullptr)
      complain(point, points_.swept().place,
               "analysis '" + scenario.analysis_name + "' cannot be swept: it is a campaign with a grid of its own",
               "any other analysis");
    if (point == 0) {
      first_ = std::move(scenario);
      first_values_ = std::move(values);
    }
  }

  /// The number that was read at a path; nothing if there is none.
  static std::optional<double> number_at(const Reading& reading, const std::string& path) {
    if (!reading.places.contains(path)) return std::nullopt;
    const Json* value = find_value(reading.values, path);
    if (value == nullptr) return std::nullopt;
    const bool is_frequency = value->is_string() && value->get<std::string>().ends_with(" rad/s");
    if (!value->is_number() && !is_frequency) return std::nullopt;
    return number(*value);
  }

  void check_size(std::size_t points) const {
    if (static_cast<double>(rows_) > max_points)
      throw core::InputError(
          core::Diagnostic{points_.base().locate(points_.swept().place),
                           "the results of the sweep are too long",
                           "lists of at most " + core::format_number(max_points, 7) + " items together",
                           std::to_string(rows_) + " items at " + std::to_string(points) + " of " +
                               std::to_string(points_.size()) + " points",
                           {}});
  }

  /// Removes values that differ between points although the file does not state them: defaults that follow a swept
  /// key, as `static` follows `kinetic`. Each point fills them in again.
  static void keep_common(Json& first, const Json& other, const std::map<std::string, Place>& stated,
                          const std::string& path) {
    if (first.is_array() && other.is_array())
      for (std::size_t i = 0; i < std::min(first.size(), other.size()); ++i)
        keep_common(first[i], other[i], stated, path + "[" + std::to_string(i) + "]");
    if (!first.is_object() || !other.is_object()) return;
    std::vector<std::string> followers;
    for (auto& [key, value] : first.items()) {
      const std::string place = path.empty() ? key : path + "." + key;
      const bool is_same = other.contains(key) && other.at(key) == value;
      if (is_same) continue;
      if (stated.contains(place))
        keep_common(value, other.value(key, Json()), stated, place);
      else
        followers.push_back(key);
    }
    for (const std::string& key : followers) first.erase(key);
  }

  /// The file as it was read, the first point's values in it and the swept ones beside them: words such as
  /// `natural` are kept, because they mean another number at another point.
  [[nodiscard]] Json resolved(const Json& expect) const {
    Json values = first_values_;
    const Json first = Json::parse(first_.resolved);
    if (first.contains("system") && first.at("system").contains("coordinate"))
      values["system"]["coordinate"] = first.at("system").at("coordinate");
    for (const SweptKey& key : points_.swept().keys)
      for (const Node& value : key.values) {
        const bool is_bare = key.unit.empty();
        values["sweep"][key.path].push_back(is_bare ? Json(*core::read_number(value.text).value)
                                                    : Json(value.text));
      }
    if (!expect.is_null()) values["expect"] = expect;
    if (values.contains("system"))
      put_in_order(values["system"], points_.format().find("system")->choice->variants.front().section);
    put_in_order(values, points_.format());
    return values;
  }

  Scenario whole(std::optional<Entry> expect) {
    const std::vector<ResultField> fields = first_.result_fields;
    first_.result_fields = fields_of_sweep(fields);
    for (const SweptColumn& key : columns_)
      first_.result_fields.push_back({"sweep[].values." + key.path, "", "value of the swept key, SI"});
    first_.warnings.clear();  // each point has separate warnings
    first_.verify = false;    // each point is verified separately
    Json expected;
    if (expect) first_.expect = expectations_of(std::move(*expect), expected);
    first_.resolved = resolved(expected).dump();
    std::string inputs;
    for (const std::string& sum : first_.data_sha256) inputs += " " + sum;
    for (const friction::LawEntry& law : friction::laws())
      if (law.plugin) inputs += " " + law.plugin->sha256;
    std::vector<std::string_view> main = find_analysis(options_.analyses, first_.analysis_name)->main;
    first_.question = std::make_shared<SweepQuestion>(std::move(points_), std::move(columns_), fields,
                                                      std::move(main), std::move(inputs));
    return std::move(first_);
  }

  /// The section `expect` is about the result of the sweep.
  std::vector<Expectation> expectations_of(Entry expect, Json& values) {
    Node root = points_.base().root();
    root.entries = {std::move(expect)};
    const Document document = points_.base().part(std::move(root));
    const Section format = {{*points_.format().find("expect")}};
    Reading reading = read(document, format);
    const std::vector<Needs> none_needed;
    const DataTexts no_texts;
    CheckedFile file(document, reading, format, none_needed, {.texts = no_texts});
    check_expectations(file, {first_.result_fields, "a sweep of analysis '" + first_.analysis_name + "'",
                              [&](std::string_view list) {
                                return list == "sweep" ? std::optional(points_.size()) : std::nullopt;
                              }});
    if (!reading.problems.empty()) throw_sorted(std::move(reading.problems), points_.name());
    if (!reading.values.contains("expect")) return {};
    values = reading.values.at("expect");
    return expectations(reading.values, document, reading);
  }

  SweepPoints points_;
  const LoadOptions& options_;
  std::vector<SweptColumn> columns_;
  Problems problems_;
  std::size_t rows_ = 0;
  Scenario first_;
  Json first_values_;
};

}  // namespace

Scenario swept_scenario(Document document, const std::string& name, const LoadOptions& options) {
  std::vector<core::Diagnostic> problems = document.problems();
  std::optional<SweptKeys> swept = take_swept_keys(document, problems);
  std::optional<Entry> expect = document.take("expect");
  const Place place = swept->place;
  for (const SweptKey& key : swept->keys)
    if (auto earlier = document.assigned(key.path))
      problems.push_back({document.locate(key.place),
                          "'" + key.path + "' is swept, and an option states it",
                          "a value of each point, or the option",
                          std::move(*earlier),
                          {}});
  if (!problems.empty()) throw_sorted(std::move(problems), name);
  SweepPoints points(std::move(document), std::move(*swept), name, options);
  if (static_cast<double>(points.size()) > max_swept)
    throw core::InputError(core::Diagnostic{points.base().locate(place),
                                            "the sweep has too many points",
                                            "at most " + core::format_number(max_swept, 6),
                                            std::to_string(points.size()),
                                            {}});
  return Sweep(std::move(points), options).scenario(std::move(expect));
}

}  // namespace dualdamp::scenarios
