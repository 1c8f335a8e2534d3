#include "identify/fit/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/fit/freedom.hpp"
#include "identify/fit/residual_test.hpp"
#include "identify/statistics/huber.hpp"

namespace dualdamp::identify {

namespace {

using core::infinity;

/// Whether the stated noise of a signal is used: at least one of the fits does not contradict it.
bool is_as_stated(const std::vector<Fit>& fits, std::size_t s) {
  return std::ranges::any_of(fits, [s](const Fit& fit) {
    return fit.outcome.ok() && !std::isnan(fit.signals[s].chi2_per_freedom) &&
           scatter_beside_stated(fit.signals[s]) == ScatterBesideStated::as_stated;
  });
}

/// The least deviation of a signal in a comparison. For exact data, the residuals are only rounding.
double least_deviation(const FittedSignal& signal) {
  constexpr double least = 1e-12;
  return least * signal.range + std::numeric_limits<double>::min();
}

/// -2 ln of the largest likelihood of a signal, without a constant.
double plain_deviance_of(const FittedSignal& signal, bool as_stated) {
  const double deviation = std::max(as_stated ? signal.noise : signal.rms, least_deviation(signal));
  const double misfit = signal.rms / deviation;
  const auto size = static_cast<double>(signal.rows.size());
  return size * (2.0 * std::log(deviation / signal.range) + misfit * misfit);
}

/// The deviance: the same of all signals, per reading.
double deviance_of(const Fit& fit, const std::vector<Fit>& fits) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t s = 0; s < fit.signals.size(); ++s) {
    const FittedSignal& signal = fit.signals[s];
    sum += plain_deviance_of(signal, is_as_stated(fits, s));
    count += static_cast<double>(signal.rows.size());
  }
  return sum / count;
}

/// What Huber's sum says in place of the deviance.
struct RobustDeviance {
  double sum = 0.0;  ///< over readings
  double psi_squared = 0.0;
  double psi_slope = 0.0;
};

/// The deviation of a signal for the comparison of all fits, and the residuals whose deviation it is (`reference`).
struct CommonDeviation {
  double deviation = infinity;
  const FittedSignal* reference = nullptr;  ///< null: no fit has the degrees of freedom that show the deviation
};

/// That of the fit with the least one. The fits have different degrees of freedom: without these, the richest law
/// would make the deviation of few readings tiny, and every other law far too poor.
CommonDeviation common_deviation(const std::vector<Fit>& fits, std::size_t s) {
  CommonDeviation least;
  for (const Fit& fit : fits) {
    if (!fit.outcome.ok() || fit.signals[s].freedom < least_freedom || fit.signals[s].misses.size() == 0) continue;
    const double own = robust_deviation(fit.signals[s].misses, fit.signals[s].freedom).deviation;
    if (own < least.deviation) least = {own, &fit.signals[s]};
  }
  return least;
}

/// What stands for the sum of squares of the reference over its variance: the degrees of freedom, or Huber's sum if
/// that is larger, where an outlier counts no more than at the limit of what is none. If only a part of the
/// readings has the least deviation, they have it in part by choice.
double sum_of_reference(const CommonDeviation& common, double deviation) {
  const Eigen::VectorXd residuals =
      (common.reference->misses / deviation).cwiseMax(-rare_residual).cwiseMin(rare_residual);
  return std::max(common.reference->freedom, huber_sum(residuals));
}

