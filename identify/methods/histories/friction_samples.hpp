#pragma once
/// The friction force from the balance of the other forces,  k (y - x) + f - m a,  at the samples of a history.

#include <vector>

#include "identify/method.hpp"
#include "identify/records/usable_histories.hpp"

namespace dualdamp::identify {

/// One history: signals as `prepared_history` gives them, and the friction force, viscous and Coulomb friction
/// together.
struct FrictionSamples {
  int number = 0;
  PreparedHistory motion;
  std::vector<double> force;  ///< N
};

/// If the acceleration was measured and the velocity was not, the velocity is the central difference and five-point
/// average of the paper; otherwise it is that of `prepared_history` with the first cut-off. Empty: the estimate has
/// been refused, for mass and stiffness (0: none) must be known.
[[nodiscard]] std::vector<FrictionSamples> friction_samples(const Record& record, const KnownConstants& constants,
                                                            const RegressionOptions& options, Estimate& estimate);

/// Samples slower than this are left out [m/s]: the option, or a twentieth of the largest speed.
[[nodiscard]] double least_speed_for(const std::vector<FrictionSamples>& histories,
                                     const RegressionOptions& options);

}  // namespace dualdamp::identify
