#pragma once
/// Readings that stand there more than once: they would count as independent, or predict themselves.
///
/// Two signals are one where all their samples are equal but for the rounding of units; two pairs where amplitudes,
/// frequency and phase are equal to the last digit.
///
/// Errors: none thrown. Cost: linear in the samples of each two histories of equal length.

#include <string>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// Whether two records hold the same readings of x, v or a, of a decay, or all pairs; of loops those of the force.
[[nodiscard]] bool share_readings(const Record& a, const Record& b, bool are_loops);

/// Warnings of readings that stand in a record twice.
[[nodiscard]] std::vector<std::string> repeated_readings(const Record& record);

}  // namespace dualdamp::identify
