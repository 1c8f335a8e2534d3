#include "scenarios/results/shown_table.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace dualdamp::scenarios {

namespace {

/// The name of what a row with its own unit is about.
std::string name_of_row(const Table& table, std::size_t row, const Column& otherwise) {
  for (const char* heading : {"name", "parameter"})
    if (const Column* names = table.find(heading); names != nullptr && names->kind == CellKind::text)
      return names->text(row);
  return otherwise.name;
}

template <typename Value>
void keep_first(std::vector<Value>& values, std::size_t count) {
  if (values.size() > count) values.resize(count);
}

void add_size(double value, double& largest) {
  if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
}

double size_of_row(const Column& column, std::size_t row) {
  double largest = 0.0;
  add_size(column.numbers[row], largest);
  if (!column.intervals.empty())
    for (const double end : column.intervals[row]) add_size(end, largest);
  return largest;
}

void scale_row(Column& column, std::size_t row, double factor) {
  column.numbers[row] *= factor;
  if (!column.intervals.empty())
    for (double& end : column.intervals[row]) end *= factor;
}

void show_column(Column& column, const ShownUnits& units) {
  double largest = 0.0;
  for (std::size_t row = 0; row < column.numbers.size(); ++row)
    largest = std::max(largest, size_of_row(column, row));
  const auto shown = shown_unit(units, kind_of(column.unit, column.name), largest);
  if (!shown) return;
  column.unit = shown->unit;
  for (std::size_t row = 0; row < column.numbers.size(); ++row) scale_row(column, row, shown->factor);
}

void show_quantities(Column& column, const ShownUnits& units) {
  for (std::size_t row = 0; row < column.quantities.size(); ++row) {
    for (Quantity& one : column.quantities[row])
      if (const auto shown = shown_unit(units, kind_of(one.unit, one.name), std::abs(one.value))) {
        one.value *= shown->factor;
        one.unit = shown->unit;
      }
    column.texts[row] = quantities_text(column.quantities[row]);
  }
}

/// The numbers of a row that share one unit are shown in one unit.
void show_rows(Table& table, Column& stated, const ShownUnits& units) {
  const std::vector<std::string> si = stated.texts;
  std::vector<Column*> columns;
  for (Column& column : table.columns)
    if (column.row_units == si) columns.push_back(&column);
  for (std::size_t row = 0; row < si.size(); ++row) {
    double largest = 0.0;
    for (const Column* column : columns) largest = std::max(largest, size_of_row(*column, row));
    const std::string name = name_of_row(table, row, *columns.front());
    const auto shown = shown_unit(units, kind_of(si[row], name), largest);
    if (!shown) continue;
    stated.texts[row] = shown->unit;
    for (Column* column : columns) scale_row(*column, row, shown->factor);
  }
  for (Column* column : columns) column->row_units.clear();
}

/// The one unit of all rows; empty: they have several.
std::string common_unit(std::span<const std::string> row_units) {
  const bool is_one = std::ranges::all_of(row_units, [&](const auto& unit) { return unit == row_units.front(); });
  return is_one && !row_units.empty() ? row_units.front() : std::string();
}

}  // namespace

Table in_shown_units(const Table& table, const ShownUnits& units, std::size_t rows) {
  Table shown = table;
  for (Column& column : shown.columns) {
    if (column.choices.empty()) keep_first(column.texts, rows);
    keep_first(column.choices, rows);
    keep_first(column.numbers, rows);
    keep_first(column.row_units, rows);
    keep_first(column.intervals, rows);
    keep_first(column.quantities, rows);
  }
  for (Column& stated : shown.columns)
    if (stated.kind == CellKind::text && stated.choices.empty() && !stated.texts.empty() &&
        std::ranges::any_of(shown.columns, [&](const Column& c) { return c.row_units == stated.texts; }))
      show_rows(shown, stated, units);
  for (Column& column : shown.columns) {
    if (!column.row_units.empty()) column.unit = common_unit(column.row_units);  // no column states it
    if (column.kind == CellKind::text)
      show_quantities(column, units);
    else
      show_column(column, units);
  }
  return shown;
}

std::set<std::string> kinds_of(const Table& table) {
  std::set<std::string> kinds;
  for (const Column& column : table.columns) {
    if (!column.unit.empty()) kinds.insert(kind_of(column.unit, column.name));
    for (std::size_t row = 0; row < column.row_units.size(); ++row)
      kinds.insert(kind_of(column.row_units[row], name_of_row(table, row, column)));
    for (const std::vector<Quantity>& row : column.quantities)
      for (const Quantity& one : row) kinds.insert(kind_of(one.unit, one.name));
  }
  return kinds;
}

}  // namespace dualdamp::scenarios
