#pragma once
/// JSON values: those of scenarios and results, which `scenarios/` hands to `bench/`, `cli/` and `python/`. The
/// folders below know no JSON.

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

namespace dualdamp::scenarios {

/// Keys keep the order in which they were added: that of the tables and of the contract.
using Json = nlohmann::ordered_json;

/// JSON has no infinity; a number that does not exist is null.
inline Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

inline Json finite_or_null(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(finite_or_null(value));
  return list;
}

}  // namespace dualdamp::scenarios
