#pragma once
/// Generalized Maxwell slip: elements in parallel. Each is a spring k_i that sticks until its force reaches its
/// share of a level that falls with speed; its force then approaches that level gradually.
///
///   F = sum F_i                                                                    [N]
///   stuck      F_i' = k_i v                     until sgn(v) F_i = share_i s(v)
///   slipping   F_i' = attraction (share_i sgn v - F_i/s(v))      until v = 0
///   s(v) = kinetic + (static - kinetic) exp(-(v/stribeck_velocity)^2)              [N]
///
/// The shares add to 1, so a steady slip has F = s(v) sgn v. The attraction [N/s] sets how fast the force of a
/// slipping element approaches its level: at the rate attraction/s(v) [1/s]. Only loading starts a slip: an element
/// whose force still acts with the motion stays stuck until it is unloaded, however low the level at that speed.
/// With static = kinetic the law is `iwan`.
///
/// With static above kinetic the law may give out work: the force of an element that slips at low speed grows
/// although the mass hardly moves.
///
/// Source: lampaert2003, albender2005 in `docs/refs.bib`. Smooth engine. Cost: an event for each element and
/// stroke; a state for each element.

#include <span>
#include <string>
#include <vector>

#include "friction_models/formulas/stribeck_curve.hpp"
#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class GeneralizedMaxwellSlip {
 public:
  static constexpr bool remembers_path = true;
  struct Element {
    double stiffness = 0.0;  ///< k_i > 0 [N/m]
    double share = 0.0;      ///< > 0, all together 1
  };

  static const std::vector<Parameter>& parameters();
  /// The fault of shares that do not add to 1.
  static std::vector<ParameterFault> check(const ParameterValues& values);
  /// A warning if these values are not passive.
  static std::vector<std::string> warnings(const ParameterValues& values);

  /// attraction > 0 [N/s]
  GeneralizedMaxwellSlip(std::vector<Element> elements, const StribeckCurve& curve, double attraction);
  /// From the parameters.
  explicit GeneralizedMaxwellSlip(const ParameterValues& values);

  [[nodiscard]] Memory start(const Instant&) const;
  [[nodiscard]] double force(const Memory& memory, const Instant&, Direction) const;
  void rates(const Memory& memory, const Instant& now, Direction direction, std::span<double> rates) const;
  void guards(const Memory& memory, const Instant& now, Direction direction, std::vector<double>& values) const;
  void jump(Memory& memory, Trigger trigger, const Instant&, Direction) const;
  void scales(const Memory&, std::span<double> scales) const;
  /// F v minus the power stored in the springs.
  [[nodiscard]] double dissipation(const Memory& memory, const Instant& now, Direction direction) const;
  /// J in the springs.
  [[nodiscard]] double stored_energy(const Memory& memory, const Instant&) const;

 private:
  enum : int { stuck, slipping };  ///< of each element, in Memory::indices; Memory::state: F_i

  std::vector<Element> elements_;
  StribeckCurve curve_;
  double attraction_;
};

}  // namespace dualdamp::friction
