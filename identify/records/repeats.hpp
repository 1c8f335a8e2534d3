#pragma once
/// Readings that appear more than once. A method would count them as independent, or predict a record by itself.
///
/// Two signals are the same if all their samples are equal, except for the rounding of units. Two pairs are the
/// same if amplitudes, frequency and phase are equal to the last digit.
///
/// Errors: none thrown. Cost: linear in the samples of each two histories of equal length.

#include <string>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// Whether two records hold the same readings of x, v or a, the same decay or the same pairs. Loops: the same
/// force.
[[nodiscard]] bool share_readings(const Record& a, const Record& b, bool are_loops);

/// Numbers by which readings are known again where the record itself is no longer at hand: for each signal its
/// number of values, the logarithm of the largest one, and three sums with fixed weights in units of the largest.
/// Loops: of the force; else of x, v, a, the extremes and the pairs.
[[nodiscard]] std::vector<double> marks_of(const Record& record, bool is_loop);

/// Whether two such lists have a signal in common, except for the rounding of units.
[[nodiscard]] bool share_marks(const std::vector<double>& a, const std::vector<double>& b);

/// Warnings about readings that appear twice in a record.
[[nodiscard]] std::vector<std::string> repeated_readings(const Record& record);

}  // namespace dualdamp::identify
