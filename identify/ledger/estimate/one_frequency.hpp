#pragma once
/// At one frequency the inertia of a further mode has the effect of another mass or stiffness.
///
/// Where a record of one frequency charges both, each beside the other, they are one departure, and c and F0 belong
/// to any constants between those stated and those fitted. zeta = c/(2 sqrt(k m)) does not: its interval also holds
/// that with the constants as stated.

#include "identify/ledger/ledger.hpp"

namespace dualdamp::identify {

/// Joins the departures of constants and of a further mode in the ledger of steady states at one frequency.
void join_at_one_frequency(const KnownConstants& constants, Ledger& ledger);

}  // namespace dualdamp::identify
