#pragma once
/// Variants of a scenario whose motion follows from that of the first: in other units, mirrored, or slightly
/// changed.

#include "bench/crosscheck/draws.hpp"
#include "scenarios/format/json.hpp"

namespace dualdamp::crosscheck {

using scenarios::Json;

/// Factors of every force, length and time; that of a mass follows (force time^2/length).
struct Scales {
  double force = 1.0;
  double length = 1.0;
  double time = 1.0;
};

/// Every value multiplied by the factor of its unit.
[[nodiscard]] Json scaled(const Json& scenario, const Scales& scales);

/// x and y become -x and -y, forces likewise.
[[nodiscard]] Json mirrored(const Json& scenario);

/// Whether the mirrored scenario has the mirrored motion: no law and no random numbers distinguish the two sides.
[[nodiscard]] bool has_mirror(const Json& scenario);

/// Every value changed by up to `share` of itself, the initial position by up to `share` of `length` [m], the phase
/// by up to `share`. Force limits of one law keep their ratios: static friction equal to kinetic stays so.
[[nodiscard]] Json perturbed(const Json& scenario, double share, double length, Draws& draws);

}  // namespace dualdamp::crosscheck
