#pragma once
/// The key of an exported stress test, which only the organiser has.
///
/// JSON: `scenario` (SHA-256 of the resolved scenario with the seed), `seed` of all random draws, `numbers` (item
/// i: the case in the grid of the exported file i, counted from 1). Errors: `core::InputError`.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

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

}  // namespace dualdamp::bench
