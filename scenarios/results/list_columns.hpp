#pragma once
/// Columns of a list in a result, each stated once: name, unit, meaning and value. The table of the list and the
/// fields that describe it both follow from this statement.

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "scenarios/format/result_field.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

/// One column; its value is that of an item seen in its context, such as the grid that the item is a part of.
template <typename Item, typename Context>
struct ListColumn {
  using Number = std::function<double(const Item&, const Context&)>;
  using Text = std::function<std::string(const Item&, const Context&)>;

  std::string name;
  std::string unit;  ///< SI; "1" for a plain number, empty for what is no number
  std::string meaning;
  std::variant<Number, Text> value;
  CellKind kind = CellKind::number;  ///< of a number

  [[nodiscard]] Column of(const std::vector<Item>& items, const Context& context) const {
    if (const auto* text = std::get_if<Text>(&value))
      return text_column(name, items, [&](const Item& item) { return (*text)(item, context); });
    Column result = column(name, unit == "1" ? "" : unit, items,
                           [&](const Item& item) { return std::get<Number>(value)(item, context); });
    result.kind = kind;
    return result;
  }
};

template <typename Item, typename Context>
using ListColumns = std::vector<ListColumn<Item, Context>>;

/// The table of a list under `key` in the result, and in a file of the same name.
template <typename Item, typename Context>
Table list_table(std::string key, const ListColumns<Item, Context>& columns, const std::vector<Item>& items,
                 const Context& context) {
  Table table{.name = key, .is_long = true};
  for (const auto& column : columns) table.columns.push_back(column.of(items, context));
  table.key = std::move(key);
  return table;
}

/// Appends the fields of the list under `key`.
template <typename Item, typename Context>
void add_list_fields(std::string_view key, const ListColumns<Item, Context>& columns,
                     std::vector<ResultField>& fields) {
  for (const auto& column : columns)
    fields.push_back({std::string(key) + "[]." + column.name, column.unit, column.meaning});
}

}  // namespace dualdamp::scenarios
