#pragma once
/// Signals of a test made ready for a regression: filtered without lag, differentiated, trimmed and thinned.
///
/// A filter is linear, so that the equation of motion holds between filtered signals as well as between raw ones,
/// provided that ALL of them pass through the same filter, sgn v included ("parallel" filtering). What remains to
/// be wrong is the differentiation, whose error beyond the cut-off is then removed.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "identify/method.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// (x[i+1] - x[i-1])/2 times the rate [Hz]; at the ends the same second order one-sided. Zeros from fewer than
/// three samples. Gain on i w: sin(wT)/(wT).
[[nodiscard]] std::vector<double> central_difference(std::span<const double> x, double sample_rate);

/// (x[i+1] - 2 x[i] + x[i-1]) times the rate squared; the ends repeat their neighbours. Zeros from fewer than three
/// samples.
[[nodiscard]] std::vector<double> second_difference(std::span<const double> x, double sample_rate);

/// From zero at the first sample on, by trapezoids.
[[nodiscard]] std::vector<double> running_integral(std::span<const double> x, double sample_rate);

/// Mean of x[i-2] ... x[i+2]; towards the ends of fewer samples, still centred. No lag.
[[nodiscard]] std::vector<double> five_point_average(std::span<const double> x);

/// What that makes of a sine at `omega` [rad/s]: (1 + 2 cos wT + 2 cos 2wT)/5.
[[nodiscard]] double five_point_gain(double omega, double sample_rate);

/// Butterworth's low-pass filter of second order, run forwards and backwards: no lag and the gain
/// 1/(1 + (tan(w T/2)/tan(wc T/2))^4), one half at the cut-off. The ends are continued by point reflection.
class ZeroPhaseFilter {
 public:
  /// Cut-off and rate in Hz, 0 < cutoff < sample_rate/2; throws a `core::InputError` for others.
  ZeroPhaseFilter(double cutoff, double sample_rate);

  [[nodiscard]] std::vector<double> operator()(std::span<const double> signal) const;
  /// Samples at each end that depend on how the signal was continued there.
  [[nodiscard]] std::size_t edge() const { return edge_; }

 private:
  void run(std::vector<double>& signal) const;

  double b_ = 0.0;  ///< numerator b (1 + z^-1)^2
  double a1_ = 0.0;
  double a2_ = 0.0;
  std::size_t edge_ = 0;
};

/// One history, ready: signals of equal length, through one filter, without its edges, and no more samples than
/// its bandwidth needs.
struct Motion {
  double start = 0.0;        ///< time of the first sample [s]
  double sample_rate = 0.0;  ///< Hz
  std::vector<double> y, x, v, a, force;
  std::vector<double> sign;  ///< sgn v
  std::vector<double> drag;  ///< v |v| [m^2/s^2]
};

/// Velocity and acceleration are taken from the history or, where they were not measured, differentiated from x.
/// `cutoff` [Hz] 0: no filter, nothing trimmed or thinned. y and force that were not measured are zero. The
/// history must be sound (`fault_of`), and longer than the filter's edges.
[[nodiscard]] Motion motion_of(const History& history, double cutoff);

/// Cut-offs to use [Hz]: those of the options, or else the method's own choice: a twentieth of the rate, or eight
/// times the mean frequency of the motion where that is more, and 0.6 and 0.4 of it; no filter at all (one cut-off
/// 0) where velocity and acceleration were measured.
[[nodiscard]] std::vector<double> cutoffs_for(const History& history, const FilterOptions& options);

/// Why a history cannot be used at all: no x, signals of different length or not finite, no rate; empty: it can.
[[nodiscard]] std::string fault_of(const History& history);

/// Why it cannot be filtered like that; empty when it can.
[[nodiscard]] std::string fault_of_cutoff(const History& history, double cutoff);

/// Histories that can be used with this cut-off choice, by their numbers from 1; the others go to the estimate's
/// exclusions. None: the estimate has been refused.
struct NumberedHistory {
  int number = 0;
  const History* history = nullptr;
};
[[nodiscard]] std::vector<NumberedHistory> usable_histories(const Record& record, const FilterOptions& options,
                                                            Estimate& estimate);

/// The longest history that can be used as it is, for the methods that take one alone and need mass and stiffness;
/// the others go to the exclusions. Nothing: the estimate has been refused.
[[nodiscard]] std::optional<NumberedHistory> longest_history(const Record& record, const KnownConstants& constants,
                                                             Estimate& estimate);

/// Samples slower than this are left out of a regression on speed [m/s]: the option, or a hundredth of the largest
/// speed, for the sign of a slower one is that of the noise.
[[nodiscard]] double least_speed_for(const std::vector<Motion>& motions, const RegressionOptions& options);

/// `lacks` of the methods on histories: "the record holds no time histories".
[[nodiscard]] std::string lacks_histories(const Record& record);

}  // namespace dualdamp::identify
