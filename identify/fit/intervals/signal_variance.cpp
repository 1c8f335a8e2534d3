#include "identify/fit/intervals/signal_variance.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "identify/fit/freedom.hpp"
#include "identify/statistics/huber.hpp"

namespace dualdamp::identify {

namespace {

using core::infinity;

/// Whether a mean square, over the stated variance, is no larger than chance explains.
bool agrees_with_stated(double square, double freedom) {
  constexpr double errors = 3.0;
  return square < 1.0 + errors * std::sqrt(2.0 / freedom);
}

/// Of the readings that count as independent, those that the parameters and the outliers leave.
double freedom_left(const FittedSignal& signal, double count, double freedom) {
  const double independent = signal.independent * count / static_cast<double>(signal.rows.size());
  return std::max(1.0, independent - (count - freedom));
}

SignalVariance plain_variance(const FitEnd& end, const FittedSignal& signal) {
  const SignalRows& rows = signal.rows;
  const Eigen::Index size = rows.size();
  const double count = end.problem.readings().count(rows);
  const double freedom = std::max(signal.freedom, least_freedom);
  const double own =
      end.unbounded.segment(rows.begin, size).cwiseProduct(end.misses.segment(rows.begin, size)).squaredNorm() /
      freedom;
  const bool is_stated = end.problem.readings().signal(rows).is_stated;
  const bool as_stated = is_stated && agrees_with_stated(own, freedom);
  const bool is_open = !is_stated && signal.freedom < least_freedom;
  return {as_stated || is_open ? 1.0 : own, as_stated ? infinity : freedom_left(signal, count, signal.freedom),
          is_open};
}

SignalVariance robust_variance(const FitEnd& end, const FittedSignal& signal) {
  const SignalRows& rows = signal.rows;
  const double weight = end.unbounded.segment(rows.begin, rows.size()).maxCoeff();
  const Eigen::VectorXd residuals = weight * end.problem.readings().counted(end.misses, rows);
  const auto count = static_cast<double>(residuals.size());
  const double freedom = std::max(signal.freedom, least_freedom);
  const RobustDeviation own = robust_deviation(residuals, freedom);
  const double square = own.deviation * own.deviation;
  const bool is_stated = end.problem.readings().signal(rows).is_stated;
  const bool as_stated = is_stated && agrees_with_stated(square, own.freedom);
  const double outliers = static_cast<double>((residuals.array().abs() > rare_residual).count()) / count;
  SignalVariance result{.variance = normal_huber_variance(huber_bound, 0.0),
                        .freedom = freedom_left(signal, count, own.freedom),
                        .is_open = !is_stated && signal.freedom < least_freedom};
  if (as_stated && outliers == 0.0)
    result.freedom = infinity;
  else if (as_stated)
    result.variance = huber_variance(residuals, freedom, outliers);
  else if (is_stated)  // and far too small: the weights hardly differ from those of the median
    result.variance = square * normal_huber_variance(huber_bound / own.deviation, std::min(own.outliers, 0.5));
  else if (!result.is_open && own.deviation > 0.0)
    result.variance = square * huber_variance(residuals / own.deviation, freedom, own.outliers);
  else if (!result.is_open)
    result.variance = residuals.squaredNorm() / freedom;
  return result;
}

}  // namespace

SignalVariance signal_variance(const FitEnd& end, const FittedSignal& signal) {
  const bool counts = end.problem.readings().count(signal.rows) > 0.0;
  return end.robust && counts ? robust_variance(end, signal) : plain_variance(end, signal);
}

}  // namespace dualdamp::identify
