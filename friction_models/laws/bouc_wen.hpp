#pragma once
/// Bouc and Wen's hysteretic spring: a share alpha of its stiffness stays elastic, the rest yields at a force
/// limit.
///
///   F  = stiffness (alpha x + (1 - alpha) z)       [N]
///   z' = v (1 - |z/z0|^exponent (b sgn(v z) + 1 - b)),   z0 = limit/stiffness
///
/// alpha is `ratio`, b is `beta_share`: beta/(beta + gamma) in the usual notation, with A = 1. With b = 1/2
/// unloading is elastic. A large exponent gives contact_compliance; exponent 1 with b = 1 gives dahl. The law is
/// passive for b >= 1/2; below 1/2 unloading gives out work (erlicher2004). A loop of unloading and reloading does
/// not close: the force is lower when the mass is back at the same position (no return-point memory, unlike
/// `iwan`).
///
/// The mode is the sign of z, so that |z| is analytic; 0: the mass has not moved yet.
///
/// Source: bouc1967, wen1976, erlicher2004 in `docs/refs.bib`. Smooth engine. Cost: a power a call, an event a
/// stroke.

#include <span>
#include <string>
#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class BoucWen {
 public:
  static constexpr bool remembers_path = true;
  static const std::vector<Parameter>& parameters();
  /// A warning if these values are not passive.
  static std::vector<std::string> warnings(const ParameterValues& values);

  /// N > 0, N/m > 0, exponent >= 1, 0 <= ratio < 1, beta_share >= 0.
  BoucWen(double limit, double stiffness, double exponent, double ratio, double beta_share)
      : limit_(limit), stiffness_(stiffness), exponent_(exponent), ratio_(ratio), beta_share_(beta_share) {}

  [[nodiscard]] Memory start(const Instant&) const { return {.state = {0.0}}; }
  [[nodiscard]] double force(const Memory& memory, const Instant& now, Direction) const {
    return stiffness_ * (ratio_ * now.x + (1.0 - ratio_) * memory.state[0]);
  }
  void rates(const Memory& memory, const Instant& now, Direction direction, std::span<double> rates) const;
  void guards(const Memory& memory, const Instant&, Direction, std::vector<double>& values) const {
    if (memory.mode != unmoved) values.push_back(memory.mode * memory.state[0]);
  }
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const;
  void scales(const Memory&, std::span<double> scales) const { scales[0] = limit_ / stiffness_; }
  /// F v minus the power stored in both springs.
  [[nodiscard]] double dissipation(const Memory& memory, const Instant& now, Direction direction) const;
  /// J in the spring that yields.
  [[nodiscard]] double stored_energy(const Memory& memory, const Instant&) const {
    return 0.5 * (1.0 - ratio_) * stiffness_ * memory.state[0] * memory.state[0];
  }

 private:
  enum : int { unmoved = 0 };  ///< else the sign of z

  double limit_;
  double stiffness_;
  double exponent_;
  double ratio_;
  double beta_share_;
};

}  // namespace dualdamp::friction
