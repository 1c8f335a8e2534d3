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

/// Warnings about readings that appear twice in a record.
[[nodiscard]] std::vector<std::string> repeated_readings(const Record& record);

}  // namespace dualdamp::identify
