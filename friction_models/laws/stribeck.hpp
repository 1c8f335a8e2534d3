#pragma once
/// Friction whose level falls with speed: Coulomb's law with a Stribeck curve for its level.
///
///   slip   F = level(|v|) sgn v                    [N]
///   stick  F = pull while |pull| <= static         [N]
///
/// `level`: see `stribeck_curve.hpp`. For stribeck_velocity -> 0 the law becomes coulomb with static above kinetic.
/// At low speed the slope of the curve acts as a negative damping, down to -(static - kinetic)
/// sqrt(2/e)/stribeck_velocity for exp(-(v/vs)^2). Where its modulus exceeds the damping of the oscillator, steady
/// slip is unstable and stick-slip follows. The level depends only on the present speed, so the law holds for
/// lubricated contacts at speeds that change slowly.
///
/// Source: stribeck1902, armstrong1994, bo1982 in `docs/refs.bib`. Smooth engine. Cost: one exponential a call.

#include <vector>

#include "friction_models/formulas/stribeck_curve.hpp"
#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class Stribeck {
 public:
  static const std::vector<Parameter>& parameters();

  explicit Stribeck(const StribeckCurve& curve) : curve_(curve) {}

  [[nodiscard]] double force(const Memory&, const Instant& now, Direction direction) const {
    return sign(direction) * curve_.level(now, sign(direction) * now.v);
  }
  [[nodiscard]] double static_limit(const Memory&, const Instant& now) const { return curve_.static_level(now); }

 private:
  StribeckCurve curve_;
};

}  // namespace dualdamp::friction
