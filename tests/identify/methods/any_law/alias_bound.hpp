#pragma once
/// Lower bound of the length of intervals that hold the truth in 95 % under every law of the library.
///
/// Let d(theta) be the least distance, in standard deviations of the readings, between the readings of plain
/// friction with the true zeta and F0 and those of any law of the library whose own zeta (or F0) is theta; priors
/// of nuisances count as readings. An interval holds theta in 95 % if theta is true, and leaves it out in 5 %. By
/// the lemma of Neyman and Pearson it then leaves theta out in at most Phi(d - 1.645) if plain friction is true.
/// The expected length is the integral of the probability to hold theta (pratt1961length):
///
///   expected length >= int Phi(1.645 - d(theta)) dtheta
///
/// The noise is known here; an interval that has to estimate it is wider.

#include <array>
#include <optional>

#include "tests/identify/methods/any_law/law_laboratory.hpp"

namespace dualdamp::identify::testing {

/// Half of the least expected length for zeta and for F0 [N], for the record of plain friction on this rig.
[[nodiscard]] std::optional<Interval> alias_bound(LawRecord kind, const LawRig& rig);

}  // namespace dualdamp::identify::testing
