#pragma once
/// The variance of the estimates that the residuals of one signal cause, over that of readings of deviation one.
///
/// Least squares: sum r_i^2/f, r_i: residual over the deviation of the weights. Huber's estimate: his factor V
/// times the square of the deviation of the residuals that are no outliers (`huber.hpp`). A stated noise is used
/// unless the residuals are larger than chance explains; with outliers, V still follows the residuals.

#include "identify/fit/intervals/uncertainty.hpp"

namespace dualdamp::identify {

struct SignalVariance {
  double variance = 1.0;
  double freedom = 0.0;  ///< degrees of freedom of it; infinite: stated
  bool is_open = false;  ///< the noise is neither stated nor shown
};
[[nodiscard]] SignalVariance signal_variance(const FitEnd& end, const FittedSignal& signal);

}  // namespace dualdamp::identify
