#pragma once
/// The sample times of a test, from time stamps as instruments write them: rounded, with gaps, in bursts, with
/// jitter.
///
/// Let t_i be the stamps and l_i the line through the first and the last of them.
/// * Even: |t_i - l_i| is at most the rounding of the printed digits and 1 % of a step.
/// * Gaps: steps above 1.5 usual steps. The longest part without a gap is used, if it is even.
/// * Bursts: many stamps appear several times, as from a serial line that sends its samples in blocks. The samples
///   are taken as even if all stamps lie within 1.5 bursts of a straight line.
/// * Jitter: either the samples are even and the stamps are late, or the samples were taken at the stamped times.
///   The case with the smoother signal is used; in the second case the signal is interpolated at even times.
/// Other stamps are refused.
///
/// The step between even samples comes from all stamps. The two stamps at the ends alone would give a wrong period
/// of the motion, because each of them is off by its rounding or by a burst. The step is the slope of the line of
/// least squares or, if stamps appear several times, of the narrowest strip that holds all stamps.

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
  /// Times are rounded to a multiple of `quantum` [s] or to `digits` significant digits, whichever is coarser.
  double quantum = 0.0;
  int digits = 17;
};

struct TimeFault {
  std::size_t row = 0;
  std::string message;
  std::string allowed;
};

/// Rows [first, last) are to be used.
struct TimeBase {
  std::size_t first = 0;
  std::size_t last = 0;
  double step = 0.0;               ///< s, between samples
  bool is_interpolated = false;    ///< the caller must interpolate the signals from the stamps to even times
  std::string warning;             ///< empty: none
  std::optional<TimeFault> fault;  ///< why the rows cannot be used
};

[[nodiscard]] TimeBase time_base_of(const TimeStamps& stamps);

/// The signal at as many even times from the first stamp to the last, by cubics through four neighbours. Stamps
/// must increase.
[[nodiscard]] std::vector<double> interpolated_evenly(std::span<const double> t, std::span<const double> values);

}  // namespace dualdamp::identify
