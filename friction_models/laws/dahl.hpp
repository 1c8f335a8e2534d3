#pragma once
/// Dahl: bristles of mean deflection z that yield as the force approaches the kinetic level. The force depends on
/// the path, not on the speed.
///
///   F = sigma0 z,   z' = v |1 - sigma0 z sgn v/kinetic|^exponent sgn(1 - sigma0 z sgn v/kinetic)     [N]
///
/// With exponent 1, between displacements +-A and with a = sigma0 A/kinetic: peak force kinetic tanh a, work of a
/// loop 4 kinetic A (1 - tanh(a)/a). For sigma0 -> infinity the law becomes coulomb. The force tends to the kinetic
/// level and never exceeds it: there is no break-away and no level that falls with speed. Holds for rolling
/// bearings and for contacts before gross sliding.
///
/// Exponents below 1 (0: elastic-perfectly-plastic, which is contact_compliance) reach the kinetic level within a
/// finite distance with an infinite curvature and are refused.
///
/// Source: dahl1976 in `docs/refs.bib`. Smooth engine; z is fast, at a rate of sigma0 |v|/kinetic.

#include <span>
#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class Dahl {
 public:
  static constexpr bool remembers_path = true;
  static const std::vector<Parameter>& parameters();

  /// N > 0, N/m > 0, >= 1.
  Dahl(double kinetic, double sigma0, double exponent) : kinetic_(kinetic), sigma0_(sigma0), exponent_(exponent) {}

  [[nodiscard]] Memory start(const Instant&) const { return {.state = {0.0}}; }
  [[nodiscard]] double force(const Memory& memory, const Instant&, Direction) const {
    return sigma0_ * memory.state[0];
  }
  void rates(const Memory& memory, const Instant& now, Direction direction, std::span<double> rates) const;
  /// Where there was no force limit the bristles start unstretched.
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction) const {
    if (trigger.cause == Trigger::limit_change && now.force_limit_now(kinetic_) == 0.0) memory = start(now);
  }
  void scales(const Memory&, std::span<double> scales) const { scales[0] = kinetic_ / sigma0_; }
  /// F v minus the power that the bristles store, sigma0 z z'.
  [[nodiscard]] double dissipation(const Memory& memory, const Instant& now, Direction direction) const;
  /// J in the bristles.
  [[nodiscard]] double stored_energy(const Memory& memory, const Instant&) const {
    return 0.5 * sigma0_ * memory.state[0] * memory.state[0];
  }

 private:
  double kinetic_;
  double sigma0_;
  double exponent_;
};

}  // namespace dualdamp::friction
