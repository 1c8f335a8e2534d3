#pragma once
/// The Stribeck curve: a force level that falls from static to kinetic as the speed of slip u grows.
///
///   level(u) = kinetic + (static - kinetic) h(u/stribeck_velocity)     [N]
///   h(r) = exp(-r^exponent)  gaussian      exp(-r)  exponential      1/(1 + r^2)  lorentz
///
/// The speed of slip is u = sign(direction) v, which is >= 0 throughout an interval. For u < 0 the formula is
/// continued analytically, so that a step may go beyond the reversal that ends its interval. An exponent below 1
/// gives an infinite slope at v = 0: the integrator takes small steps there, and there is no continuation, so the
/// level of |u| is used for u < 0. Then a mass is released at the static level in spite of rounding; a level that
/// rose for u < 0 would hold the mass again as soon as rounding makes its velocity negative.
///
/// Source: armstrong1994, bo1982 in `docs/refs.bib`. Shared by all laws with such a level.

#include <cmath>
#include <vector>

#include "friction_models/formulas/smooth.hpp"
#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class StribeckCurve {
 public:
  enum class Form { gaussian, exponential, lorentz };

  /// The parameters kinetic, static and stribeck_velocity, with this range of the kinetic level.
  static std::vector<Parameter> parameters(const Range& kinetic);
  /// The parameters exponent and form.
  static std::vector<Parameter> shape_parameters();
  /// The fault of an exponent beside a form that has none.
  static std::vector<ParameterFault> check_shape(const ParameterValues& values);

  /// N, N, m/s; 0 <= kinetic <= static_level, 0 < velocity, 0 < exponent.
  StribeckCurve(double kinetic, double static_level, double velocity, Form form = Form::gaussian,
                double exponent = 2.0)
      : kinetic_(kinetic), static_(static_level), velocity_(velocity), form_(form), exponent_(exponent) {}
  /// From the parameters above; without those of the shape it is exp(-r^2).
  explicit StribeckCurve(const ParameterValues& values);

  /// N, modifiers included.
  [[nodiscard]] double level(const Instant& now, double speed) const {
    const double kinetic = now.force_limit_now(kinetic_);
    return kinetic + (now.force_limit_now(static_) - kinetic) * share(speed / velocity_);
  }
  /// The level as a divisor, for kinetic > 0.
  [[nodiscard]] double divisor(const Instant& now, double speed) const {
    return friction::divisor(level(now, speed), kinetic_);
  }
  [[nodiscard]] double static_level(const Instant& now) const { return now.force_limit_now(static_); }
  /// Nominal [N].
  [[nodiscard]] double kinetic() const { return kinetic_; }
  /// m/s
  [[nodiscard]] double velocity() const { return velocity_; }

 private:
  /// h(r)
  [[nodiscard]] double share(double r) const {
    switch (form_) {
      case Form::exponential:
        return std::exp(-r);
      case Form::lorentz:
        return 1.0 / (1.0 + r * r);
      case Form::gaussian:
        break;
    }
    return std::exp(-(exponent_ < 1.0 ? std::pow(std::abs(r), exponent_) : continued_power(r, exponent_)));
  }

  double kinetic_;
  double static_;
  double velocity_;
  Form form_;
  double exponent_;
};

}  // namespace dualdamp::friction
