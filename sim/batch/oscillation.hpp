#pragma once
/// The motion of a pack of oscillators between two reversals, in closed form.
///
/// In natural time (unit 1/wn) and divided by the stiffness the equation of motion is
///
///     x'' + 2 zeta x' + x + side x_f = Re(Y e^{i angle}),   angle' = r,   side = sgn x' frozen,        [m]
///
///     x = -side x_f + Re(G e^{i angle}) + Re(c e^{z s}),   G = Y/(1 - r^2 + 2 i zeta r),   z = -zeta + i eta.

#include "sim/batch/kernels.hpp"
#include "sim/batch/pack.hpp"

namespace dualdamp::sim::batch {

/// Position and its derivatives by natural time.
template <Pack P>
struct Motion {
  typename P::Vector x;
  typename P::Vector v;
  typename P::Vector a;
  typename P::Vector jerk;
};

/// Just over pi, so that a resonant half period is one panel.
inline constexpr double panel_angle = 3.2;

template <Pack P>
struct Oscillation {
  using Vector = typename P::Vector;
  using Mask = typename P::Mask;
  using Complex = ComplexPack<P>;

  Vector natural;  ///< wn [rad/s]
  Vector zeta;
  Vector eta;          ///< sqrt(1 - zeta^2)
  Vector r;            ///< w/wn
  Vector slip;         ///< x_f = kinetic/k [m]
  Vector hold;         ///< static/k [m]
  Complex drive;       ///< Y [m]
  Complex gain;        ///< G [m]
  Vector fastest;      ///< max(1, r): the largest modulus of an exponent
  Vector panel;        ///< width of a search panel in natural time: half a period of the fastest exponential
  Complex own_panel;   ///< exp(z panel)
  Complex turn_panel;  ///< exp(i r panel)
  /// The closed form loses no digits: underdamped, off resonance, nothing out of range. Other oscillators are left
  /// to the exact engine.
  Mask simple;

  Oscillation(const Oscillators& all, std::size_t first);

  /// exp(z s)
  [[nodiscard]] Complex own(Vector s) const { return exponential<P>(zeta * s, eta * s); }
  /// exp(i r s)
  [[nodiscard]] Complex turn(Vector s) const { return rotation<P>(r * s); }
};

template <Pack P>
Oscillation<P>::Oscillation(const Oscillators& all, std::size_t first) {
  const Vector mass = P::load(all.mass + first);
  const Vector stiffness = P::load(all.stiffness + first);
  const Vector amplitude = P::load(all.amplitude + first);
  natural = P::sqrt(stiffness / mass);
  zeta = P::load(all.damping + first) / (2.0 * mass * natural);
  eta = P::sqrt((1.0 - zeta) * (1.0 + zeta));
  r = P::load(all.frequency + first) / natural;
  slip = P::load(all.kinetic + first) / stiffness;
  hold = P::load(all.static_level + first) / stiffness;
  const Vector none = splat<P>(0.0);
  switch (all.drive) {
    case DriveOn::base:
      drive = {amplitude, none};
      break;
    case DriveOn::base_and_damper:
      drive = {amplitude, 2.0 * zeta * r * amplitude};
      break;
    case DriveOn::mass:
      drive = {amplitude / stiffness, none};
      break;
  }
  gain = drive / Complex{1.0 - r * r, 2.0 * zeta * r};
  fastest = larger<P>(splat<P>(1.0), r);
  panel = panel_angle / fastest;
  own_panel = own(panel);
  turn_panel = turn(panel);

  // A comparison with NaN is false.
  const Vector closeness = 0.02 * fastest;
  const Vector apart = zeta * zeta + (r - eta) * (r - eta);
  simple = (zeta >= 0.0) & (eta > 0.05) & (apart > closeness * closeness) & (r > 1.0 / 64.0) & (r < 64.0) &
           (amplitude > 0.0) & (slip >= 0.0) & (hold >= slip) & (hold < 1e100) & (gain.norm() < 1e200) &
           (gain.norm() > 1e-200);
}

/// One interval: the coefficients of the motion from a given state.
template <Pack P>
struct Interval {
  using Vector = typename P::Vector;
  using Complex = ComplexPack<P>;

  Vector side;
  Vector middle;   ///< -side x_f [m]
  Complex driven;  ///< G e^{i angle} is driven e^{i(angle + r s)} after s
  Vector angle;
  Complex forced;  ///< G e^{i angle} at the start
  Complex own;     ///< c

  /// Starts at position x and velocity v, with the drive at start_angle; `turned` = e^{i start_angle}.
  Interval(const Oscillation<P>& o, Vector x, Vector v, Vector direction, Vector start_angle, const Complex& turned)
      : side(direction), middle(-direction * o.slip), driven(o.gain), angle(start_angle), forced(o.gain * turned) {
    start(o, x, v);
  }
  /// Starts at position x and velocity v, where the drive's angle is known only by its phasor `turned`.
  Interval(const Oscillation<P>& o, Vector x, Vector v, Vector direction, const Complex& turned)
      : side(direction),
        middle(-direction * o.slip),
        driven(o.gain * turned),
        angle(splat<P>(0.0)),
        forced(driven) {
    start(o, x, v);
  }

  /// e^{i(angle + r s)}
  [[nodiscard]] Complex turn(const Oscillation<P>& o, Vector s) const { return rotation<P>(angle + o.r * s); }
  /// The motion at s, from decay = exp(z s) and turn = e^{i(angle + r s)}.
  [[nodiscard]] Motion<P> after(const Oscillation<P>& o, const Complex& decay, const Complex& turn) const {
    return at(o, own * decay, driven * turn);
  }

  /// The motion at s, from free = c e^{z s} and pushed = G e^{i angle} at s.
  [[nodiscard]] Motion<P> at(const Oscillation<P>& o, const Complex& free, const Complex& pushed) const {
    const Vector r2 = o.r * o.r;
    const Complex z{-o.zeta, o.eta};
    const Complex z2 = z * z;
    const Complex z3 = z2 * z;
    return {.x = middle + pushed.re + free.re,
            .v = z.re * free.re - z.im * free.im - o.r * pushed.im,
            .a = z2.re * free.re - z2.im * free.im - r2 * pushed.re,
            .jerk = z3.re * free.re - z3.im * free.im + o.r * r2 * pushed.im};
  }

 private:
  void start(const Oscillation<P>& o, Vector x, Vector v) {
    own.re = x - middle - forced.re;
    own.im = -(v + o.r * forced.im + o.zeta * own.re) / o.eta;
  }
};

}  // namespace dualdamp::sim::batch
