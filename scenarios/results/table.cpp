#include "scenarios/results/table.hpp"

#include <algorithm>
#include <cmath>

#include "scenarios/format/json.hpp"

namespace dualdamp::scenarios {

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
