#pragma once
/// A spring between the mass and the ground with free play: no force within the gap.
///
///   F = stiffness (x - s gap)  for s x > gap, s = +-1;   F = 0 for |x| <= gap            [N]
///
/// As the only stiff spring it is a spring with backlash; beside another spring it is a pair of elastic stops. It
/// stores energy and gives all of it back; in the energy account it counts as friction. Source: shaw1983 in
/// `docs/refs.bib`. Exact engine. Cost: four events a period.

#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class GapSpring {
 public:
  static const std::vector<Parameter>& parameters();

  /// N/m > 0, m >= 0.
  GapSpring(double stiffness, double gap) : stiffness_(stiffness), gap_(gap) {}

  [[nodiscard]] Memory start(const Instant& now) const {
    return {.mode = now.x > gap_ ? 1 : now.x < -gap_ ? -1 : 0};
  }
  [[nodiscard]] Affine affine_force(const Memory& memory, const Instant&, Direction) const;
  void affine_guards(const Memory& memory, const Instant&, Direction, std::vector<Affine>& guards) const;
  void jump(Memory& memory, Trigger trigger, const Instant&, Direction) const;
  [[nodiscard]] double dissipation(const Memory&, const Instant&, Direction) const { return 0.0; }

 private:
  // Mode: the side of the gap that x is beyond, +1 or -1; 0 within the gap.
  double stiffness_;
  double gap_;
};

}  // namespace dualdamp::friction
