#pragma once
/// Numbers and columns of answers: conversion of results of `sim` and `identify` to JSON and tables.

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "scenarios/format/json.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

/// JSON has no infinity; a number that does not exist is null.
inline Json finite_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

inline Json finite_or_null(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(finite_or_null(value));
  return list;
}

}  // namespace dualdamp::scenarios
