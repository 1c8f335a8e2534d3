#pragma once
/// Random numbers by their index: draw n of a stream depends only on seed, stream and n. So a step can be repeated,
/// and cells of a grid can be drawn in any order, with the same numbers.
///
/// Philox-4x32-10 with the seed as key and (n, stream) as counter. Source: salmon2011 in `docs/refs.bib`. Cost:
/// about 10 ns.

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
