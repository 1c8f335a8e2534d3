#include <utility>

#include "identify/departures/groups.hpp"

namespace dualdamp::identify::departures {

namespace {

/// Coulomb friction and a film in place of the damper.
sim::Model with_film(const RigBase& base, std::string_view law, friction::ParameterValues values) {
  sim::Model model = with_coulomb(base);
  model.oscillator.damping = 0.0;
  return with_law(std::move(model), law, std::move(values));
}

sim::Model quadratic_drag(const RigBase& base, DepartureValues p) {
  return with_law(with_coulomb(base), "viscous_power", {{"coefficient", p[0]}, {"exponent", 2.0}});
}

sim::Model viscous_power(const RigBase& base, DepartureValues p) {
  const double V = base.reference.speed();
  return with_film(base, "viscous_power",
                   {{"coefficient", base.c() * V}, {"reference_velocity", V}, {"exponent", p[0]}});
}

sim::Model viscous_saturating(const RigBase& base, DepartureValues p) {
  const double loss = base.found_at_reference ? 1.0 + base.reference.speed() / p[0] : 1.0;
  return with_film(base, "viscous_saturating", {{"coefficient", base.c() * loss}, {"saturation_velocity", p[0]}});
}

/// The mean heat of a damper is c V^2/2.
sim::Model warming_film(const RigBase& base, DepartureValues p) {
  const double heat = 0.5 * base.c() * base.reference.speed() * base.reference.speed();
  return with_film(base, "viscous_power",
                   {{"coefficient", when_cold(base, base.c(), heat, p[0])},
                    {"exponent", 1.0},
                    {"warming", warming(base, p[0])}});
}

constexpr DepartureParameter exponent_parameter = {.name = "exponent",
                                                   .unit = "1",
                                                   .meaning = "exponent of the speed",
                                                   .range = positive,
                                                   .start = 0.6,
                                                   .low = 0.1,
                                                   .high = 3.0};

constexpr DepartureParameter drag_parameter{.name = "drag",
                                            .unit = "N.s^2/m^2",
                                            .meaning = "force over the square of speed",
                                            .range = not_negative,
                                            .start = 0.1,
                                            .low = 1e-5,
                                            .high = 3.0};

}  // namespace

std::vector<Departure> film_departures() {
  return of_family(
      Family::velocity,
      {
          {.name = "quadratic_drag",
           .meaning = "drag proportional to the square of speed, in addition to the damper",
           .parameters = {drag_parameter},
           .build = quadratic_drag,
           .severity = "force of the drag over that of the damper at the peak speed",
           .largest = 10.0,
           .values_at = [](const RigBase& base,
                           double s) { return std::vector{s * base.c() / base.reference.speed()}; },
           .plausible = {{"", {5.0}, "a damper that has a sixth of its force from turbulence in mid range"}},
           .twin_of = "film_beside_damper"},
          {.name = "viscous_power",
           .meaning = "the viscous force is proportional to a power of speed: a film that thins under shear",
           .parameters = {exponent_parameter},
           .build = viscous_power,
           .severity = "exponent of the speed, less 1",
           .largest = 10.0,
           .values_at = [](const RigBase&, double s) { return std::vector{1.0 + s}; },
           .plausible = {{"", {0.8}, "a grease of flow index 0.8"}},
           .has_F0 = false,
           .has_zeta = false,
           .largest_below = 0.9},
          {.name = "viscous_power_below",
           .meaning = "the viscous force goes with a power of speed below one",
           .parameters = {exponent_parameter},
           .build = viscous_power,
           .severity = "1 less the exponent of the speed",
           .largest = 0.9,
           .values_at = [](const RigBase&, double s) { return std::vector{1.0 - s}; },
           .has_F0 = false,
           .has_zeta = false,
           .twin_of = "viscous_power"},
          {.name = "viscous_saturating",
           .meaning = "the viscous force levels off with speed: a film that thins under shear",
           .parameters = {{.name = "saturation_velocity",
                           .unit = "m/s",
                           .meaning = "speed at which the force is half of its largest value",
                           .range = positive,
                           .start = 2.0,
                           .low = 0.05,
                           .high = 1e3}},
           .build = viscous_saturating,
           .severity = "peak speed over the saturation velocity",
           .largest = 100.0,
           .values_at = [](const RigBase& base, double s) { return std::vector{base.reference.speed() / s}; },
           .plausible = {{"", {0.7}, "a film of 0.1 mm that has lost half of its viscosity at 7000 1/s"}}},
          {.name = "warming_film",
           .meaning = "viscosity falls as the film warms by its own heat, over a minute",
           .parameters = {power_parameter},
           .build = warming_film,
           .plausible = {{"", {4.0}, "4 % of viscosity a kelvin, 6 K a watt"}}},
      });
}

}  // namespace dualdamp::identify::departures
