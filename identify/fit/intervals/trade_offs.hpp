#pragma once
/// Describes in words the parameters that the data of a fit cannot separate.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/units.hpp"
#include "identify/fit/fit.hpp"

namespace dualdamp::identify {

/// A direction of the parameters along which the data allow a change.
struct WeakDirection {
  Eigen::VectorXd change;  ///< of the values, for one unit along the direction
  Eigen::VectorXd share;   ///< the direction in units of the parameters' sizes; of length 1
  Eigen::VectorXd effect;  ///< of each component on the readings, absolute
  double deviation = 0.0;  ///< standard deviation along it, in units of `share`; infinite: not determined
  double rounding = 0.0;   ///< a smaller `effect` may be rounding
  /// One unit of `share` of a parameter whose own value is too small to be a unit, in its unit; else 0.
  Eigen::VectorXd near_zero;
  /// How far the profile of each parameter lets it go from its value, in its unit; infinite: the profile does not
  /// end in the range; `unknown`: no end was found, or there is no profile. The deviation holds near the estimate
  /// only: at the end of a range, where an effect begins, it says nothing.
  Eigen::VectorXd reach;
};

[[nodiscard]] std::optional<TradeOff> trade_off(const WeakDirection& direction,
                                                const std::vector<FitParameter>& parameters,
                                                core::Coordinate coordinate);

/// How far the profiles let the parameters go. That of a parameter at an end of its range ends on one side only.
[[nodiscard]] Eigen::VectorXd reaches(const std::vector<FittedParameter>& parameters);

/// What the profile says of a parameter that has no effect near the estimate: "the data show of exponent only that
/// it is above 1.8".
[[nodiscard]] TradeOff known_further_off(const FittedParameter& fitted, core::Coordinate coordinate);

}  // namespace dualdamp::identify
