#pragma once
/// When were the rows of a test sampled? From time stamps as instruments write them: rounded, with gaps, in bursts,
/// jittering.
///
/// Let the stamps be t_i and the line through the first and the last of them l_i.
/// * Even: |t_i - l_i| is at most what the rounding of the printed digits explains and 1 % of a step.
/// * Gaps: steps above 1.5 of the usual one; the longest part between them is used, if it is even.
/// * Bursts: many stamps stand there several times, as when a serial line hands over what has gathered. The samples
///   are taken as even when all stamps lie within one and a half bursts of a straight line.
/// * Jitter: either the samples are even and their stamps late, or they were taken when the stamps say. That one
///   holds under which the signal is smoother; in the second case it is interpolated at even times.
/// What is none of these is refused.
///
/// The step between even samples is that of all stamps: by the two at the ends, each off by its rounding or by a
/// burst, the period of a motion would be wrong. It is the slope of the line of least squares or, where stamps
/// stand there several times, of the narrowest strip that holds them.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dualdamp::identify {

/// The stamps of one test and one of its signals.
struct TimeStamps {
  std::span<const double> t;  ///< s
  std::span<const double> signal;
  /// Times are rounded to a multiple of `quantum` [s] or to so many significant digits, whichever is coarser.
  double quantum = 0.0;
  int digits = 17;
};

struct TimeFault {
  std::size_t row = 0;
  std::string message;
  std::string allowed;
};

/// Rows [first, last) are used.
struct TimeBase {
  std::size_t first = 0;
  std::size_t last = 0;
  double step = 0.0;               ///< s, between samples
  bool is_interpolated = false;    ///< the signals are to be interpolated from their stamps to even times
  std::string warning;             ///< empty: nothing to be told
  std::optional<TimeFault> fault;  ///< the rows cannot be used
};

[[nodiscard]] TimeBase time_base_of(const TimeStamps& stamps);

/// Values at as many even times, from the first stamp to the last, by cubics through four neighbours. Stamps must
/// increase.
[[nodiscard]] std::vector<double> interpolated_evenly(std::span<const double> t, std::span<const double> values);

}  // namespace dualdamp::identify
