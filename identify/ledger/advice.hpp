#pragma once
/// What to measure or state where assumptions are violated or untested, in words that fit the record: nothing that
/// it has already.

#include <string>
#include <vector>

#include "identify/ledger/ledger.hpp"

namespace dualdamp::identify {

[[nodiscard]] Recorded recorded_in(const Record& record);

/// Entries that violate nothing, but explain the departure of a violated entry as well: all explanations of a
/// departure have its p.
[[nodiscard]] std::vector<const LedgerEntry*> harmless_beside(const LedgerEntry& violated, const Ledger& ledger);

/// For every departure that was found, and for everything that may be its cause.
[[nodiscard]] std::string what_would_help(const Ledger& ledger);

/// "phases or a history": what the record lacks to test an assumption; empty if it lacks nothing.
[[nodiscard]] std::string means_to_show(Assumption assumption, const Recorded& recorded);

/// "; phases or a history would show it"; empty if the record lacks nothing.
[[nodiscard]] std::string would_show(Assumption assumption, const Recorded& recorded);

}  // namespace dualdamp::identify
