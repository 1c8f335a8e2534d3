#pragma once
/// The groups of the table of departures, and functions that several of them share.

#include <span>
#include <string_view>
#include <vector>

#include "friction_models/parameters.hpp"
#include "identify/departures/departures.hpp"

namespace dualdamp::identify::departures {

/// Friction that yields before it slips: contacts behind a stiffness, and bristles.
[[nodiscard]] std::vector<Departure> contact_departures();
/// Coulomb friction that depends on speed, position, temperature or the load of the contact.
[[nodiscard]] std::vector<Departure> sliding_departures();
/// Viscous friction that is not proportional to speed.
[[nodiscard]] std::vector<Departure> film_departures();
/// Drives, springs and structures that differ from what the laboratory states.
[[nodiscard]] std::vector<Departure> drive_departures();

/// Laboratories that state wrong constants or have wrong sensors.
[[nodiscard]] std::vector<Departure> laboratory_departures();

/// Sets the family of those departures of a group that have none.
[[nodiscard]] std::vector<Departure> of_family(Family family, std::vector<Departure> group);

[[nodiscard]] std::vector<Departure> joined(const std::vector<std::vector<Departure>>& groups);

/// Values of a departure's parameters, SI.
using DepartureValues = std::span<const double>;

/// `model` with the law added; defaults of `values` are filled in. Errors: `std::logic_error` if the law is unknown
/// or refuses the values, which is a fault of the table.
[[nodiscard]] sim::Model with_law(sim::Model model, std::string_view law, friction::ParameterValues values);

/// The base with Coulomb friction F0; `values` are further parameters of the law.
[[nodiscard]] sim::Model with_coulomb(const RigBase& base, friction::ParameterValues values = {});

/// `with_coulomb` as the builder of a departure without parameters.
[[nodiscard]] sim::Model coulomb_viscous(const RigBase& base, DepartureValues values);

/// Parameters of the modifier `warming` for a heat power at which the force has fallen to 1/e [W].
[[nodiscard]] std::vector<friction::ParameterValues> warming(const RigBase& base, double power);

/// The force or damping of the cold rig: `found` is what the base states, `heat` the power that friction turns to
/// heat in the reference motion [W].
[[nodiscard]] double when_cold(const RigBase& base, double found, double heat, double power);

/// Speed over which friction falls in several departures: a tenth of the peak speed.
[[nodiscard]] inline double tenth_of_speed(const RigBase& base) { return 0.1 * base.reference.speed(); }

using friction::not_negative;
using friction::positive;

/// Parameters that several departures have.
inline constexpr DepartureParameter excess_parameter = {
    .name = "excess",
    .unit = "1",
    .meaning = "excess of static friction over F0, relative to F0",
    .range = not_negative,
    .start = 0.3,
    .low = 1e-4,
    .high = 3.0};
inline constexpr DepartureParameter fall_parameter = {.name = "stribeck_velocity",
                                                      .unit = "m/s",
                                                      .meaning = "speed over which the excess falls",
                                                      .range = positive,
                                                      .start = 0.3,
                                                      .low = 0.01,
                                                      .high = 5.0};
inline constexpr DepartureParameter power_parameter = {
    .name = "power",
    .unit = "W",
    .meaning = "power turned to heat at which the force has fallen to 1/e",
    .range = positive,
    .start = 6.0,
    .low = 0.1,
    .high = 1e3};

}  // namespace dualdamp::identify::departures
