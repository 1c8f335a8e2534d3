#include "friction_models/modifiers/modifiers.hpp"

#include <algorithm>

namespace dualdamp::friction {

namespace {

Parameter load_modulation() {
  return {
      .name = "load_modulation",
      .kind = ParameterKind::record,
      .fields = {{.name = "ratio",
                  .unit = "1",
                  // At 1 the contact would open.
                  .range = {.low = 0.0, .high = 1.0, .high_open = true},
                  .meaning = "amplitude relative to the mean load"},
                 {.name = "order",
                  .kind = ParameterKind::count,
                  .fallback = 1.0,
                  .range = {.low = 1.0, .high = 1000.0},
                  .meaning = "multiple of the excitation's frequency"},
                 {.name = "phase",
                  .unit = "rad",
                  .fallback = 0.0,
                  .range = {.low = -largest_phase, .high = largest_phase},
                  .meaning = "phase in cos(order w t + phase)"}},
      .is_optional = true,
      .meaning = "load of the contact that follows a harmonic excitation; the force limits are proportional to it"};
}

Parameter fluctuation() {
  return {.name = "fluctuation",
          .kind = ParameterKind::record,
          .fields = {{.name = "ratio",
                      .unit = "1",
                      // Beyond 1 the factor would be 0 for more than a sixth of the time.
                      .range = {.low = 0.0, .high = 1.0},
                      .meaning = "standard deviation relative to the force limit"},
                     {.name = "correlation_time",
                      .unit = "s",
                      .range = positive,
                      .meaning = "time in which the correlation falls to 1/e"},
                     {.name = "correlation_length",
                      .unit = "m",
                      .instead_of = "correlation_time",
                      .range = positive,
                      .meaning = "distance over which the correlation falls to 1/e"},
                     {.name = "seed", .kind = ParameterKind::seed, .meaning = "seed of the random numbers"}},
          .is_optional = true,
          .meaning = "random variation of the force limits over time or position"};
}

}  // namespace

const std::vector<Parameter>& modifier_parameters() {
  static const std::vector<Parameter> table = {
      {.name = "drift",
       .unit = "1/s",
       .is_optional = true,
       .meaning = "relative growth of the force limits with time; they are never below 0"},
      {.name = "position_slope",
       .unit = "N/m",
       .is_optional = true,
       // The spring would relax towards a force limit that depends on x: no affine function of x and v.
       .not_beside = "contact_damping",
       .meaning = "growth of the force limits with the distance from x = 0; they are never below 0"},
      {.name = "load_gradient",
       .unit = "1/m",
       .is_optional = true,
       .not_beside = "contact_damping",
       .meaning = "relative growth of the load of the contact with x; the force limits are proportional to it"},
      load_modulation(),
      fluctuation(),
      {.name = "warming",
       .kind = ParameterKind::record,
       .fields = {{.name = "power",
                   .unit = "W",
                   .range = positive,
                   .meaning = "power turned to heat at which the force limits fall to 1/e"},
                  {.name = "time_constant",
                   .unit = "s",
                   .range = positive,
                   .meaning = "time constant with which the contact warms and cools"}},
       .is_optional = true,
       .meaning = "fall of the force limits with the power that friction turns to heat"},
  };
  return table;
}

std::vector<std::string_view> all_modifiers_but(std::string_view name) {
  std::vector<std::string_view> names = all_modifiers();
  std::erase(names, name);
  return names;
}

std::vector<std::string_view> all_modifiers() {
  std::vector<std::string_view> names;
  for (const Parameter& modifier : modifier_parameters()) names.push_back(modifier.name);
  return names;
}

std::vector<Parameter> with_modifiers(std::vector<Parameter> own, const std::vector<std::string_view>& modifiers) {
  for (const Parameter& modifier : modifier_parameters())
    if (std::ranges::find(modifiers, modifier.name) != modifiers.end()) own.push_back(modifier);
  return own;
}

}  // namespace dualdamp::friction
