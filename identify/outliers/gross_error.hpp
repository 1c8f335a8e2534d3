#pragma once
/// The one reading that all others exclude: a wrong digit, a wrong unit, a code of the logger.
///
/// Least squares follow such a reading, and the more so the fewer readings there are: the fit then misses all
/// others a little. Each reading in turn is therefore moved to where the joint model of the others has it, as if it
/// had not been read, and its distance from there is tested by Student's t with the deviation of the others.
///
/// It is a gross error only if it is off by more than `gross` of the value that is expected, and of the median of
/// all readings of its kind. A departure of friction may be as clear, but moves no single reading so far.
///
/// Source: belsley1980, chapter 2 (residuals of deleted rows). Cost: some fits of the joint model for each reading.

#include <optional>
#include <string>
#include <vector>

#include "identify/ledger/joint_model.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

struct GrossError {
  Reading reading;
  double value = 0.0;       ///< as read [m]
  double expected = 0.0;    ///< by all others [m]
  double deviations = 0.0;  ///< distance in standard deviations of the others, with its sign
};

/// The clearest one among the amplitudes or extremes named `suspects`; no names: among all of them.
[[nodiscard]] std::optional<GrossError> gross_error(const Record& record, const KnownConstants& constants,
                                                    const std::vector<Reading>& suspects = {});

/// "x of pair 4 is 100 times what all other readings expect"
[[nodiscard]] std::string text_of(const GrossError& error);

}  // namespace dualdamp::identify
