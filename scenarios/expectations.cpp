#include "scenarios/expectations.hpp"

#include <cmath>

#include "core/numbers.hpp"
#include "scenarios/check_expectations.hpp"
#include "scenarios/format/values.hpp"

namespace dualdamp::scenarios {

namespace {

/// The cell at `points[0].x` of the table `points`; nothing when there is no such cell.
std::optional<Json> find(const Table& table, const std::string& path) {
  const auto place = parse_result_path(path);
  if (!place || place->indices.size() != 1 || place->indices.front() >= table.size()) return std::nullopt;
  for (const Column& column : table.columns) {
    if (place->pattern != table.key + "[]." + column.name) continue;
    const std::string cell = json_cell(column, place->indices.front());
    if (!cell.empty()) return Json::parse(cell);
  }
  return std::nullopt;
}

std::optional<Json> find(const Json& result, const std::vector<Table>& tables, const std::string& path) {
  for (const Table& table : tables)
    if (!table.key.empty() && path.starts_with(table.key + "[")) return find(table, path);
  const Json* value = find_value(result, path);
  return value == nullptr ? std::nullopt : std::optional(*value);
}

std::string shown(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? core::format_number(value.get<double>()) : value.dump();
}

std::string shown(const std::variant<double, bool, std::string>& value) {
  if (const auto* number = std::get_if<double>(&value)) return core::format_number(*number);
  if (const auto* truth = std::get_if<bool>(&value)) return *truth ? "true" : "false";
  return std::get<std::string>(value);
}

bool within(const Expectation& expectation, double expected, double difference) {
  if (expectation.within) return std::abs(difference) <= *expectation.within;
  if (expectation.within_relative) return std::abs(difference) <= *expectation.within_relative * std::abs(expected);
  return difference == 0.0;
}

Check compare(const Expectation& expectation, const Json& value) {
  Check check{expectation.path, shown(expectation.equals), shown(value), std::nullopt, false, expectation.source};
  if (const auto* expected = std::get_if<double>(&expectation.equals)) {
    if (!value.is_number()) return check;
    check.difference = value.get<double>() - *expected;
    check.ok = within(expectation, *expected, *check.difference);
  } else if (const auto* truth = std::get_if<bool>(&expectation.equals)) {
    check.ok = value.is_boolean() && value.get<bool>() == *truth;
  } else {
    check.ok = value.is_string() && value.get<std::string>() == std::get<std::string>(expectation.equals);
  }
  return check;
}

}  // namespace

std::vector<Check> compare(const std::vector<Expectation>& expectations, const Json& result,
                           const std::vector<Table>& tables) {
  std::vector<Check> checks;
  std::vector<core::Diagnostic> problems;
  for (const Expectation& expectation : expectations) {
    if (const std::optional<Json> value = find(result, tables, expectation.path))
      checks.push_back(compare(expectation, *value));
    else
      problems.push_back({expectation.place, "the result has no number '" + expectation.path + "'", {}, {}, {}});
  }
  if (!problems.empty()) throw core::InputError(std::move(problems));
  return checks;
}

}  // namespace dualdamp::scenarios
