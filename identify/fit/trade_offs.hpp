#pragma once
/// What the data of a fit cannot tell apart, in words.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/fit/fit.hpp"

namespace dualdamp::identify {

/// A direction of the parameters along which the data allow a change.
struct WeakDirection {
  Eigen::VectorXd change;  ///< of the values, for one unit along it
  Eigen::VectorXd share;   ///< of each parameter, in parts of its size; of length 1
  Eigen::VectorXd effect;  ///< of each share on the readings, by size
  double deviation = 0.0;  ///< standard deviation along it, in these parts; infinite: nothing holds it
};

[[nodiscard]] TradeOff trade_off(const WeakDirection& direction, const std::vector<FitParameter>& parameters);

}  // namespace dualdamp::identify