/// A stated noise: Huber's sum. Else as the likelihood with a deviation of its own for each fit: its mean square is
/// the common variance times (sum of the reference + difference of Huber's sums)/n. For normal readings within the
/// bound this is the mean square itself; equal outliers of two laws leave the difference.
RobustDeviance robust_deviance_of(const FittedSignal& signal, bool as_stated, const CommonDeviation& common) {
  const auto size = static_cast<double>(signal.rows.size());
  const double deviation = std::max(as_stated ? signal.noise : common.deviation, least_deviation(signal));
  const double count = std::max(1.0, static_cast<double>(signal.misses.size()));
  const Eigen::VectorXd residuals = signal.misses / deviation;
  RobustDeviance result;
  // The parameters have reduced the residuals.
  const double reduced = count / std::clamp(signal.freedom, 1.0, count);
  result.psi_squared = size / count * reduced * huber_scores(residuals).squaredNorm();
  result.psi_slope = size / count * static_cast<double>((residuals.array().abs() <= huber_bound).count());
  result.sum = size * 2.0 * std::log(deviation / signal.range);
  if (as_stated) {
    result.sum += size / count * huber_sum(residuals);
    return result;
  }
  const double growth = huber_sum(residuals) - huber_sum(common.reference->misses / deviation);
  const double sum = std::max(sum_of_reference(common, deviation) + growth, least_freedom);
  result.sum += size * (std::log(sum / count) + 1.0);
  return result;
}

/// Sets the deviances, and returns what a parameter of the best fit counts, over what it counts in AICc.
double set_robust_deviances(std::vector<Fit>& fits) {
  double least = infinity;
  double of_parameter = 1.0;
  for (Fit& fit : fits) {
    if (!fit.outcome.ok()) continue;
    RobustDeviance all;
    double count = 0.0;
    for (std::size_t s = 0; s < fit.signals.size(); ++s) {
      const FittedSignal& signal = fit.signals[s];
      const bool as_stated = is_as_stated(fits, s);
      const CommonDeviation common = as_stated ? CommonDeviation{} : common_deviation(fits, s);
      count += static_cast<double>(signal.rows.size());
      if (!as_stated && common.reference == nullptr) {
        all.sum += plain_deviance_of(signal, false);
        continue;
      }
      const RobustDeviance one = robust_deviance_of(signal, as_stated, common);
      all = {all.sum + one.sum, all.psi_squared + one.psi_squared, all.psi_slope + one.psi_slope};
    }
    fit.deviance = all.sum / count;
    if (!(fit.deviance < least)) continue;
    least = fit.deviance;
    of_parameter = all.psi_slope > 0.0 ? all.psi_squared / all.psi_slope : 1.0;
  }
  return of_parameter;
}

}  // namespace

void compare_fits(std::vector<Fit>& fits, bool robust) {
  const double share = robust ? set_robust_deviances(fits) : 1.0;
  for (Fit& fit : fits)
    if (fit.outcome.ok() && !robust) fit.deviance = deviance_of(fit, fits);
  const auto least =
      std::ranges::min_element(fits, {}, [](const Fit& fit) { return fit.outcome.ok() ? fit.deviance : infinity; });
  if (least == fits.end()) return;
  const double count = least->log_likelihood_count;
  for (Fit& fit : fits) {
    const double K = static_cast<double>(fit.parameters.size() + fit.signals.size());
    if (fit.outcome.ok() && count - K - 1.0 > 0.5)
      fit.AICc = count * fit.deviance + share * (2.0 * K + 2.0 * K * (K + 1.0) / (count - K - 1.0));
  }
}

std::string warning_of_weights(const std::vector<Fit>& fits) {
  constexpr double enough = 10.0;
  const auto is_compared = [](const Fit& fit) { return fit.outcome.ok() && !std::isnan(fit.AICc); };
  if (std::ranges::count_if(fits, is_compared) < 2) return {};
  const Fit& best =
      *std::ranges::min_element(fits, {}, [&](const Fit& fit) { return is_compared(fit) ? fit.AICc : infinity; });
  double freedom = 0.0;
  for (std::size_t s = 0; s < best.signals.size(); ++s) {
    if (is_as_stated(fits, s)) return {};
    freedom += best.signals[s].freedom;
  }
  if (!(freedom < enough)) return {};
  return "the weights of the laws rest on " + core::format_number(freedom, 2) +
         " degrees of freedom and on no stated noise: by chance a wrong law may take nearly all the weight; state the "
         "noise of the signals, or measure more";
}

}  // namespace dualdamp::identify
