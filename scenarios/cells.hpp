#pragma once
/// Numbers and columns of answers: how the results of `sim` and `identify` become JSON and tables.

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "scenarios/json.hpp"
#include "scenarios/table.hpp"

namespace dualdamp::scenarios {

inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// JSON knows no infinity; a number that does not exist is null.
inline Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

inline Json finite(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(finite(value));
  return list;
}

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

}  // namespace dualdamp::scenarios
