#pragma once
/// What to measure or state where assumptions are violated or untested, in words that fit the record: nothing that
/// it has already.

#include <string>

#include "identify/ledger/ledger.hpp"

namespace dualdamp::identify {

[[nodiscard]] Recorded recorded_in(const Record& record);

/// For every departure that was found.
[[nodiscard]] std::string what_would_help(const Ledger& ledger);

/// "; phases or a history would show it": what the record lacks to test an assumption; empty if it lacks nothing.
[[nodiscard]] std::string would_show(Assumption assumption, const Recorded& recorded);

}  // namespace dualdamp::identify
