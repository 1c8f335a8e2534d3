#pragma once
/// Friction with memory: Coulomb's law with a level that depends on an earlier speed.
///
///   slip   F = level sgn v                         [N]
///   stick  F = pull while |pull| <= level          [N]
///
///   FrictionLag        level = level(|w|),  w' = (v - w)/lag, also while sticking; w = v at the start
///   DelayedFriction    level = level(|v(t - lag)|), also while sticking; v before the start: the initial one
///
/// level(u): the Stribeck curve of `stribeck_curve.hpp`; without lag the law is `stribeck`. Since the level falls
/// with speed, friction is higher while the mass accelerates than while it decelerates. After a stop the static
/// limit comes back within a time of about `lag`.
///
/// Source: rice1983 (a state that relaxes), hess1990 (the delay, measured) in `docs/refs.bib`. Smooth engine. Cost:
/// one exponential a call, one look into the past for the delay.

#include <cmath>
#include <span>
#include <vector>

#include "friction_models/formulas/stribeck_curve.hpp"
#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

/// A lag of first order. Mode: the sign of w, 0 before the first motion.
class FrictionLag {
 public:
  static const std::vector<Parameter>& parameters();

  /// s > 0.
  FrictionLag(const StribeckCurve& curve, double lag) : curve_(curve), lag_(lag) {}

  [[nodiscard]] Memory start(const Instant& now) const;
  [[nodiscard]] double respond(const Memory& memory, const Instant& now, Direction direction,
                               std::span<double> rates) const {
    rates[0] = (now.v - memory.state[0]) / lag_;
    return sign(direction) * level(memory, now);
  }
  [[nodiscard]] double static_limit(const Memory& memory, const Instant& now) const { return level(memory, now); }
  void scales(const Memory&, std::span<double> scales) const { scales[0] = curve_.velocity(); }
  /// |w|: the level has a kink where w changes its sign, some time after v does. Of a mass at rest w dies out and
  /// keeps its sign; only its rounding would cross zero.
  void guards(const Memory& memory, const Instant&, Direction direction, std::vector<double>& values) const {
    if (memory.mode != 0 && direction != Direction::none) values.push_back(memory.mode * memory.state[0]);
  }
  void jump(Memory& memory, Trigger trigger, const Instant&, Direction direction) const;

 private:
  [[nodiscard]] double level(const Memory& memory, const Instant& now) const {
    return curve_.level(now, memory.mode * memory.state[0]);
  }

  StribeckCurve curve_;
  double lag_;
};

/// A pure delay.
class DelayedFriction {
 public:
  /// s > 0.
  DelayedFriction(const StribeckCurve& curve, double lag) : curve_(curve), lag_(lag) {}

  [[nodiscard]] double force(const Memory&, const Instant& now, Direction direction) const {
    return sign(direction) * level(now);
  }
  [[nodiscard]] double static_limit(const Memory&, const Instant& now) const { return level(now); }
  [[nodiscard]] double delay() const { return lag_; }

 private:
  [[nodiscard]] double level(const Instant& now) const { return curve_.level(now, std::abs(now.past_velocity)); }

  StribeckCurve curve_;
  double lag_;
};

}  // namespace dualdamp::friction
