#pragma once
/// The line of pairs at resonance, by which exchanged columns and wrong units show.

#include <optional>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// The line x = (Y - b)/(2 zeta), where friction makes b > 0; and the same line with x and Y exchanged.
struct ResonanceLine {
  double zeta, intercept, other_zeta, other_intercept;
};

/// The line through the pairs, if there are at least three, near resonance, at one frequency, on a straight line.
[[nodiscard]] std::optional<ResonanceLine> resonance_line(const std::vector<Pair>& pairs,
                                                          const KnownConstants& constants);

/// Whether a damping ratio is one that hardly any rig has, but that a unit wrong by 1000 makes.
[[nodiscard]] bool is_odd(double zeta);

}  // namespace dualdamp::identify
