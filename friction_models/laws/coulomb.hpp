#pragma once
/// Coulomb friction, with a static force limit that may exceed the kinetic level.
///
///   slip   F = kinetic sgn v                       [N]
///   stick  F = pull while |pull| <= static         [N]
///
/// The viscous part of friction is not in this law: it is the damper of the oscillator. Holds for dry contact at
/// speeds where the level does not depend on speed. Source: coulomb1785, denhartog1931 in `docs/refs.bib`. Exact
/// engine. Cost: none beyond the driver's.

#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class Coulomb {
 public:
  static const std::vector<Parameter>& parameters();

  /// Levels in N, 0 <= kinetic <= static_level.
  Coulomb(double kinetic, double static_level) : kinetic_(kinetic), static_(static_level) {}

  [[nodiscard]] Affine affine_force(const Memory&, const Instant& now, Direction direction) const {
    return sign(direction) * now.force_limit(kinetic_);
  }
  [[nodiscard]] Affine affine_limit(const Memory&, const Instant& now) const { return now.force_limit(static_); }

 private:
  double kinetic_;
  double static_;
};

}  // namespace dualdamp::friction
