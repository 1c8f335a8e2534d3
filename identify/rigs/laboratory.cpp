#include "identify/rigs/groups.hpp"

namespace dualdamp::identify::rigs {

namespace {

std::vector<double> no_values(const RigBase&, double) { return {}; }

/// The rig is as it should be; what the laboratory makes of it is not.
Rig misled(std::string_view name, std::string_view meaning, std::string_view severity, Family family,
           void (*mislead)(Laboratory&, double)) {
  Rig rig{.name = name, .meaning = meaning, .parameters = {}, .build = coulomb_viscous};
  rig.severity = severity;
  rig.largest = 1.0;
  rig.values_at = no_values;
  rig.mislead = mislead;
  rig.family = family;
  return rig;
}

}  // namespace

std::vector<Rig> laboratory_rigs() {
  return {misled("base_gain", "the sensor of the base reads too much", "gain of the sensor of y, less 1",
                 Family::sensors, [](Laboratory& laboratory, double s) { laboratory.sensors.y.gain_error = s; }),
          misled("displacement_gain", "the sensor of the mass reads too much", "gain of the sensor of x, less 1",
                 Family::sensors, [](Laboratory& laboratory, double s) { laboratory.sensors.x.gain_error = s; }),
          misled("drifting_gain", "the sensor of the mass drifts during the record",
                 "gain of the sensor of x at the last reading, less 1", Family::sensors,
                 [](Laboratory& laboratory, double s) { laboratory.sensors.x.gain_drift = s; }),
          misled("outliers", "one reading of the mass in five is off", "relative error of these readings",
                 Family::sensors,
                 [](Laboratory& laboratory, double s) {
                   laboratory.sensors.x.outlier_every = 5;
                   laboratory.sensors.x.outlier_size = s;
                 }),
          misled("late_displacement", "the sensor of the mass reads late", "lag of the readings of x [rad]",
                 Family::sensors, [](Laboratory& laboratory, double s) { laboratory.sensors.x.phase_lag = s; }),
          misled("mass_overstated", "the mass is smaller than stated", "stated mass over the true one, less 1",
                 Family::constants, [](Laboratory& laboratory, double s) { laboratory.constants.mass *= 1.0 + s; }),
          misled("stiffness_overstated", "the spring is softer than stated",
                 "stated stiffness over the true one, less 1", Family::constants,
                 [](Laboratory& laboratory, double s) { laboratory.constants.stiffness *= 1.0 + s; }),
          misled("stiffness_understated", "the spring is stiffer than stated",
                 "twice the share by which the stated stiffness is too small", Family::constants,
                 [](Laboratory& laboratory, double s) { laboratory.constants.stiffness *= 1.0 - 0.5 * s; })};
}

}  // namespace dualdamp::identify::rigs
