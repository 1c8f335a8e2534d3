#pragma once
/// What errors of constants that no test sees may make of the answer.
///
/// Constants, and gains of sensors, without a stated uncertainty count as uncertain by 1 % each (one standard
/// deviation) in the range of the answer, as far as the ledger's tests of them may miss what they do to zeta and
/// F0. Its interval does not change: it holds for the constants as stated. Example: at one frequency, amplitudes
/// alone hardly show a stiffness or a frequency that is 2 % off. Cost: two joint fits for each such constant; none
/// where the tests miss less than matters.

#include "identify/ledger/ledger.hpp"

namespace dualdamp::identify {

/// Relative, of a mass, a stiffness, a frequency or a gain without a stated uncertainty.
inline constexpr double unstated_uncertainty = 0.01;

/// Extends `ledger.unseen`. Nothing happens without an estimate.
void reach_over_unstated(const Record& record, const KnownConstants& constants, const LedgerOptions& options,
                         Ledger& ledger);

}  // namespace dualdamp::identify
