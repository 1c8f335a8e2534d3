#include "sim/orbits/monotone_model.hpp"

#include <algorithm>
#include <cmath>

#include "sim/engine/drive.hpp"

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

/// The length and the speed of a motion, of which the places and speeds at which a law is tried are parts: no unit
/// is distinguished.
struct Extent {
  double length = 1.0;  ///< m
  double speed = 1.0;   ///< m/s
};

Extent extent_of(const Model& model) {
  const double w = model.excitation.frequency;
  Extent extent;
  extent.length = std::max({driven_displacement(model.oscillator, model.excitation),
                            std::abs(model.initial.position), std::abs(model.initial.velocity) / w});
  if (!(extent.length > 0.0)) extent.length = 1.0;
  extent.speed = extent.length * w;
  return extent;
}

/// Whether F never falls as v grows from 0 in this direction.
bool rises_with_speed(const Law& law, double t, Direction direction, double speed) {
  const double slowest = 1e-12 * speed;
  const double fastest = 1e9 * speed;
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

bool is_monotone(const Law& law, const Extent& extent) {
  if (law.has_memory() || law.delay() > 0.0) return false;
  const double second = 10.0 * extent.length / extent.speed;  // of a drive of 10 rad/s
  const auto same_at = [&](double x, Direction direction) {
    const Instant at{.t = 0.3 * second, .x = x * extent.length, .v = sign(direction) * extent.speed};
    return law.force({}, at, direction) == law.force({}, {.t = at.t, .v = at.v}, direction);
  };
  for (const Direction direction : {Direction::forward, Direction::backward}) {
    if (law.is_affine()) {
      const friction::Affine force = law.affine_force({}, {}, direction);
      if (force.position != 0.0 || force.velocity < 0.0) return false;
      continue;
    }
    if (!same_at(0.1, direction) || !same_at(-7.0, direction)) return false;
    for (const double t : {0.0, 0.3, 1.7, 11.0}) {
      if (!rises_with_speed(law, t * second, direction, extent.speed) || !holds_between(law, {.t = t * second}))
        return false;
    }
  }
  return holds_between(law, {});
}

}  // namespace

Motions motions_of(const Model& model) {
  const Oscillator& o = model.oscillator;
  const Extent extent = extent_of(model);
  const bool monotone =
      is_linear(o) && o.stiffness > 0.0 && o.damping >= 0.0 &&
      std::ranges::all_of(model.friction, [&](const Law& law) { return is_monotone(law, extent); });
  if (!monotone) return Motions::may_part;
  return o.damping > 0.0 ? Motions::meet_sliding : Motions::never_part;
}

}  // namespace dualdamp::sim
