#pragma once
/// One instant as the driver passes it to a law: time, position and velocity of the mass, and the effect of
/// modifiers on the law's force limits.

#include "friction_models/affine.hpp"

namespace dualdamp::friction {

/// Direction of slip, the same throughout an interval; none: the mass sticks.
enum class Direction : int { backward = -1, none = 0, forward = 1 };

[[nodiscard]] constexpr double sign(Direction direction) {
  return static_cast<double>(static_cast<int>(direction));
}

/// Of none: none.
[[nodiscard]] constexpr Direction opposite(Direction direction) {
  return static_cast<Direction>(-static_cast<int>(direction));
}

/// Of a velocity or a distance; none at 0.
[[nodiscard]] constexpr Direction direction_of(double v) {
  return v > 0.0 ? Direction::forward : v < 0.0 ? Direction::backward : Direction::none;
}

/// What modifiers do to the force limits of a law at one instant:
///
///   force limit = (factor + factor_slope x) nominal + slope x      [N]
///
/// and 0 for a nominal force limit that is not above `vanished`.
struct Modification {
  double factor = 1.0;
  double factor_rate = 0.0;   ///< of the factor at this x [1/s]
  double factor_slope = 0.0;  ///< 1/m
  double slope = 0.0;         ///< N/m, with the sign of x
  double vanished = -1.0;     ///< N; below zero: no force limit is zero
};

struct Instant {
  double t = 0.0;  ///< s
  double x = 0.0;  ///< m
  double v = 0.0;  ///< m/s
  Modification modification{};
  double past_velocity = 0.0;  ///< v one `delay` of the law ago [m/s]; before the start: the initial velocity
  double angle = 0.0;          ///< w t of a harmonic excitation, without its phase; else 0 [rad]
  double angle_rate = 0.0;     ///< w [rad/s]

  /// The force limit [N] that is `nominal` without modifiers, as a function of time and position from now on.
  [[nodiscard]] constexpr Affine force_limit(double nominal) const {
    if (nominal <= modification.vanished) return {};
    return {.constant = modification.factor * nominal,
            .rate = modification.factor_rate * nominal,
            .position = modification.slope + modification.factor_slope * nominal};
  }
  /// Its value at this instant [N].
  [[nodiscard]] constexpr double force_limit_now(double nominal) const {
    if (nominal <= modification.vanished) return 0.0;
    return (modification.factor + modification.factor_slope * x) * nominal + modification.slope * x;
  }
};

/// The value of an affine form at the instant at which its interval begins.
[[nodiscard]] constexpr double value(const Affine& a, const Instant& now) {
  return a.constant + a.position * now.x + a.velocity * now.v + a.transient;
}

}  // namespace dualdamp::friction
