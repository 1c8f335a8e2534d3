#pragma once
/// The lists of a result, stored by columns, so that a list of a million records is never a million JSON objects. A
/// table is converted row by row to JSON, CSV and printed text.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace dualdamp::scenarios {

enum class CellKind {
  number,
  count,  ///< a whole number
  truth,  ///< 1 or 0
  text,
};

/// A number with a unit of its own, within a text.
struct Quantity {
  std::string name;
  double value = 0.0;
  std::string unit;  ///< SI; "1": none
};

/// "mass 1.2 kg, ratio 3"
[[nodiscard]] std::string quantities_text(const std::vector<Quantity>& quantities);

/// Numbers (NaN: no value) or texts. The last members are for printed tables; files leave them out.
struct Column {
  std::string name;
  std::string unit;  ///< empty: no unit
  std::vector<double> numbers;
  std::vector<std::string> texts;
  CellKind kind = CellKind::number;
  /// For texts with few different values: row i has `texts[choices[i]]`. Empty: row i has `texts[i]`.
  std::vector<std::uint32_t> choices = {};
  /// The SI unit of each number, if the rows are of different quantities; files state it in a column of texts.
  std::vector<std::string> row_units = {};
  std::vector<std::array<double, 2>> intervals = {};   ///< behind each number: 1.2 (1.1 to 1.3); NaN: none
  std::vector<std::vector<Quantity>> quantities = {};  ///< of which each text consists
  int digits = 9;                                      ///< of printed numbers

  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] const std::string& text(std::size_t row) const {
    return choices.empty() ? texts[row] : texts[choices[row]];
  }
};

/// A number that does not exist.
inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A relative change for a cell of a table: "+3 %"; "0 %" where it is rounding only, "-" where there is none.
[[nodiscard]] std::string change_text(double share);

/// A column of the values of `get` for each item.
template <typename Item, typename Get>
Column column(std::string name, std::string unit, const std::vector<Item>& items, Get get) {
  Column result{.name = std::move(name), .unit = std::move(unit)};
  result.numbers.reserve(items.size());
  for (const Item& item : items) result.numbers.push_back(std::invoke(get, item));
  return result;
}

template <typename Item, typename Get>
Column text_column(std::string name, const std::vector<Item>& items, Get get) {
  Column result{.name = std::move(name), .kind = CellKind::text};
  for (const Item& item : items) result.texts.emplace_back(std::invoke(get, item));
  return result;
}

struct Table {
  std::string name;  ///< of the file, without .csv
  std::vector<Column> columns;
  bool is_long = false;  ///< not for a terminal
  bool is_file = true;   ///< false: only for a terminal
  std::string key = {};  ///< key of the list in the result that has these rows; empty: the table is only a file
  /// Every row has all its numbers or a `reason`, or in the column `NAME_reason` one for a number of the column
  /// NAME; otherwise the result is refused.
  bool is_complete = false;
  /// How many rows there are depends on the error of the solver; a verification compares the rows of both results.
  bool ends_with_accuracy = false;

  [[nodiscard]] std::size_t size() const { return columns.empty() ? 0 : columns.front().size(); }
  /// The column of this name; nullptr: there is none.
  [[nodiscard]] const Column* find(std::string_view column) const;
};

/// The value of a cell as JSON: null for a number that does not exist; nothing for an empty text, the key of which
/// is left out.
[[nodiscard]] std::string json_cell(const Column& column, std::size_t row);

}  // namespace dualdamp::scenarios
