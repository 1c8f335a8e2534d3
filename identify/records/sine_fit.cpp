#include "identify/records/sine_fit.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <optional>

#include "core/angle.hpp"
#include "core/constants.hpp"
#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Dirichlet's kernel: the sum of cos(angle tau) over n samples tau = -(n-1)/2, ..., (n-1)/2.
double dirichlet(double angle, double n) {
  const double half = std::remainder(0.5 * angle, std::numbers::pi);
  if (std::abs(half) < 1e-9) return n;
  return std::sin(n * half) / std::sin(half);
}

/// The columns 1, cos k theta tau and sin k theta tau of all samples. tau counts from the middle of the record, so
/// cosines and sines are orthogonal, and the sums of their products are values of Dirichlet's kernel.
class Basis {
 public:
  Basis(std::size_t samples, double theta, int harmonics)
      : samples_(samples),
        theta_(theta),
        harmonics_(harmonics),
        even_(Index{harmonics} + 1),
        odd_(Index{harmonics}) {
    const auto n = static_cast<double>(samples);
    MatrixXd even(even_, even_);
    MatrixXd odd(odd_, odd_);
    for (Index j = 0; j < even_; ++j)
      for (Index k = 0; k < even_; ++k) {
        const double difference = dirichlet(static_cast<double>(j - k) * theta, n);
        const double sum = dirichlet(static_cast<double>(j + k) * theta, n);
        even(j, k) = 0.5 * (difference + sum);
        if (j > 0 && k > 0) odd(j - 1, k - 1) = 0.5 * (difference - sum);
      }
    even_gram_.emplace(even);
    odd_gram_.emplace(odd);
  }

  [[nodiscard]] bool is_regular() const { return even_gram_->is_regular() && odd_gram_->is_regular(); }
  [[nodiscard]] Index size() const { return even_ + odd_; }

  /// Calls `take(i, tau, columns)` for every sample; columns in the order 1, cosines, sines.
  template <typename Take>
  void for_each_sample(Take take) const {
    constexpr std::size_t restart = 256;  // rotations accumulate rounding errors over at most so many samples
    const double middle = 0.5 * static_cast<double>(samples_ - 1);
    VectorXd columns = VectorXd::Ones(size());
    VectorXd turn_cos(odd_);
    VectorXd turn_sin(odd_);
    for (Index k = 0; k < odd_; ++k) {
      turn_cos(k) = std::cos(static_cast<double>(k + 1) * theta_);
      turn_sin(k) = std::sin(static_cast<double>(k + 1) * theta_);
    }
    for (std::size_t i = 0; i < samples_; ++i) {
      const double tau = static_cast<double>(i) - middle;
      for (Index k = 0; k < odd_; ++k) {
        double& c = columns(1 + k);
        double& s = columns(even_ + k);
        if (i % restart == 0) {
          const double angle = static_cast<double>(k + 1) * theta_ * tau;
          c = std::cos(angle);
          s = std::sin(angle);
        } else {
          const double turned = c * turn_cos(k) - s * turn_sin(k);
          s = s * turn_cos(k) + c * turn_sin(k);
          c = turned;
        }
      }
      take(i, tau, columns);
    }
  }

  [[nodiscard]] VectorXd solve(const VectorXd& moments) const {
    VectorXd result(size());
    result.head(even_) = even_gram_->solve(moments.head(even_));
    result.tail(odd_) = odd_gram_->solve(moments.tail(odd_));
    return result;
  }

  [[nodiscard]] MatrixXd inverse() const {
    MatrixXd result = MatrixXd::Zero(size(), size());
    result.topLeftCorner(even_, even_) = even_gram_->inverse();
    result.bottomRightCorner(odd_, odd_) = odd_gram_->inverse();
    return result;
  }

  [[nodiscard]] double theta() const { return theta_; }
  [[nodiscard]] int harmonics() const { return harmonics_; }
  [[nodiscard]] Index cosine(int k) const { return k; }
  [[nodiscard]] Index sine(int k) const { return even_ - 1 + k; }

 private:
  std::size_t samples_;
  double theta_;
  int harmonics_;
  Index even_;
  Index odd_;
  std::optional<DefiniteMatrix> even_gram_;
  std::optional<DefiniteMatrix> odd_gram_;
};

