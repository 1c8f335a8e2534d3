#pragma once
/// The drive of a model on the clock of a record.

#include <vector>

#include "sim/model.hpp"

namespace dualdamp::identify {

/// The drive as of `start` [s], for a motion of `duration` [s] whose time begins there. A chirp must not have
/// ended. Noise and samples begin with the record, so they are left as they are.
[[nodiscard]] sim::Excitation drive_from(const sim::Excitation& drive, double start, double duration);

struct DriveValues {
  std::vector<double> y;       ///< of the base [m]
  std::vector<double> y_rate;  ///< m/s
  std::vector<double> force;   ///< on the mass [N]
};

/// The drive at increasing times.
[[nodiscard]] DriveValues drive_values(const sim::Model& model, const std::vector<double>& times);

}  // namespace dualdamp::identify
