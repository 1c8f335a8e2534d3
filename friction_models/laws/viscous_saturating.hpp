#pragma once
/// Viscous friction that saturates with speed, as the shear stress of a film that thins or warms under shear.
///
///   F = coefficient v/(1 + |v|/saturation_velocity)                    [N]
///
/// At low speed a dashpot of `coefficient`; at high speed the constant force coefficient saturation_velocity. With
/// a small saturation velocity at a given product of both it is a smooth substitute for Coulomb friction, under
/// which the mass never sticks.
///
/// Source: cross1965 in `docs/refs.bib`, the flow law of Cross with exponent 1 in a film of constant thickness.
/// Smooth engine. Cost: one division a call.

#include <vector>

#include "friction_models/formulas/smooth.hpp"
#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class ViscousSaturating {
 public:
  static const std::vector<Parameter>& parameters();

  /// N.s/m >= 0, m/s > 0.
  ViscousSaturating(double coefficient, double saturation_velocity)
      : coefficient_(coefficient), velocity_(saturation_velocity) {}

  [[nodiscard]] double force(const Memory&, const Instant& now, Direction direction) const {
    const double limit = now.force_limit_now(coefficient_ * velocity_);
    return sign(direction) * limit * saturated(sign(direction) * now.v / velocity_);
  }

 private:
  double coefficient_;
  double velocity_;
};

}  // namespace dualdamp::friction
