#include <cmath>
#include <utility>

#include "identify/departures/groups.hpp"

namespace dualdamp::identify::departures {

namespace {

using friction::ParameterValues;

/// Stiffness whose deflection under F0 is s X.
double stiffness_at(const RigBase& base, double s) { return base.F0 / (s * base.reference.amplitude); }

std::vector<double> only_stiffness(const RigBase& base, double s) { return {stiffness_at(base, s)}; }

/// Damping of bristles of this stiffness [N/m]: a tenth of the critical damping of the mass on them. Because of it,
/// bristle laws tend to Coulomb friction with the root of their deflection.
double bristle_damping(const RigBase& base, double stiffness) {
  return 0.2 * std::sqrt(stiffness * base.model.oscillator.mass);
}

sim::Model bouc_wen(const RigBase& base, DepartureValues p) {
  return with_law(base.model, "bouc_wen", {{"limit", base.F0}, {"stiffness", p[0]}, {"exponent", 2.0}});
}

sim::Model behind_spring(sim::Model model, double F0, double stiffness) {
  return with_law(std::move(model), "contact_compliance", {{"kinetic", F0}, {"contact_stiffness", stiffness}});
}

sim::Model contact_compliance(const RigBase& base, DepartureValues p) {
  return behind_spring(base.model, base.F0, p[0]);
}

sim::Model rigid_and_compliant(const RigBase& base, DepartureValues p) {
  RigBase rigid = base;
  rigid.F0 = (1.0 - p[1]) * base.F0;
  return behind_spring(with_coulomb(rigid), p[1] * base.F0, p[0]);
}

sim::Model dahl(const RigBase& base, DepartureValues p) {
  return with_law(base.model, "dahl", {{"kinetic", base.F0}, {"sigma0", p[0]}});
}

sim::Model elasto_plastic(const RigBase& base, DepartureValues p) {
  return with_law(base.model, "elasto_plastic",
                  {{"kinetic", base.F0},
                   {"stribeck_velocity", tenth_of_speed(base)},
                   {"sigma0", p[0]},
                   {"sigma1", bristle_damping(base, p[0])},
                   {"elastic_limit", 0.5 * base.F0 / p[0]}});
}

/// Four elements with equal shares of the friction. They slip one after the other, the first at half of the mean
/// deflection.
sim::Model generalized_maxwell_slip(const RigBase& base, DepartureValues p) {
  std::vector<ParameterValues> elements;
  for (const double deflection : {0.5, 0.75, 1.25, 1.5})  // over their mean
    elements.push_back({{"stiffness", 0.25 * p[0] / deflection}, {"share", 0.25}});
  return with_law(base.model, "generalized_maxwell_slip",
                  {{"elements", elements},
                   {"kinetic", base.F0},
                   {"static", (1.0 + p[1]) * base.F0},
                   {"stribeck_velocity", p[2]},
                   // Slipping elements reach the level within a hundredth of a period.
                   {"attraction", 100.0 * base.F0 * base.reference.frequency}});
}

sim::Model free_play(const RigBase& base, DepartureValues p) {
  return with_law(base.model, "free_play", {{"kinetic", base.F0}, {"play", p[0]}});
}

sim::Model iwan(const RigBase& base, DepartureValues p) {
  return with_law(base.model, "iwan", {{"limit", base.F0}, {"stiffness", p[0]}, {"count", 20.0}});
}

sim::Model lugre(const RigBase& base, DepartureValues p) {
  return with_law(base.model, "lugre",
                  {{"kinetic", base.F0},
                   {"static", (1.0 + p[1]) * base.F0},
                   {"stribeck_velocity", base.boundary_velocity},
                   {"sigma0", p[0]},
                   {"sigma1", bristle_damping(base, p[0])}});
}

sim::Model reset_integrator(const RigBase& base, DepartureValues p) {
  return with_law(base.model, "reset_integrator",
                  {{"kinetic", base.F0}, {"stiffness", p[0]}, {"static_gain", p[1]}});
}

constexpr DepartureParameter contact_parameter = {.name = "contact_stiffness",
                                                  .unit = "N/m",
                                                  .meaning = "stiffness of the contact in series with its slider",
                                                  .range = positive,
                                                  .start = 1.0,
                                                  .low = 0.05,
                                                  .high = 300.0};
constexpr DepartureParameter bristles_parameter = {.name = "sigma0",
                                                   .unit = "N/m",
                                                   .meaning = "stiffness of the bristles",
                                                   .range = positive,
                                                   .start = 1.0,
                                                   .low = 0.05,
                                                   .high = 100.0};
constexpr DepartureParameter stiffness_parameter = {
    .name = "stiffness", .unit = "N/m", .meaning = "of the contact at small deflections", .range = positive};

/// Contacts in series with a stiffness.
std::vector<Departure> sliders() {
  return {
      {.name = "bouc_wen",
       .meaning = "the contact yields gradually, along a smooth loop",
       .parameters = {stiffness_parameter},
       .build = bouc_wen,
       .severity = "yield deflection F0/stiffness over the amplitude X",
       .largest = 1.0,
       .values_at = only_stiffness},
      {.name = "contact_compliance",
       .meaning = "the contact yields elastically before it slides: a spring in series with Coulomb friction",
       .parameters = {contact_parameter},
       .build = contact_compliance,
       .severity = "deflection of the contact F0/K over the amplitude X",
       .largest = 1.0,
       .values_at = only_stiffness,
       .plausible = {{"", {11.6e4}, "measured on the paper's rig, liang2004identifying"}}},
      {.name = "free_play",
       .meaning = "Coulomb friction behind free play, which the mass crosses without friction",
       .parameters = {{.name = "play", .unit = "m", .meaning = "from one stop to the other", .range = positive}},
       .build = free_play,
       .severity = "free play over the amplitude X",
       .largest = 1.0,
       .values_at = [](const RigBase& base, double s) { return std::vector{s * base.reference.amplitude}; }},
      {.name = "generalized_maxwell_slip",
       .meaning = "elements that slip one after the other, with a friction that falls with speed",
       .parameters = {stiffness_parameter, excess_parameter, fall_parameter},
       .build = generalized_maxwell_slip,
       .severity = "mean deflection of the elements over the amplitude X, and excess of static friction over F0",
       .largest = 1.0,
       .values_at = [](const RigBase& base,
                       double s) { return std::vector{stiffness_at(base, s), s, tenth_of_speed(base)}; }},
      {.name = "iwan",
       .meaning = "many sliders behind springs, which slip one after the other",
       .parameters = {stiffness_parameter},
       .build = iwan,
       .severity = "mean deflection of the sliders over the amplitude X",
       .largest = 1.0,
       // The last slider slips at a stretch of 2 F0/stiffness.
       .values_at = [](const RigBase& base, double s) { return std::vector{2.0 * stiffness_at(base, s)}; }},
      {.name = "rigid_and_compliant",
       .meaning = "two contacts in parallel, one rigid and one behind a spring",
       .parameters = {contact_parameter,
                      {.name = "share",
                       .unit = "1",
                       .meaning = "share of the compliant contact in F0",
                       .range = {.low = 0.0, .high = 1.0},
                       .start = 0.5,
                       .low = 0.01,
                       .high = 0.99}},
       .build = rigid_and_compliant,
       .plausible = {{"", {11.6e4, 0.5}, "half of the friction behind the measured stiffness"}}},
  };
}

/// Contacts with an internal deflection.
std::vector<Departure> bristles() {
  return {
      {.name = "dahl",
       .meaning = "bristles that yield gradually, independent of speed",
       .parameters = {bristles_parameter},
       .build = dahl,
       .severity = "deflection of the bristles F0/sigma0 over the amplitude X",
       .largest = 1.0,
       .values_at = only_stiffness,
       .plausible = {{"", {11.6e4}, "the measured contact stiffness, liang2004identifying"}}},
      {.name = "elasto_plastic",
       .meaning = "bristles that bend elastically before they yield",
       .parameters = {bristles_parameter},
       .build = elasto_plastic,
       .severity = "deflection of the bristles F0/sigma0 over the amplitude X",
       .largest = 1.0,
       .values_at = only_stiffness},
      {.name = "lugre",
       .meaning = "bristles that bend, with a friction that falls over the first 10 mm/s",
       .parameters = {bristles_parameter, excess_parameter},
       .build = lugre,
       .severity =
           "deflection of the bristles F0/sigma0 over the amplitude X, and excess of static friction over F0",
       .largest = 1.0,
       .values_at = [](const RigBase& base, double s) { return std::vector{stiffness_at(base, s), s}; },
       .plausible = {{"no excess", {11.6e4, 0.0}, "the measured contact stiffness, liang2004identifying"},
                     {"excess", {11.6e4, 0.3}, "the same, with 30 % more friction at rest"}}},
      {.name = "reset_integrator",
       .meaning = "a bond that stretches, breaks at a limit and is made again",
       .parameters = {stiffness_parameter,
                      {.name = "static_gain",
                       .unit = "1",
                       .meaning = "the bond breaks at (1 + static_gain) F0",
                       .range = not_negative}},
       .build = reset_integrator,
       .severity = "stretch F0/stiffness at which the bond breaks over the amplitude X, and its static gain",
       .largest = 1.0,
       .values_at = [](const RigBase& base, double s) { return std::vector{stiffness_at(base, s), s}; }},
  };
}

}  // namespace

std::vector<Departure> contact_departures() {
  return of_family(Family::presliding, joined({sliders(), bristles()}));
}

}  // namespace dualdamp::identify::departures