/// The linear fit at one frequency, and its derivative by the frequency.
struct Trial {
  VectorXd coefficients;
  double sum_of_squares = 0.0;
  double lagged_product = 0.0;  ///< sum of products of neighbouring residuals
  VectorXd slope_moments;       ///< products of the derivative d by theta with the basis
  double slope_square = 0.0;    ///< square of the part of d that is orthogonal to the basis
  double step = 0.0;            ///< Gauss-Newton, in theta
};

Trial fit_at(const Basis& basis, std::span<const double> signal) {
  Trial trial;
  VectorXd moments = VectorXd::Zero(basis.size());
  // The mean is subtracted, since a large offset would cost digits.
  const double mean = std::reduce(signal.begin(), signal.end()) / static_cast<double>(signal.size());
  basis.for_each_sample(
      [&](std::size_t i, double, const VectorXd& columns) { moments.noalias() += (signal[i] - mean) * columns; });
  trial.coefficients = basis.solve(moments);

  trial.slope_moments = VectorXd::Zero(basis.size());
  double square = 0.0;
  double product = 0.0;
  double last = 0.0;
  VectorXd turned = VectorXd::Zero(basis.size());  // d = tau * (turned . columns)
  for (int k = 1; k <= basis.harmonics(); ++k) {
    turned(basis.sine(k)) = -k * trial.coefficients(basis.cosine(k));
    turned(basis.cosine(k)) = k * trial.coefficients(basis.sine(k));
  }
  basis.for_each_sample([&](std::size_t i, double tau, const VectorXd& columns) {
    const double residual = signal[i] - mean - trial.coefficients.dot(columns);
    const double d = tau * turned.dot(columns);
    trial.sum_of_squares += residual * residual;
    trial.lagged_product += i > 0 ? residual * last : 0.0;
    last = residual;
    trial.slope_moments.noalias() += d * columns;
    square += d * d;
    product += d * residual;
  });
  trial.slope_square = square - trial.slope_moments.dot(basis.solve(trial.slope_moments));
  if (trial.slope_square > 0.0) trial.step = product / trial.slope_square;
  trial.coefficients(0) += mean;
  return trial;
}

/// Amplitudes and phases at the first sample; errors of the amplitudes from the coefficients and the frequency.
void describe(SineFit& fit, const Basis& basis, const Trial& trial, std::size_t samples, bool refined) {
  const double parameters = static_cast<double>(basis.size()) + (refined ? 1.0 : 0.0);
  const double variance = trial.sum_of_squares / (static_cast<double>(samples) - parameters);
  const double middle = 0.5 * static_cast<double>(samples - 1);
  const VectorXd lever = basis.solve(trial.slope_moments);
  const double theta_variance = refined ? variance / trial.slope_square : 0.0;
  const MatrixXd covariance = variance * basis.inverse() + theta_variance * lever * lever.transpose();

  fit.noise = std::sqrt(variance);
  fit.correlation = trial.sum_of_squares > 0.0 ? trial.lagged_product / trial.sum_of_squares : 0.0;
  fit.offset = trial.coefficients(0);
  for (int k = 1; k <= basis.harmonics(); ++k) {
    const Index c = basis.cosine(k);
    const Index s = basis.sine(k);
    const double a = trial.coefficients(c);
    const double b = trial.coefficients(s);
    const double amplitude = std::hypot(a, b);
    // a cos + b sin = A cos(k theta tau - psi); the first sample is at tau = -middle.
    const double phase = -std::atan2(b, a) - k * middle * basis.theta();
    Harmonic harmonic{amplitude, core::wrapped(phase), 0.0};
    if (amplitude > 0.0) {
      const double cos = a / amplitude;
      const double sin = b / amplitude;
      harmonic.amplitude_std = std::sqrt(cos * cos * covariance(c, c) + sin * sin * covariance(s, s) +
                                         2.0 * sin * cos * covariance(c, s));
    }
    fit.harmonics.push_back(harmonic);
  }
}

std::string fault_of(std::size_t samples, double theta, const SineFitOptions& options) {
  if (samples <= 2 * static_cast<std::size_t>(options.harmonics) + 2)
    return "there are fewer samples than unknowns";
  if (!(theta > 0.0)) return "there is no frequency to fit a sine of";
  constexpr double rounding = 1e-9;  // rounding may make a period of a whole number of samples slightly longer
  if (theta * static_cast<double>(samples) < core::two_pi * (1.0 - rounding))
    return "the record is shorter than one period";
  if (theta * options.harmonics >= std::numbers::pi)
    return "the highest harmonic lies beyond half of the sample rate";
  return {};
}

