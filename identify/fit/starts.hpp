#pragma once
/// Where a fit begins: sizes of parameters nobody stated a value of, from the data and the parameter's unit.
///
/// The data give a force, a length, a speed and a time; a parameter in N/m is then of the size of force over
/// length, times a number that friction usually has beside the spring. It need not be right: the starts spread
/// over two decades about it.

#include <Eigen/Core>
#include <vector>

#include "identify/fit/experiment.hpp"
#include "identify/fit/rig.hpp"

namespace dualdamp::identify {

struct DataScale {
  double mass = 1.0;
  double stiffness = 1.0;
  double force = 1.0;
  double length = 1.0;
  double speed = 1.0;
};

/// Angular frequency of a sampled signal by its crossings of the mean [rad/s].
[[nodiscard]] double crossing_frequency(const Signal& signal);

[[nodiscard]] DataScale scale_of(const Rig& rig, const std::vector<std::unique_ptr<Experiment>>& experiments);

/// > 0: of a stated value its own, unless that is zero.
[[nodiscard]] double size_of(const FitParameter& parameter, const DataScale& scale);

/// Start `number`, 0, 1, ...: the first is the stated values and the sizes themselves.
[[nodiscard]] Eigen::VectorXd start_of(const std::vector<FitParameter>& parameters,
                                       const std::vector<double>& sizes, int number);

}  // namespace dualdamp::identify
