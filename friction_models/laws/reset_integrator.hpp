#pragma once
/// The reset integrator model of Haessig and Friedland: a bond that stretches by z up to z0 and is then dragged
/// along.
///
///   stick   z' = v, |z| < z0            F = (1 + static_gain) stiffness z + damping v     [N]
///   slip    z = s z0, s = +-1           F = s stiffness z0 = s kinetic
///
/// with z0 = kinetic/stiffness. The force falls by static_gain kinetic at break-away and rises by as much when the
/// mass reverses and the bond holds again. The bond starts unstretched. The law is a numerical substitute for
/// stick-slip in which the mass never sticks; the stiffness of the bond is a modelling choice.
///
/// Source: haessig1991 in `docs/refs.bib`. Exact engine. Cost: two events a stroke.

#include <span>
#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class ResetIntegrator {
 public:
  static constexpr bool remembers_path = true;
  static const std::vector<Parameter>& parameters();

  /// N, N/m, 1, N.s/m; 0 <= kinetic, 0 < stiffness, 0 <= static_gain, 0 <= damping.
  ResetIntegrator(double kinetic, double stiffness, double static_gain, double damping)
      : kinetic_(kinetic), stiffness_(stiffness), static_gain_(static_gain), damping_(damping) {}

  [[nodiscard]] Memory start(const Instant& now) const { return {.state = {now.x}}; }
  [[nodiscard]] Affine affine_force(const Memory& memory, const Instant& now, Direction) const;
  void affine_guards(const Memory& memory, const Instant& now, Direction, std::vector<Affine>& guards) const;
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const;
  void rates(const Memory& memory, const Instant& now, Direction, std::span<double> rates) const;
  /// The largest stretch of the bond.
  void scales(const Memory& memory, std::span<double> scales) const;

 private:
  // Mode 0: stick; state: the position x - z of the other end of the bond. Mode +1 or -1: slip in that direction;
  // no state.
  void hold(Memory& memory, const Instant& now) const;

  double kinetic_;
  double stiffness_;
  double static_gain_;
  double damping_;
};

}  // namespace dualdamp::friction
