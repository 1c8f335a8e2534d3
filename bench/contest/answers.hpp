#pragma once
/// Answers of a program outside to exported records, of any magnitude up to 1e60. Errors: `core::InputError`.

#include <string>

#include "bench/contest/key.hpp"
#include "bench/score/case_answer.hpp"

namespace dualdamp::bench {

/// Reads the answers of a program, a CSV file with the columns `case`, `zeta`, `F0`, `zeta_low`, `zeta_high`,
/// `F0_low`, `F0_high`, `p_value`, `usable`, in any order; all but the first may be missing, and so may fields and
/// rows.
[[nodiscard]] Entry read_entry(const std::string& name, const std::string& path, const Key& key);

}  // namespace dualdamp::bench
