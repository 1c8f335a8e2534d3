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

/// F never falls as v grows from 0, and is not below the static limit; at one time.
bool rises_with_speed(const Law& law, double t, double x) {
  constexpr double slowest = 1e-12;  // m/s
  constexpr double fastest = 1e9;
  constexpr double ratio = 1.26;  // ten speeds a decade
  double before = law.force({}, {.t = t, .x = x}, Direction::forward);
  if (law.static_limit({}, {.t = t, .x = x}) > before * (1.0 + rounding)) return false;
  for (double v = slowest; v < fastest; v *= ratio) {
    const double force = law.force({}, {.t = t, .x = x, .v = v}, Direction::forward);
    if (!(force >= before - rounding * std::abs(before))) return false;
    before = force;
  }
  return true;
}

bool is_monotone(const Law& law) {
  if (law.is_modal() || law.delay() > 0.0) return false;
  if (law.is_affine()) {
    const friction::Affine force = law.affine_force({}, {}, Direction::forward);
    return force.position == 0.0 && force.velocity >= 0.0 &&
           law.static_limit({}, {}) <= law.force({}, {}, Direction::forward);
  }
  const auto same_at = [&](double x) {
    const Instant at{.t = 0.3, .x = x, .v = 1.0};
    return law.force({}, at, Direction::forward) == law.force({}, {.t = 0.3, .v = 1.0}, Direction::forward);
  };
  if (!same_at(0.1) || !same_at(-7.0)) return false;
  for (const double t : {0.0, 0.3, 1.7, 11.0}) {
    if (!rises_with_speed(law, t, 0.0)) return false;
  }
  return true;
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
