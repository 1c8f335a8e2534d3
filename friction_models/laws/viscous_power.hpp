#pragma once
/// Viscous friction proportional to a power of the speed.
///
///   F = coefficient (|v|/reference_velocity)^exponent sgn v            [N]
///
/// Exponent 1: a dashpot; 2: the drag of a fluid at high Reynolds numbers; below 1: a film that thins under shear;
/// for exponent -> 0 the law becomes Coulomb friction. An exponent below 1 gives an infinite slope at v = 0, which
/// costs the integrator small steps. The mass never sticks.
///
/// Source: ostwald1925 (films), jacobsen1930 (vibration) in `docs/refs.bib`. Smooth engine. Cost: one power a call,
/// none for the exponents 1 and 2.

#include <vector>

#include "friction_models/formulas/smooth.hpp"
#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class ViscousPower {
 public:
  static const std::vector<Parameter>& parameters();

  /// N >= 0, m/s > 0, > 0.
  ViscousPower(double coefficient, double reference_velocity, double exponent)
      : coefficient_(coefficient), velocity_(reference_velocity), exponent_(exponent) {}

  [[nodiscard]] double force(const Memory&, const Instant& now, Direction direction) const {
    const double ratio = sign(direction) * now.v / velocity_;
    return sign(direction) * now.force_limit_now(coefficient_) * continued_power(ratio, exponent_);
  }

 private:
  double coefficient_;
  double velocity_;
  double exponent_;
};

}  // namespace dualdamp::friction