SineFit refused(std::string reason) {
  SineFit fit;
  fit.outcome = {core::OutcomeKind::not_identifiable, std::move(reason)};
  return fit;
}

/// The fitted waveform, or its derivative, at an angle of the fundamental.
double waveform(const SineFit& fit, double angle, bool derivative) {
  double value = 0.0;
  for (std::size_t i = 0; i < fit.harmonics.size(); ++i) {
    const auto k = static_cast<double>(i + 1);
    const double phase = k * angle + fit.harmonics[i].phase;
    value += fit.harmonics[i].amplitude * (derivative ? -k * std::sin(phase) : std::cos(phase));
  }
  return value;
}

/// The largest value of `sign` times the waveform, without its offset.
double extreme(const SineFit& fit, double sign) {
  const int grid = 32 * static_cast<int>(fit.harmonics.size());
  const double cell = core::two_pi / grid;
  int best = 0;
  for (int i = 1; i < grid; ++i)
    if (sign * waveform(fit, i * cell, false) > sign * waveform(fit, best * cell, false)) best = i;
  double low = (best - 1) * cell;
  double high = (best + 1) * cell;
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (sign * waveform(fit, middle, true) > 0.0 ? low : high) = middle;
  }
  return sign * waveform(fit, 0.5 * (low + high), false);
}

}  // namespace

SineFit fit_sine(std::span<const double> signal, double sample_rate, double omega, const SineFitOptions& options) {
  double theta = omega / sample_rate;
  if (std::string fault = fault_of(signal.size(), theta, options); !fault.empty()) return refused(std::move(fault));
  const auto n = static_cast<double>(signal.size());
  constexpr int most_steps = 30;
  for (int i = 0; i <= most_steps; ++i) {
    const Basis basis(signal.size(), theta, options.harmonics);
    if (!basis.is_regular()) return refused("so short a record does not distinguish the harmonics");
    const Trial trial = fit_at(basis, signal);
    // The model is linear only for steps of less than a quarter of a turn over the record.
    const double step = std::clamp(trial.step, -std::numbers::pi / 2.0 / n, std::numbers::pi / 2.0 / n);
    if (options.refine && !(trial.slope_square > 0.0)) return refused("a constant signal has no frequency");
    if (!options.refine || std::abs(step) * n < 1e-10) {
      SineFit fit;
      fit.omega = theta * sample_rate;
      describe(fit, basis, trial, signal.size(), options.refine);
      if (options.refine) fit.omega_std = fit.noise / std::sqrt(trial.slope_square) * sample_rate;
      return fit;
    }
    theta += step;
    if (std::string fault = fault_of(signal.size(), theta, options); !fault.empty())
      return refused(std::move(fault));
  }
  return refused("the frequency does not converge");
}

double guess_frequency(std::span<const double> signal, double sample_rate) {
  if (signal.empty()) return unknown;
  const auto n = static_cast<double>(signal.size());
  const double mean = std::reduce(signal.begin(), signal.end()) / n;
  double square = 0.0;
  for (const double value : signal) square += (value - mean) * (value - mean);
  const double band = 0.5 * std::sqrt(square / n);
  double first = 0.0;
  double last = 0.0;
  int crossings = 0;
  bool armed = false;  // whether the signal was below the band since the last crossing
  std::size_t below = 0;
  for (std::size_t i = 0; i < signal.size(); ++i) {
    const double value = signal[i] - mean;
    if (value < 0.0) below = i;
    if (value < -band) armed = true;
    if (!armed || value <= band) continue;
    armed = false;
    // The crossing is interpolated in the last step from below the mean.
    const double under = mean - signal[below];
    last = static_cast<double>(below) + under / (under + signal[below + 1] - mean);
    if (crossings++ == 0) first = last;
  }
  return crossings < 3 ? unknown : core::two_pi * (crossings - 1) / (last - first) * sample_rate;
}

double half_peak_to_peak(const SineFit& fit) {
  return fit.harmonics.empty() ? 0.0 : 0.5 * (extreme(fit, 1.0) + extreme(fit, -1.0));
}

double mean_square_derivative(const SineFit& fit) {
  double sum = 0.0;
  for (std::size_t i = 0; i < fit.harmonics.size(); ++i) {
    const double speed = static_cast<double>(i + 1) * fit.omega * fit.harmonics[i].amplitude;
    sum += 0.5 * speed * speed;
  }
  return sum;
}

}  // namespace dualdamp::identify
