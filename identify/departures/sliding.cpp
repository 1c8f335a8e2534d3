#include <numbers>

#include "core/constants.hpp"
#include "identify/departures/groups.hpp"

namespace dualdamp::identify::departures {

namespace {

using friction::ParameterValues;

/// Coulomb and viscous friction are (1 + p) times their mean forward, v > 0, and (1 - p) times backward.
sim::Model asymmetry(const RigBase& base, DepartureValues p) {
  sim::Model model = base.model;
  model.oscillator.damping = (1.0 - p[0]) * base.c();
  return with_law(model, "asymmetric_coulomb",
                  {{"kinetic_forward", (1.0 + p[0]) * base.F0},
                   {"kinetic_backward", (1.0 - p[0]) * base.F0},
                   {"viscous_forward", 2.0 * p[0] * base.c()},
                   {"viscous_backward", 0.0}});
}

sim::Model friction_lag(const RigBase& base, DepartureValues p) {
  return with_law(
      base.model, "friction_lag",
      {{"kinetic", base.F0}, {"static", (1.0 + p[0]) * base.F0}, {"stribeck_velocity", p[1]}, {"lag", p[2]}});
}

/// Coefficient of friction of the rider whose weight [N] gives F0.
constexpr double mu = 0.3;
double weight_of(const RigBase& base) { return base.F0 / mu; }

/// The rider's normal vibration has ten times the forcing frequency and a damping ratio of 0.1.
sim::Model normal_vibration(const RigBase& base, DepartureValues p) {
  constexpr double approach = 1e-6;
  const double weight = weight_of(base);
  const double fast = 10.0 * base.reference.frequency;
  return with_law(base.model, "normal_vibration",
                  {{"mu", mu},
                   {"weight", weight},
                   {"normal_mass", 2.0 * weight / (approach * fast * fast)},
                   {"static_approach", approach},
                   {"normal_damping_ratio", 0.1},
                   {"lift", p[0]},
                   {"lift_velocity", base.reference.speed()}});
}

sim::Model on_slope(const RigBase& base, double slope) { return with_coulomb(base, {{"position_slope", slope}}); }

sim::Model position_dependence(const RigBase& base, DepartureValues p) { return on_slope(base, -base.F0 / p[0]); }

sim::Model position_slope(const RigBase& base, DepartureValues p) { return on_slope(base, p[0]); }

/// A share of the friction follows rate and state, and the total is F0 in steady sliding at the peak speed of the
/// reference motion. With the severity this share tends to 0, not a: the smooth engine needs mu0/a of at most
/// some 40.
sim::Model rate_state(const RigBase& base, DepartureValues p) {
  constexpr double mu0 = 0.2;
  RigBase rest = base;
  rest.F0 *= 1.0 - p[0];
  return with_law(with_coulomb(rest), "rate_state",
                  {{"normal_force", p[0] * base.F0 / mu0},
                   {"mu0", mu0},
                   {"a", 0.05 * mu0},
                   {"b", 0.1 * mu0},
                   {"slip_distance", 0.05 * base.reference.amplitude},
                   {"reference_velocity", base.reference.speed()}});
}

/// Friction that varies along the path, in the same way at each passage.
sim::Model rough_way(const RigBase& base, DepartureValues p) {
  const ParameterValues roughness{{"ratio", p[0]}, {"correlation_length", p[1]}, {"seed", 1.0}};
  return with_coulomb(base, {{"fluctuation", std::vector<ParameterValues>{roughness}}});
}

sim::Model static_friction(const RigBase& base, DepartureValues p) {
  return with_coulomb(base, {{"static", (1.0 + p[0]) * base.F0}});
}

sim::Model stribeck(const RigBase& base, DepartureValues p) {
  return with_law(base.model, "stribeck",
                  {{"kinetic", base.F0}, {"static", (1.0 + p[0]) * base.F0}, {"stribeck_velocity", p[1]}});
}

/// Friction of F0 warms the contact by 4 F0 X each period.
sim::Model warming_contact(const RigBase& base, DepartureValues p) {
  const double heat = 2.0 / std::numbers::pi * base.F0 * base.reference.speed();
  RigBase cold = base;
  cold.F0 = when_cold(base, base.F0, heat, p[0]);
  return with_coulomb(cold, {{"warming", warming(base, p[0])}});
}

/// Friction that differs between the directions.
std::vector<Departure> by_direction() {
  return {
      {.name = "asymmetry",
       .meaning = "Coulomb and viscous friction are larger forward than backward",
       .parameters = {{.name = "excess",
                       .unit = "1",
                       .meaning = "excess of the forward friction over the mean of both directions",
                       .range = {.low = 0.0, .high = 1.0}}},
       .build = asymmetry,
       .severity = "excess of the forward friction, Coulomb and viscous, over the mean of both directions",
       .largest = 1.0,
       .values_at = [](const RigBase&, double s) { return std::vector{s}; }},
  };
}

/// Coulomb friction that falls with speed.
std::vector<Departure> by_speed() {
  return {
      {.name = "friction_lag",
       .meaning = "friction falls with speed, and follows the speed with a lag",
       .parameters = {excess_parameter,
                      fall_parameter,
                      {.name = "lag",
                       .unit = "s",
                       .meaning = "time lag",
                       .range = positive,
                       .start = 0.1,
                       .low = 0.003,
                       .high = 2.0}},
       .build = friction_lag,
       .severity = "lag times forcing frequency, and excess of friction at rest over F0, falling over 0.1 of the "
                   "peak speed",
       .largest = 10.0,
       .values_at = [](const RigBase& base,
                       double s) { return std::vector{s, tenth_of_speed(base), s / base.reference.frequency}; },
       .plausible = {{"2 ms", {0.3, 0.2, 2e-3}, "lags of some milliseconds, hess1990"},
                     {"5 ms", {0.3, 0.2, 5e-3}, "lags of some milliseconds, hess1990"}},
       .family = Family::memory},
      {.name = "normal_vibration",
       .meaning = "speed lifts the mass off its guide, and friction falls with the load",
       .parameters =
           {{.name = "lift", .unit = "N.s/m", .meaning = "lift per speed at low speed", .range = not_negative}},
       .build = normal_vibration,
       .severity = "lift at high speed over the weight; half of it at the peak speed",
       .largest = 1.0,
       .values_at = [](const RigBase& base,
                       double s) { return std::vector{s * weight_of(base) / base.reference.speed()}; }},
      {.name = "static_friction",
       .meaning = "friction holds the mass at rest with more than F0",
       .parameters = {excess_parameter},
       .build = static_friction,
       .severity = "excess of static over kinetic friction, over F0",
       .largest = 10.0,
       .values_at = [](const RigBase&, double s) { return std::vector{s}; }},
      {.name = "stribeck",
       .meaning = "friction falls with speed",
       .parameters = {excess_parameter, fall_parameter},
       .build = stribeck,
       .severity = "excess of friction at rest over F0, falling over 0.1 of the peak speed",
       .largest = 10.0,
       .values_at = [](const RigBase& base, double s) { return std::vector{s, tenth_of_speed(base)}; },
       .plausible = {{"10 mm/s", {0.3, 0.01}, "30 % more friction at rest, boundary lubrication"},
                     {"50 mm/s", {0.3, 0.05}, "the same, falling over a wider range"},
                     {"200 mm/s", {0.3, 0.2}, "the same, over half of the range of speeds"}}},
  };
}

/// Coulomb friction that changes with the position.
std::vector<Departure> by_place() {
  return {
      {.name = "position_dependence",
       .meaning = "Coulomb friction falls with the distance from the middle: F0 (1 - |x|/length)",
       .parameters = {{.name = "length",
                       .unit = "m",
                       .meaning = "distance at which it would vanish",
                       .range = positive,
                       .start = 2.5,
                       .low = 0.3,
                       .high = 1e3}},
       .build = position_dependence,
       .plausible = {{"", {25e-3}, "a way worn in its middle"}}},
      {.name = "position_slope",
       .meaning = "Coulomb friction changes with the distance from the middle: F0 + slope |x|",
       .parameters = {{.name = "slope", .unit = "N/m", .meaning = "of the force over the distance", .range = {}}},
       .build = position_slope,
       .severity = "fall of the friction force at the amplitude X, over F0",
       .largest = 1.0,
       .values_at = [](const RigBase& base,
                       double s) { return std::vector{-s * base.F0 / base.reference.amplitude}; },
       .has_F0 = false,
       .largest_below = 1.0},
      {.name = "rough_way",
       .meaning = "Coulomb friction varies at random along the path",
       .parameters = {{.name = "ratio",
                       .unit = "1",
                       .meaning = "standard deviation of the force over F0",
                       .range = not_negative},
                      {.name = "correlation_length",
                       .unit = "m",
                       .meaning = "distance over which the force changes",
                       .range = positive}},
       .build = rough_way,
       .severity = "three standard deviations of the friction force along the path over F0, correlated over 0.1 X",
       .largest = 1.0,
       .values_at = [](const RigBase& base,
                       double s) { return std::vector{s / 3.0, 0.1 * base.reference.amplitude}; },
       // It has no F0 but that of its path.
       .outside_library = true},
  };
}

/// Constant Coulomb friction, and friction that depends on earlier motion.
std::vector<Departure> by_memory() {
  return {
      {.name = plain_name,
       .meaning = "no mechanism: the friction that the method assumes",
       .parameters = {},
       .build = coulomb_viscous,
       .plausible = {{"", {}, "what the method's own neglect of H bends"}}},
      {.name = "rate_state",
       .meaning = "a share of the friction follows rate and state",
       .parameters =
           {{.name = "share", .unit = "1", .meaning = "share of the friction", .range = {.low = 0.0, .high = 1.0}}},
       .build = rate_state,
       .severity = "share of F0 that follows rate and state",
       .largest = 1.0,
       .values_at = [](const RigBase&, double s) { return std::vector{s}; },
       // It takes four tenths of the time of all laws of the library together.
       .outside_library = true},
      {.name = "warming",
       .meaning = "Coulomb friction falls as the contact warms, over five periods",
       .parameters = {power_parameter},
       .build = warming_contact,
       .severity = "mean power of Coulomb friction over the power at which it falls to 1/e",
       .largest = 10.0,
       .values_at =
           [](const RigBase& base, double s) {
             const double period = core::two_pi / base.reference.frequency;
             return std::vector{4.0 * base.F0 * base.reference.amplitude / period / s};
           },
       .has_F0 = false,
       // It has no F0 but that of its history.
       .outside_library = true},
      {.name = "warming_contact",
       .meaning = "Coulomb friction falls as the contact warms, over a minute",
       .parameters = {power_parameter},
       .build = warming_contact,
       .plausible = {{"", {16.0}, "1 % of friction a kelvin, 6 K a watt"}}},
  };
}

}  // namespace

std::vector<Departure> sliding_departures() {
  return joined({of_family(Family::velocity, by_direction()), of_family(Family::velocity, by_speed()),
                 of_family(Family::position, by_place()), of_family(Family::memory, by_memory())});
}

}  // namespace dualdamp::identify::departures
