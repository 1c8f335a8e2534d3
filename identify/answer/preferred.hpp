#pragma once
/// Which of the estimates of a record answers.
///
/// The joint fit, if there is one; else the estimate with the narrowest intervals. Where no joint model tests a
/// record that is no history, it has few readings, and methods that share them have a degree of freedom or two: the
/// narrowest of such intervals is narrow by chance, and the widest that agrees with it answers. Of estimates
/// without intervals the one in the middle answers, if all agree. Of estimates whose intervals are equal but for
/// rounding, the first by name counts.
///
/// Errors: none thrown. Cost: that of a pass over the estimates.

#include <cstddef>
#include <optional>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/ledger/ledger.hpp"

namespace dualdamp::identify {

/// The area of the intervals of c and F0; infinite where there are none, or the estimate is not usable.
[[nodiscard]] double area(const Estimate& estimate);

/// Does a usable estimate `b` contradict `a`? Their intervals of c or of F0 do not overlap.
[[nodiscard]] bool disagree(const Estimate& a, const Estimate& b);

/// No joint model tested the record, and it holds no histories.
[[nodiscard]] bool has_few_readings(const Ledger& ledger);

/// Place of the estimate that answers; nothing if none can.
[[nodiscard]] std::optional<std::size_t> preferred(const std::vector<Estimate>& estimates, const Ledger& ledger);

}  // namespace dualdamp::identify
