#pragma once
/// A quantity that is an affine function of time, position and velocity, plus one decaying term:
///
///   q = constant + rate s + position x + velocity v + transient exp(-decay s)
///
/// s: time since the interval began [s]; x: position [m]; v: velocity [m/s]. Force [N], static force limit [N] and
/// guards of an affine law have this form in each interval.

namespace dualdamp::friction {

struct Affine {
  double constant = 0.0;
  double rate = 0.0;       ///< per second
  double position = 0.0;   ///< per metre
  double velocity = 0.0;   ///< per m/s
  double transient = 0.0;  ///< at s = 0
  double decay = 0.0;      ///< 1/s
  /// If the numbers above are small differences of large terms: the sum of the moduli of these terms, a scale of
  /// rounding.
  double cancelled = 0.0;
};

/// Needs: at most one of the two has a transient, or both have the same decay.
[[nodiscard]] constexpr Affine operator+(const Affine& a, const Affine& b) {
  return {a.constant + b.constant,  a.rate + b.rate,           a.position + b.position,
          a.velocity + b.velocity,  a.transient + b.transient, a.transient != 0.0 ? a.decay : b.decay,
          a.cancelled + b.cancelled};
}

[[nodiscard]] constexpr Affine operator*(double factor, const Affine& a) {
  return {factor * a.constant,
          factor * a.rate,
          factor * a.position,
          factor * a.velocity,
          factor * a.transient,
          a.decay,
          (factor < 0.0 ? -factor : factor) * a.cancelled};
}

[[nodiscard]] constexpr Affine operator-(const Affine& a, const Affine& b) { return a + -1.0 * b; }

}  // namespace dualdamp::friction
