#pragma once
/// The sample times of a test, from time stamps as instruments write them: rounded, with gaps, in bursts, with
/// jitter.
///
/// Let t_i be the stamps and l_i the line through the first and the last of them.
/// * Even: |t_i - l_i| is at most the rounding of the printed digits and 1 % of a step.
/// * Gaps: steps above 1.5 usual steps. Up to three lost samples in a row are filled where all signals are smooth
///   across them (lost_samples.hpp). Else the part without a gap that moves most is used, if it is even.
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

#include "identify/readers/lost_samples.hpp"

namespace dualdamp::identify {

/// The stamps of one test and its signals.
struct TimeStamps {
  std::span<const double> t;                     ///< s
  std::vector<std::span<const double>> signals;  ///< at least one; the first one tells what is smoother
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
  double step = 0.0;                ///< s, between samples
  bool is_interpolated = false;     ///< signals are to be interpolated from the stamps to even times
  std::optional<RowPlaces> places;  ///< the samples between these places of the rows are to be filled
  std::string warning;              ///< empty: none
  std::optional<TimeFault> fault;   ///< why the rows cannot be used
};

[[nodiscard]] TimeBase time_base_of(const TimeStamps& stamps);

/// A signal at even times. `t` and `values`: of the rows that are used.
[[nodiscard]] std::vector<double> even_samples(const TimeBase& base, std::span<const double> t,
                                               std::span<const double> values);

}  // namespace dualdamp::identify
