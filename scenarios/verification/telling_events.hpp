#pragma once
/// Events that tell something about a motion. Where a mass hardly moves - it rings down, creeps, slips by rounding
/// - the times and the number of its reversals, stops and releases depend on rounding. The same holds for a stop
/// from which the mass goes on at once: a grazing.

#include <cstddef>
#include <vector>

#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

/// Of `rows` of a table of events: all but
///
/// * reversals, stops and releases that are less than 1e-8 of `length` away from those before and after;
/// * pairs of a stop and a release, or of two reversals, if the mass goes on in its direction, at one place to 1e-8
///   of `length` and at one time to 1e-5 of the last event's.
///
/// All rows of other tables.
[[nodiscard]] std::vector<std::size_t> telling_rows(const Table& table, const std::vector<std::size_t>& rows,
                                                    double length);

/// Whether the time of each of these rows is known: not at events before and after which the mass moves less than
/// `swing` [m]. A creep has a place at each time, but it hardly tells when it turns. Rows of other tables have
/// their times.
[[nodiscard]] std::vector<char> rows_with_times(const Table& table, const std::vector<std::size_t>& rows,
                                                double swing);

}  // namespace dualdamp::scenarios
