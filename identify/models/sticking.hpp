#pragma once
/// Whether a steady state sticks under Coulomb and viscous friction: x > S(zeta, r) x_f if and only if it does not,
/// with the limit S of Den Hartog's closed form (`sim/analytic/den_hartog.hpp`). zeta >= 0; x and x_f in one unit.
///
/// Source: denhartog1931. Cost: a few microseconds at a new frequency ratio, nothing at that of the state before.

namespace dualdamp::identify {

class Sticking {
 public:
  Sticking(double zeta, double x_f) : zeta_(zeta), x_f_(x_f) {}

  /// The least x/x_f of a motion that does not stick, at the frequency ratio r > 0.
  [[nodiscard]] double limit(double r);

  /// Also true of an x that is not a number.
  [[nodiscard]] bool sticks(double x, double r) { return !(x > limit(r) * x_f_); }

 private:
  double zeta_ = 0.0;
  double x_f_ = 0.0;
  double r_ = 0.0;  ///< of `limit_`
  double limit_ = 0.0;
};

}  // namespace dualdamp::identify
