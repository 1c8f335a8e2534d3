#include "core/random.hpp"

#include <Random123/philox.h>

#include <array>
#include <cmath>

#include "core/constants.hpp"

namespace dualdamp::core {

namespace {

/// Two uniform numbers in [0, 1) from the 128 bits of one draw.
std::array<double, 2> pair(const RandomStream& stream, std::uint64_t n) {
  const auto low = [](std::uint64_t bits) { return static_cast<std::uint32_t>(bits); };
  const auto high = [](std::uint64_t bits) { return static_cast<std::uint32_t>(bits >> 32); };
  const r123::Philox4x32::ctr_type counter = {{low(n), high(n), stream.stream, 0}};
  const r123::Philox4x32::key_type key = {{low(stream.seed), high(stream.seed)}};
  const r123::Philox4x32::ctr_type words = r123::Philox4x32()(counter, key);
  const auto unit = [](std::uint64_t first, std::uint64_t second) {
    return static_cast<double>((second << 32 | first) >> 11) * 0x1p-53;
  };
  return {unit(words[0], words[1]), unit(words[2], words[3])};
}

}  // namespace

double RandomStream::uniform(std::uint64_t n) const { return pair(*this, n)[0]; }

double RandomStream::normal(std::uint64_t n) const {
  const auto [first, second] = pair(*this, n);
  return std::sqrt(-2.0 * std::log1p(-first)) * std::cos(two_pi * second);
}

}  // namespace dualdamp::core
