#include "scenarios/results/table.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "scenarios/format/json.hpp"

namespace dualdamp::scenarios {

std::string quantities_text(const std::vector<Quantity>& quantities) {
  constexpr int digits = 4;
  std::string text;
  for (const auto& [name, value, unit] : quantities)
    text += (text.empty() ? "" : ", ") + name + " " + core::format_number(value, digits) +
            (unit.empty() || unit == "1" ? "" : " " + unit);
  return text;
}

std::string change_text(double share) {
  constexpr double rounding = 1e-6;
  constexpr int digits = 2;
  if (!std::isfinite(share)) return "-";
  return std::abs(share) < rounding ? "0 %" : core::signed_percent(share, digits);
}

std::size_t Column::size() const {
  if (!choices.empty()) return choices.size();
  return kind == CellKind::text ? texts.size() : numbers.size();
}

const Column* Table::find(std::string_view column) const {
  const auto found = std::ranges::find(columns, column, &Column::name);
  return found == columns.end() ? nullptr : &*found;
}

std::string json_cell(const Column& column, std::size_t row) {
  if (column.kind == CellKind::text) {
    const std::string& text = column.text(row);
    return text.empty() ? text : Json(text).dump();
  }
  const double value = column.numbers[row];
  if (!std::isfinite(value)) return "null";
  if (column.kind == CellKind::count) return std::to_string(static_cast<long>(value));
  if (column.kind == CellKind::truth) return value != 0.0 ? "true" : "false";
  return Json(value).dump();
}

}  // namespace dualdamp::scenarios
