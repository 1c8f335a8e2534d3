#pragma once
/// Random numbers by their number: draw n of a stream depends on seed, stream and n alone, so that a step can be
/// repeated, and cells of a grid drawn in any order, with the same numbers everywhere.
///
/// Philox-4x32-10, keyed by the seed, counting (n, stream). Source: salmon2011 in `docs/refs.bib`. Cost: about 10
/// ns.

#include <cstdint>

namespace dualdamp::core {

/// One of 2^32 independent streams of a seed.
struct RandomStream {
  std::uint64_t seed = 0;
  std::uint32_t stream = 0;

  /// Uniform in [0, 1), with 53 bits.
  [[nodiscard]] double uniform(std::uint64_t n) const;
  /// Normal with mean 0 and variance 1, by Box and Muller's transformation.
  [[nodiscard]] double normal(std::uint64_t n) const;
};

}  // namespace dualdamp::core
