#pragma once
/// A table of law parameters with every kind there is, and both forms of a law: a list of elements, or a total
/// divided among a count. No shipped law needs all of it.

#include <vector>

#include "friction_models/modifiers/modifiers.hpp"

namespace dualdamp::test {

inline std::vector<friction::Parameter> parameters_of_two_forms() {
  using friction::ParameterKind;
  return friction::with_modifiers(
      {{.name = "elements",
        .kind = ParameterKind::list,
        .fields =
            {{.name = "stiffness",
              .unit = "N/m",
              .range = {.low = 0.0, .low_open = true},
              .meaning = "of the spring"},
             {.name = "limit", .unit = "N", .fallback = 1.0, .range = {.low = 0.0}, .meaning = "of the slider"}},
        .meaning = "springs with sliders"},
       {.name = "total", .unit = "N", .instead_of = "elements", .range = {.low = 0.0}, .meaning = "all limits"},
       {.name = "count",
        .kind = ParameterKind::count,
        .instead_of = "elements",
        .range = {.low = 1.0, .high = 100.0},
        .meaning = "how many"},
       {.name = "form",
        .kind = ParameterKind::choice,
        .words = {"uniform", "linear"},
        .fallback = "uniform",
        .instead_of = "elements",
        .meaning = "how divided"},
       {.name = "symmetric", .kind = ParameterKind::flag, .fallback = true, .meaning = "both ways alike"}},
      {"drift", "fluctuation"});
}

}  // namespace dualdamp::test
