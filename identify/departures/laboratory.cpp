#include "identify/departures/groups.hpp"

namespace dualdamp::identify::departures {

namespace {

std::vector<double> no_values(const RigBase&, double) { return {}; }

/// Coulomb + viscous friction, in a laboratory that states or reads something wrong.
Departure misled(std::string_view name, std::string_view meaning, std::string_view severity, Family family,
                 void (*mislead)(Laboratory&, const ReferenceMotion&, double)) {
  Departure departure{.name = name, .meaning = meaning, .parameters = {}, .build = coulomb_viscous};
  departure.severity = severity;
  departure.largest = 1.0;
  departure.values_at = no_values;
  departure.mislead = mislead;
  departure.family = family;
  return departure;
}

/// The first sweep of friction that grows from (1 - s/2) F0 to (1 + s/2) F0.
sim::Model grown_by_half(const RigBase& base, DepartureValues p) {
  RigBase first = base;
  first.F0 *= 1.0 - 0.5 * p[0];
  return with_coulomb(first);
}

Departure drifting_friction() {
  Departure departure = misled("drifting_friction", "friction grows from sweep to sweep",
                               "growth of friction from the first sweep to the last, over F0, the mean of both",
                               Family::memory, [](Laboratory& laboratory, const ReferenceMotion&, double s) {
                                 laboratory.friction_growth = s / (1.0 - 0.5 * s);
                               });
  departure.parameters = {{.name = "growth",
                           .unit = "1",
                           .meaning = "growth of friction over the record, over its mean",
                           .range = {.low = 0.0, .high = 1.0}}};
  departure.build = grown_by_half;
  departure.values_at = [](const RigBase&, double s) { return std::vector{s}; };
  departure.needs_sweeps = true;
  return departure;
}

}  // namespace

std::vector<Departure> laboratory_departures() {
  return {
      drifting_friction(),
      misled("base_gain", "the sensor of the base reads too much", "gain of the sensor of y, less 1",
             Family::sensors,
             [](Laboratory& laboratory, const ReferenceMotion&, double s) { laboratory.sensors.y.gain_error = s; }),
      misled("displacement_gain", "the sensor of the mass reads too much", "gain of the sensor of x, less 1",
             Family::sensors,
             [](Laboratory& laboratory, const ReferenceMotion&, double s) { laboratory.sensors.x.gain_error = s; }),
      misled("displacement_offset", "the sensor of the mass does not read zero at rest",
             "offset of the readings of x over the amplitude X", Family::sensors,
             [](Laboratory& laboratory, const ReferenceMotion& reference, double s) {
               laboratory.sensors.x.offset = s * reference.amplitude;
             }),
      misled("drifting_gain", "the sensor of the mass drifts during the record",
             "gain of the sensor of x at the last reading, less 1", Family::sensors,
             [](Laboratory& laboratory, const ReferenceMotion&, double s) { laboratory.sensors.x.gain_drift = s; }),
      misled("outliers", "one reading of the mass in five is off", "relative error of these readings",
             Family::sensors,
             [](Laboratory& laboratory, const ReferenceMotion&, double s) {
               laboratory.sensors.x.outlier_every = 5;
               laboratory.sensors.x.outlier_size = s;
             }),
      misled("late_displacement", "the sensor of the mass reads late", "lag of the readings of x [rad]",
             Family::sensors,
             [](Laboratory& laboratory, const ReferenceMotion&, double s) { laboratory.sensors.x.phase_lag = s; }),
      misled(
          "mass_overstated", "the mass is smaller than stated", "stated mass over the true one, less 1",
          Family::constants,
          [](Laboratory& laboratory, const ReferenceMotion&, double s) { laboratory.constants.mass *= 1.0 + s; }),
      misled("stiffness_overstated", "the spring is softer than stated",
             "stated stiffness over the true one, less 1", Family::constants,
             [](Laboratory& laboratory, const ReferenceMotion&, double s) {
               laboratory.constants.stiffness *= 1.0 + s;
             }),
      misled("stiffness_understated", "the spring is stiffer than stated",
             "twice the share by which the stated stiffness is too small", Family::constants,
             [](Laboratory& laboratory, const ReferenceMotion&, double s) {
               laboratory.constants.stiffness *= 1.0 - 0.5 * s;
             })};
}

}  // namespace dualdamp::identify::departures
