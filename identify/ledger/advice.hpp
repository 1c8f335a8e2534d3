#pragma once
/// What to measure or state where assumptions are violated, in words that fit the kind of record.

#include <string>

#include "identify/ledger/ledger.hpp"

namespace dualdamp::identify {

/// For every departure that was found.
[[nodiscard]] std::string what_would_help(const Ledger& ledger);

}  // namespace dualdamp::identify
