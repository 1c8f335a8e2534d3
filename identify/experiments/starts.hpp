#pragma once
/// Starts of a fit: sizes of parameters without a stated value, from the data and the unit of the parameter.
///
/// The data give a force, a length, a speed and a time. A loop gives length and speed of its motion, and its force
/// bounds mass and stiffness. An acceleration a alone, of frequency w, gives the length a/w^2. The size of a
/// parameter in N/m is then force over length, times a typical ratio of friction to spring. The size may be wrong
/// by a factor, because the starts spread over two decades around it.
///
/// Steady states are often near resonance, where the force of the spring is many times that of the drive, and
/// friction is bounded by the latter. There the energy of a period gives friction and damping
/// (liang2004identifying, tomlinson1979):
///
///   P sin(phase) = (4/pi) F + c w X,   P: amplitude of the driving force, X: that of the motion
///
/// a straight line over w X. Without a phase, sin(phase) follows from P cos(phase) = (k - m w^2) X.

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "identify/experiments/experiment.hpp"
#include "identify/experiments/rig.hpp"

namespace dualdamp::identify {

struct DataScale {
  double mass = 1.0;
  double stiffness = 1.0;
  double force = 1.0;
  double length = 1.0;
  double speed = 1.0;
  /// From the energy of steady states; 0: not known.
  double friction = 0.0;
  double damping = 0.0;
};

/// Angular frequency of samples, from the crossings of their mean (`swings.hpp`) [rad/s].
[[nodiscard]] double crossing_frequency(const Signal& signal);

[[nodiscard]] DataScale scale_of(const Rig& rig, const Experiments& experiments);

/// The power of the force in an SI unit: 1 of "N.s/m", of "kg" and of "W", 0 of "m/s".
[[nodiscard]] int power_of_force(std::string_view unit);

/// Sizes of the parameters, > 0, in their units. For a stated value that is not zero: its absolute value.
[[nodiscard]] std::vector<double> sizes_of(const std::vector<FitParameter>& parameters, const DataScale& scale);

/// The largest factor between a start and the size of a parameter.
[[nodiscard]] double spread_of(const FitParameter& parameter, const DataScale& scale);

/// Start `number` (0, 1, ...). Start 0 has the stated values, and the sizes of the other parameters.
[[nodiscard]] Eigen::VectorXd start_of(const std::vector<FitParameter>& parameters,
                                       const std::vector<double>& sizes, int number, const DataScale& scale = {});

}  // namespace dualdamp::identify
