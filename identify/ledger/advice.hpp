#pragma once
/// What to measure or state where assumptions are violated, in words that fit the kind of record.

#include <string>

#include "identify/ledger/ledger.hpp"

namespace dualdamp::identify {

/// For every departure that was found.
[[nodiscard]] std::string what_would_help(const Ledger& ledger);

/// ", from 4 readings that leave no freedom for an interval": as many pairs or extremes as unknowns,
/// which are fitted exactly; empty otherwise.
[[nodiscard]] std::string no_freedom(const Estimate& estimate);

}  // namespace dualdamp::identify
