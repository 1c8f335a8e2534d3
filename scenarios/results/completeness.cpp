#include "scenarios/results/completeness.hpp"

#include <cmath>

namespace dualdamp::scenarios {

namespace {

std::string missing_in(const Json& json, const std::string& path) {
  if (json.is_number_float()) return std::isfinite(json.get<double>()) ? "" : path;
  if (!json.is_structured()) return "";
  std::size_t index = 0;
  for (const auto& [key, value] : json.items()) {
    const std::string place = json.is_array() ? path + "[" + std::to_string(index++) + "]"
                              : path.empty()  ? key
                                              : path + "." + key;
    if (std::string missing = missing_in(value, place); !missing.empty()) return missing;
  }
  return "";
}

bool is_stated(const Column* reason, std::size_t row) { return reason != nullptr && !reason->text(row).empty(); }

std::string missing_in(const Table& table) {
  const Column* const reason = table.find("reason");
  for (const Column& column : table.columns) {
    if (column.kind == CellKind::text) continue;
    const Column* const own_reason = table.find(column.name + "_reason");
    for (std::size_t row = 0; row < column.numbers.size(); ++row) {
      if (std::isfinite(column.numbers[row]) || is_stated(reason, row) || is_stated(own_reason, row)) continue;
      return (table.key.empty() ? table.name : table.key) + "[" + std::to_string(row) + "]." + column.name;
    }
  }
  return "";
}

}  // namespace

std::string missing_number(const Answer& answer) {
  if (std::string missing = missing_in(answer.result, ""); !missing.empty()) return missing;
  for (const Table& table : answer.tables) {
    if (!table.is_complete) continue;
    if (std::string missing = missing_in(table); !missing.empty()) return missing;
  }
  return "";
}

}  // namespace dualdamp::scenarios
