#pragma once
/// Preparation of the extremes of a free vibration for the decrement methods.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// The extremes of a record, in units of a power of two near the largest, so that results do not depend on the
/// scale.
struct Extremes {
  std::vector<double> values;
  double unit = 1.0;  ///< m
};

/// Leaves out all extremes from index `count` on.
void cut(Extremes& extremes, std::size_t count, const std::string& reason, Estimate& estimate);

/// Reads the extremes and leaves out those after the last that alternates; nothing after `estimate` has been
/// refused.
[[nodiscard]] std::optional<Extremes> take_extremes(const Record& record, const KnownConstants& constants,
                                                    Estimate& estimate);

/// False after `estimate` has been refused: fewer than `needed` extremes can be used.
[[nodiscard]] bool enough(const Extremes& extremes, std::size_t needed, Estimate& estimate);

}  // namespace dualdamp::identify
