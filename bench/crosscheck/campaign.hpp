#pragma once
/// A campaign: cases drawn one by one, each checked in a process of its own.

#include <cstdint>

#include "bench/crosscheck/children.hpp"
#include "bench/crosscheck/summary.hpp"

namespace dualdamp::crosscheck {

/// Cases `first` to `first + count - 1` of the seed. The verdicts do not depend on `limits`, except where one of
/// them is reached.
void run_campaign(std::uint64_t seed, std::uint32_t first, std::uint32_t count, const Limits& limits,
                  Summary& summary);

}  // namespace dualdamp::crosscheck
