#pragma once
/// Coulomb and viscous friction with separate values for each direction.
///
///   slip forward   F =  kinetic_forward + viscous_forward v            [N]
///   slip backward  F = -kinetic_backward + viscous_backward v          [N]
///   stick          F = pull while -static_backward <= pull <= static_forward
///
/// Forward is v > 0. Holds for guides, gears and screws whose contact differs between the directions: a load of
/// gravity, a preload, teeth with two flanks. Equal values give `coulomb` and a dashpot. A difference of the
/// kinetic levels alone is a constant force, half of that difference.
///
/// Source: armstrong1994 in `docs/refs.bib`. Exact engine. Cost: none beyond the driver's.

#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class AsymmetricCoulomb {
 public:
  /// Friction in one direction of slip.
  struct Side {
    double kinetic = 0.0;       ///< N, >= 0
    double static_level = 0.0;  ///< N, >= kinetic
    double viscous = 0.0;       ///< N.s/m, >= 0
  };

  static const std::vector<Parameter>& parameters();

  AsymmetricCoulomb(const Side& forward, const Side& backward) : forward_(forward), backward_(backward) {}

  /// While the mass sticks: the middle of the forces with which the law can hold it.
  [[nodiscard]] Affine affine_force(const Memory&, const Instant& now, Direction direction) const;
  [[nodiscard]] Affine affine_limit(const Memory&, const Instant& now) const;

 private:
  Side forward_;
  Side backward_;
};

}  // namespace dualdamp::friction
