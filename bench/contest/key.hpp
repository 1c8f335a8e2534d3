#pragma once
/// The key of an exported stress test, which only the organiser has.
///
/// JSON: `scenario` (SHA-256 of the resolved scenario with the seed), `seed` of all random draws, `numbers` (item
/// i: the case in the grid of the exported file i, counted from 1). Errors: `core::InputError`.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/score/case_answer.hpp"
#include "scenarios/results/files.hpp"

namespace dualdamp::bench {

struct Key {
  std::string scenario;
  std::int64_t seed = 0;
  std::vector<std::size_t> numbers;  ///< of file i + 1
};

/// A key with the cases in a random order, which follows from the seed.
[[nodiscard]] Key make_key(std::string scenario, std::int64_t seed, std::size_t cases);

[[nodiscard]] scenarios::OutputFile key_file(const Key& key);

[[nodiscard]] Key read_key(const std::string& path);

/// Reads the answers of a program, a CSV file with the columns `case`, `zeta`, `F0`, `zeta_low`, `zeta_high`,
/// `F0_low`, `F0_high`, `p_value`, `usable`, in any order; all but the first may be missing, and so may fields and
/// rows.
[[nodiscard]] Entry read_entry(const std::string& name, const std::string& path, const Key& key);

}  // namespace dualdamp::bench
