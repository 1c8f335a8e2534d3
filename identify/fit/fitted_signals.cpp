#include "identify/fit/fitted_signals.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "identify/fit/freedom.hpp"
#include "identify/fit/residual_test.hpp"
#include "identify/fit/serial_test.hpp"
#include "identify/statistics/huber.hpp"
#include "identify/statistics/residual_covariance.hpp"

namespace dualdamp::identify {

namespace {

double rms(const Eigen::VectorXd& part) { return std::sqrt(part.squaredNorm() / static_cast<double>(part.size())); }

/// The chance of the smaller one of two p values. Either of them may be unknown.
double either_p_value(double first, double second) {
  if (std::isnan(first)) return second;
  return std::isnan(second) ? first : std::min(1.0, 2.0 * std::min(first, second));
}

/// Readings that do not count are zero among the misses.
void set_mean(const Eigen::VectorXd& misses, double counted, bool is_sampled, FittedSignal& signal) {
  if (!is_sampled || !(counted > 1.0)) return;
  const double mean = misses.sum() / counted;
  const Eigen::VectorXd rest = (misses.array() - mean).matrix();
  const double square = (misses.squaredNorm() - counted * mean * mean) / counted;
  signal.mean = -mean;
  if (square > 0.0) signal.mean_score = -mean / std::sqrt(square / independent_samples(rest, is_sampled));
}

/// rms of the residuals of a signal; of a robust fit, of those that are no outliers.
double rms_within(const FittedSignal& signal, double counted, bool robust) {
  if (!robust || !(signal.freedom > least_freedom)) return signal.rms;
  return robust_deviation(signal.misses, signal.freedom).deviation * std::sqrt(signal.freedom / counted);
}

/// Sets the residuals of a signal, and compares their size with the noise of the sensor.
void set_size(const Signal& of, double counted, bool robust, FittedSignal& signal) {
  signal.rms_within = rms_within(signal, counted, robust);
  // Residuals far below the roughness of samples: it is that of the motion between too few samples, no noise.
  constexpr double least_noise_units = 0.5;
  const bool is_too_rough = !of.is_stated && of.is_sampled && signal.rms_within < least_noise_units * of.noise;
  if (!(of.noise > 0.0) || is_too_rough) return;
  signal.noise = of.noise;
  signal.noise_units = signal.rms_within / signal.noise;
}

}  // namespace

void describe_signals(const FitProblem& problem, const SearchResult& found, const Eigen::VectorXd& misses,
                      const Eigen::MatrixXd& jacobian, bool robust, Fit& result) {
  const FitReadings& readings = problem.readings();
  const SerialTest serial(problem, found.unbounded, found.weights, misses, jacobian);
  const std::vector<double> freedoms = freedoms_of(problem, found.weights.asDiagonal() * jacobian);
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t s = 0; s < freedoms.size(); ++s) {
    const SignalRows& rows = readings.signals()[s];
    const Signal& of = readings.signal(rows);
    const Eigen::Index size = rows.size();
    const double counted = readings.count(rows);
    const Eigen::VectorXd measured = readings.measured().segment(rows.begin, size);
    FittedSignal signal{.rows = rows, .rms = readings.rms(misses, rows), .freedom = freedoms[s]};
    signal.range = rms(measured.array() - measured.mean());
    signal.misses = readings.counted(misses, rows);
    set_size(of, counted, robust, signal);
    if (!std::isnan(signal.noise_units)) {
      sum += signal.noise_units * signal.noise_units * static_cast<double>(size);
      count += static_cast<double>(size);
    }
    const Eigen::VectorXd own = misses.segment(rows.begin, size);
    const Eigen::VectorXd bounded = bounded_residuals(own, found.weights.segment(rows.begin, size));
    signal.p_value = noise_p_value(of, measured + own, bounded, counted - signal.freedom);
    if (!of.is_sampled) signal.p_value = either_p_value(signal.p_value, serial.p_value(rows));
    set_mean(bounded, counted, of.is_sampled, signal);
    signal.independent = independent_samples(bounded, of.is_sampled);
    const std::optional<ZeroPhaseFilter>& filter = of.filter;
    signal.white = static_cast<double>(size) * (filter ? std::pow(filter->noise_gain(), 2) : 1.0);
    result.log_likelihood_count += signal.independent * counted / static_cast<double>(size);
    if (of.is_stated && signal.freedom > least_freedom) {
      const double share = signal.freedom / counted;
      const RobustDeviation deviation = robust ? robust_deviation(signal.misses, signal.freedom)
                                               : RobustDeviation{signal.rms / std::sqrt(share), signal.freedom};
      compare_with_stated(deviation.deviation, signal.independent * deviation.freedom / counted, signal);
    }
    result.signals.push_back(signal);
  }
  if (count > 0.0) result.noise_units = std::sqrt(sum / count);
}

}  // namespace dualdamp::identify
