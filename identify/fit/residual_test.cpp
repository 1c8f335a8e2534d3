#include "identify/fit/residual_test.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "identify/statistics/distributions.hpp"
#include "identify/statistics/median.hpp"

namespace dualdamp::identify {

namespace {

/// The largest length up to `count` with only the prime factors 2, 3 and 5. Other lengths are slow to transform.
Eigen::Index quick_length(Eigen::Index count) {
  for (Eigen::Index length = count;; --length) {
    Eigen::Index rest = length;
    for (const Eigen::Index factor : {2, 3, 5})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return length;
  }
}

/// The power at 1, 2, ... periods per length of the signal, below half the sample rate.
std::vector<double> powers(const Eigen::VectorXd& signal) {
  const Eigen::Index length = quick_length(signal.size());
  const double mean = signal.head(length).mean();
  std::vector<double> values;
  for (Eigen::Index i = 0; i < length; ++i) values.push_back(signal[i] - mean);
  std::vector<std::complex<double>> lines;
  Eigen::FFT<double> transform;
  transform.fwd(lines, values);
  std::vector<double> power;
  for (std::size_t j = 1; j < static_cast<std::size_t>((length + 1) / 2); ++j) power.push_back(std::norm(lines[j]));
  return power;
}

/// Keeps the frequencies up to the cut-off of a filter that the noise has passed, and divides their power by that
/// of its gain: what remains of noise is white again.
void whiten(const ZeroPhaseFilter& filter, Eigen::Index length, std::vector<double>& power) {
  constexpr double half = 0.5;
  for (std::size_t j = 0; j < power.size(); ++j) {
    const double gain = filter.gain(static_cast<double>(j + 1) / static_cast<double>(length));
    if (gain < half) return power.resize(j);
    power[j] /= gain * gain;
  }
}

/// What a line of noise alone hardly has, if this is the noise at all lines: twice what the largest one has.
double largest_of_noise(const std::vector<double>& left) {
  // The median of an exponential variable is ln 2 of its mean. Lines of motion hardly move it.
  return 2.0 * std::log(static_cast<double>(left.size())) * upper_median(left) / std::numbers::ln2;
}

/// The power of the motion at each line, which the residual of this line has not made: what the fitted and the
/// measured signal share, or what the measured one has at both lines beside it. The first lacks what the fit has
/// not found, the second a single line.
std::vector<double> powers_of_motion(const std::vector<double>& fitted, const std::vector<double>& measured,
                                     double of_noise) {
  std::vector<double> motion;
  for (std::size_t j = 0; j < fitted.size(); ++j) {
    const double before = measured[j > 0 ? j - 1 : j + 1];
    const double beside = std::min(before, j + 1 < fitted.size() ? measured[j + 1] : before);
    const double shared = std::min(fitted[j], measured[j]);
    motion.push_back(beside > of_noise ? std::max(shared, beside) : shared);
  }
  return motion;
}

double p_value_of_motion(const Signal& signal, const Eigen::VectorXd& measured, const Eigen::VectorXd& outputs,
                         const Eigen::VectorXd& residuals) {
  const auto lines_of = [&](const Eigen::VectorXd& samples) {
    std::vector<double> lines = powers(samples);
    if (signal.filter) whiten(*signal.filter, quick_length(samples.size()), lines);
    return lines;
  };
  const std::vector<double> left = lines_of(residuals);
  if (left.size() < 2) return unknown;
  const double of_noise = largest_of_noise(left);
  const std::vector<double> motion = powers_of_motion(lines_of(outputs), lines_of(measured), of_noise);
  std::vector<std::size_t> order(motion.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return motion[a] > motion[b]; });
  const double whole = std::accumulate(motion.begin(), motion.end(), 0.0);
  const double total = std::accumulate(left.begin(), left.end(), 0.0);
  const auto is_needed = [&](std::size_t line, double held) {
    constexpr double most_of_it = 0.99;
    return held < most_of_it * whole && motion[line] > of_noise;
  };
  constexpr std::size_t least = 8;
  double held = 0.0;
  double inside = 0.0;
  std::size_t count = 0;
  for (; count < order.size() / 2 && (count < least || is_needed(order[count], held)); ++count) {
    held += motion[order[count]];
    inside += left[order[count]];
  }
  const auto b = static_cast<double>(count);
  const auto r = static_cast<double>(order.size() - count);
  if (!(total > inside)) return unknown;
  return f_test_p_value(inside / b / ((total - inside) / r), 2.0 * b, 2.0 * r);
}

}  // namespace

bool is_rounding(const Eigen::VectorXd& residuals, const Eigen::VectorXd& measured) {
  constexpr double exact = 1e-5;
  return residuals.norm() <= exact * (measured.array() - measured.mean()).matrix().norm();
}

double noise_p_value(const Signal& signal, const Eigen::VectorXd& outputs, const Eigen::VectorXd& residuals,
                     double spent) {
  const Eigen::VectorXd measured = Eigen::Map<const Eigen::VectorXd>(signal.measured.data(), residuals.size());
  if (is_rounding(residuals, measured)) return unknown;
  if (signal.is_sampled)
    return residuals.size() < least_test_samples ? unknown
                                                 : p_value_of_motion(signal, measured, outputs, residuals);
  const double freedom = static_cast<double>(residuals.size()) - spent;
  if (!signal.is_stated || freedom < 1.0) return unknown;
  return chi_square_p_value(residuals.squaredNorm() / (signal.noise * signal.noise), freedom);
}

Eigen::VectorXd bounded_residuals(const Eigen::VectorXd& residuals, const Eigen::VectorXd& weights) {
  const double largest = weights.size() > 0 ? weights.maxCoeff() : 0.0;
  if (!(largest > 0.0)) return residuals;
  return residuals.cwiseProduct((weights / largest).cwiseAbs2());
}

bool is_noise(double p_value) {
  constexpr double level = 1e-3;
  return !(p_value < level);
}

void compare_with_stated(double deviation, double freedom, FittedSignal& signal) {
  if (!(signal.noise > 0.0) || !(freedom >= 1.0)) return;
  const double ratio = deviation / signal.noise;
  signal.chi2_per_freedom = ratio * ratio;
  signal.chi2_p_value = stated_noise_p_value(signal.chi2_per_freedom, freedom);
}

ScatterBesideStated scatter_beside_stated(const FittedSignal& signal) {
  return scatter_beside_stated(std::sqrt(signal.chi2_per_freedom), signal.chi2_p_value);
}

}  // namespace dualdamp::identify
