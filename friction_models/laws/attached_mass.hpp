#pragma once
/// An oscillator attached to the mass: a second mode of the structure, or a tuned mass damper. The attached mass is
/// at z [m] and moves with the velocity w [m/s].
///
///   F       = stiffness (x - z) + damping (v - w)          [N]
///   mass z'' = F,   z = x and w = v at the start
///
/// `mass` of the law is not part of that of the oscillator: a structure of the total mass M has the oscillator's
/// mass M - mass. The law has no friction. It stores energy, including the kinetic energy of the attached mass at
/// the start, and turns damping (v - w)^2 to heat.
///
/// Source: ormondroyd1928 in `docs/refs.bib`. Smooth engine: two states that follow the mass are no affine function
/// of time. Cost: a few operations a call; the length of steps follows the faster of the two modes.

#include <span>
#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"
#include "friction_models/state_sizes.hpp"

namespace dualdamp::friction {

class AttachedMass {
 public:
  static const std::vector<Parameter>& parameters();

  /// kg > 0, N/m > 0, N.s/m >= 0.
  AttachedMass(double mass, double stiffness, double damping)
      : mass_(mass), stiffness_(stiffness), damping_(damping) {}

  [[nodiscard]] Memory start(const Instant& now) const { return {.state = {now.x, now.v}}; }
  [[nodiscard]] double respond(const Memory& memory, const Instant& now, Direction, std::span<double> rates) const;
  void scales(const Memory&, std::span<double> scales) const { scales[1] = size_of_velocity; }
  /// Of the damper.
  [[nodiscard]] double dissipation(const Memory& memory, const Instant& now, Direction) const;

 private:
  // State: z and w.
  double mass_;
  double stiffness_;
  double damping_;
};

}  // namespace dualdamp::friction
