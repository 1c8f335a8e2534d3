#include "sim/orbits/monotone_model.hpp"

#include <algorithm>
#include <cmath>

namespace dualdamp::sim {

using friction::Direction;
using friction::Instant;
using friction::Law;

namespace {

/// Relative rounding of a law's force.
constexpr double rounding = 1e-12;

/// Whether the forces with which the law can hold the mass lie between those of slips backward and forward.
bool holds_between(const Law& law, const Instant& at) {
  const double middle = law.force({}, at, Direction::none);
  const double limit = law.static_limit({}, at);
  const double forward = law.force({}, at, Direction::forward);
  const double backward = law.force({}, at, Direction::backward);
  return middle + limit <= forward + rounding * std::abs(forward) &&
         middle - limit >= backward - rounding * std::abs(backward);
}

/// Whether F never falls as v grows from 0 in this direction.
bool rises_with_speed(const Law& law, double t, Direction direction) {
  constexpr double slowest = 1e-12;  // m/s
  constexpr double fastest = 1e9;
  constexpr double ratio = 1.26;  // ten speeds a decade
  const double s = sign(direction);
  double before = s * law.force({}, {.t = t}, direction);
  for (double v = slowest; v < fastest; v *= ratio) {
    const double force = s * law.force({}, {.t = t, .v = s * v}, direction);
    if (!(force >= before - rounding * std::abs(before))) return false;
    before = force;
  }
  return true;
}

bool is_monotone(const Law& law) {
  if (law.has_memory() || law.delay() > 0.0) return false;
  const auto same_at = [&](double x, Direction direction) {
    const Instant at{.t = 0.3, .x = x, .v = sign(direction)};
    return law.force({}, at, direction) == law.force({}, {.t = 0.3, .v = sign(direction)}, direction);
  };
  for (const Direction direction : {Direction::forward, Direction::backward}) {
    if (law.is_affine()) {
      const friction::Affine force = law.affine_force({}, {}, direction);
      if (force.position != 0.0 || force.velocity < 0.0) return false;
      continue;
    }
    if (!same_at(0.1, direction) || !same_at(-7.0, direction)) return false;
    for (const double t : {0.0, 0.3, 1.7, 11.0}) {
      if (!rises_with_speed(law, t, direction) || !holds_between(law, {.t = t})) return false;
    }
  }
  return holds_between(law, {});
}

}  // namespace

Motions motions_of(const Model& model) {
  const Oscillator& o = model.oscillator;
  const bool monotone =
      is_linear(o) && o.stiffness > 0.0 && o.damping >= 0.0 && std::ranges::all_of(model.friction, is_monotone);
  if (!monotone) return Motions::may_part;
  return o.damping > 0.0 ? Motions::meet_sliding : Motions::never_part;
}

}  // namespace dualdamp::sim
