#pragma once
/// Prepares the signals of a test for a regression: filters them without lag, differentiates, trims and thins them.
///
/// A filter is linear, so the equation of motion also holds between filtered signals if ALL of them, sgn v
/// included, pass through the same filter ("parallel" filtering). The remaining error is that of the
/// differentiation; the filter removes its part above the cut-off.

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// (x[i+1] - x[i-1])/2 times the rate [Hz]; at the ends one-sided, also of second order. Zeros if there are fewer
/// than three samples. Gain relative to i w: sin(wT)/(wT).
[[nodiscard]] std::vector<double> central_difference(std::span<const double> x, double sample_rate);

/// (x[i+1] - 2 x[i] + x[i-1]) times the rate squared; the ends repeat their neighbours. Zeros if there are fewer
/// than three samples.
[[nodiscard]] std::vector<double> second_difference(std::span<const double> x, double sample_rate);

/// Derivatives by differences of seven points, of sixth order; near the ends of fewer points, as above. Gains
/// relative to i w and -w^2: 1 - (wT)^6/140 and 1 - (wT)^6/560 for small wT, so that eighteen samples of a period
/// are enough for 2e-5. They amplify the noise of the sensor like the differences above, or more: filter them.
[[nodiscard]] std::vector<double> sharp_difference(std::span<const double> x, double sample_rate);
[[nodiscard]] std::vector<double> sharp_second_difference(std::span<const double> x, double sample_rate);

/// Integral from the first sample, where it is zero, by trapezoids.
[[nodiscard]] std::vector<double> running_integral(std::span<const double> x, double sample_rate);

/// The same by cubics through four samples, except for the first and the last step.
[[nodiscard]] std::vector<double> sharp_integral(std::span<const double> x, double sample_rate);

/// Mean of x[i-2] ... x[i+2]; near the ends of fewer samples, still centred. No lag.
[[nodiscard]] std::vector<double> five_point_average(std::span<const double> x);

/// Butterworth's low-pass filter of second order, run forwards and backwards: no lag and the gain
/// 1/(1 + (tan(w T/2)/tan(wc T/2))^4), one half at the cut-off. The ends are continued by point reflection.
class ZeroPhaseFilter {
 public:
  /// Cut-off and rate in Hz, 0 < cutoff < sample_rate/2; throws a `core::InputError` for others.
  ZeroPhaseFilter(double cutoff, double sample_rate);

  [[nodiscard]] std::vector<double> operator()(std::span<const double> signal) const;
  /// Number of samples at each end that depend on the continuation of the signal.
  [[nodiscard]] std::size_t edge() const { return edge_; }
  /// The gain at a frequency, in periods per sample: 0 to 1/2.
  [[nodiscard]] double gain(double frequency) const;
  /// Deviation of filtered white noise over that of the noise: the root mean square of the gain.
  [[nodiscard]] double noise_gain() const;

 private:
  void run(std::vector<double>& signal) const;

  double b_ = 0.0;  ///< numerator b (1 + z^-1)^2
  double a1_ = 0.0;
  double a2_ = 0.0;
  double warped_ = 0.0;  ///< tan(wc T/2)
  std::size_t edge_ = 0;
};

/// What is said of a history whose displacement was not measured.
inline constexpr std::string_view without_displacement =
    "the displacement x was not recorded: record it, or add it to the file as the integral of v or a without its "
    "drift; 'dualdamp fit coulomb' takes v or a alone";

/// A history for a regression: signals of equal length after the same filter, without the edges of the filter,
/// thinned to the number of samples that the bandwidth needs.
struct PreparedHistory {
  double start = 0.0;        ///< time of the first sample [s]
  double sample_rate = 0.0;  ///< Hz
  std::vector<double> y, x, v, a, force;
  std::vector<double> sign;  ///< sgn v
  std::vector<double> drag;  ///< v |v| [m^2/s^2]
};

/// Velocity and acceleration are those of the history or, if they were not measured, derivatives of x. y and force
/// are zero if they were not measured. `cutoff` [Hz]; 0: no filter, no trimming, no thinning. `fault_of` and
/// `fault_of_cutoff` (`usable_histories.hpp`) must find no fault.
[[nodiscard]] PreparedHistory prepared_history(const History& history, double cutoff);

}  // namespace dualdamp::identify
