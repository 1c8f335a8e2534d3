#pragma once
/// Coulomb friction under a normal load that vibrates: a rider on a nonlinear contact spring, lifted by slip.
///
///   N = weight (1 - y/h0)^2 while y < h0, else 0   [N]   y: separation beyond the static one, h0 = static_approach
///   normal_mass y'' + d y' = N - weight + lift |v|/(1 + |v|/lift_velocity)
///   slip   F = mu N sgn v                          [N]
///   stick  F = pull while |pull| <= mu_static N    [N]
///
/// d = 2 normal_damping_ratio sqrt(k normal_mass), k = 2 weight/h0 the stiffness of small vibrations. The contact
/// may open; it then has no friction. At constant speed N = weight - lift: the level falls with speed, with a lag
/// of about one period of the contact. Without lift the law is exactly coulomb.
///
/// A reduction of our own: the contact spring of exponent 2 and the free normal motion are those of oden1985;
/// tolstoi1967 found that slip lifts the rider. Tangential bristles are left out
/// (`docs/decisions/018-normal-vibration.md`). Smooth engine; the contact may be fast, at sqrt(k/normal_mass).
/// Cost: one division a call.

#include <span>
#include <string>
#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

/// States: y [m], y' [m/s]. Mode: 0 in contact, 1 open.
class NormalVibration {
 public:
  struct Rider {
    double mu = 0.0;                    ///< >= 0
    double mu_static = 0.0;             ///< >= mu
    double weight = 0.0;                ///< N > 0
    double normal_mass = 0.0;           ///< kg > 0
    double static_approach = 0.0;       ///< m > 0
    double normal_damping_ratio = 0.0;  ///< >= 0
    double lift = 0.0;                  ///< N.s/m >= 0
    double lift_velocity = 0.0;         ///< m/s > 0
  };

  static const std::vector<Parameter>& parameters();
  /// A warning if the lift at high speed exceeds the weight.
  static std::vector<std::string> warnings(const ParameterValues& values);

  explicit NormalVibration(const Rider& rider);
  /// From the parameters.
  explicit NormalVibration(const ParameterValues& values);

  [[nodiscard]] Memory start(const Instant&) const { return {.state = {0.0, 0.0}}; }
  [[nodiscard]] double respond(const Memory& memory, const Instant& now, Direction direction,
                               std::span<double> rates) const;
  [[nodiscard]] double static_limit(const Memory& memory, const Instant& now) const {
    return now.force_limit_now(rider_.mu_static * normal_force(memory));
  }
  void guards(const Memory& memory, const Instant&, Direction, std::vector<double>& values) const {
    const double gap = memory.state[0] - rider_.static_approach;
    values.push_back(memory.mode == open ? gap : -gap);
  }
  void jump(Memory& memory, Trigger trigger, const Instant&, Direction) const {
    if (trigger.cause == 0) memory.mode = memory.mode == open ? 0 : open;
  }
  void scales(const Memory&, std::span<double> scales) const {
    scales[0] = rider_.static_approach;
    scales[1] = frequency_ * rider_.static_approach;
  }

 private:
  static constexpr int open = 1;

  /// N
  [[nodiscard]] double normal_force(const Memory& memory) const {
    const double approach = 1.0 - memory.state[0] / rider_.static_approach;
    return memory.mode == open ? 0.0 : rider_.weight * approach * approach;
  }

  Rider rider_;
  double frequency_;  ///< of small vibrations without damping [rad/s]
};

}  // namespace dualdamp::friction
