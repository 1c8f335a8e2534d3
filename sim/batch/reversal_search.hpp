#pragma once
/// The first reversal of each oscillator of a pack, with the certificate of core/crossing/first_crossing.hpp.
///
/// The guard is g = side v, positive while the interval lasts. A panel's quintic Hermite interpolant less the
/// remainder of the sixth derivative, in Bernstein form of degree six, is a lower bound L of g.
///   * All coefficients of L are positive: no zero.
///   * The coefficients change sign once: one root. It is accepted if g is monotone from a point with L > 0 up to
///     the root.
///   * Otherwise the panel is halved. A lane that is undecided after `most_halvings` is given up (a grazing, a flat
///     reversal).
/// Every lower bound is lowered further by the rounding of g: (16 eps + eps max|z| s) times the sum of its
/// amplitudes.

#include "sim/batch/oscillation.hpp"

namespace dualdamp::sim::batch {

inline constexpr double epsilon = 0x1p-52;

/// g and its derivatives at one end of a panel.
template <Pack P>
struct Jet {
  typename P::Vector value;
  typename P::Vector slope;
  typename P::Vector curvature;

  void update(typename P::Mask mask, const Jet& other) {
    batch::update<P>(value, mask, other.value);
    batch::update<P>(slope, mask, other.slope);
    batch::update<P>(curvature, mask, other.curvature);
  }
  /// Halley's step to a root.
  [[nodiscard]] typename P::Vector halley() const {
    return 2.0 * value * slope / (2.0 * slope * slope - value * curvature);
  }
};

/// The quintic Hermite interpolant of a panel in powers of t in [0, 1].
template <Pack P>
struct Quintic {
  using Vector = typename P::Vector;
  Vector c0, c1, c2, c3, c4, c5;

  Quintic(const Jet<P>& left, const Jet<P>& right, Vector width) : c0(left.value) {
    c1 = left.slope * width;
    c2 = 0.5 * left.curvature * width * width;
    const Vector rise = right.value - c0 - c1 - c2;
    const Vector turn = right.slope * width - c1 - 2.0 * c2;
    const Vector bend = 0.5 * right.curvature * width * width - c2;
    c3 = 10.0 * rise - 4.0 * turn + bend;
    c4 = -15.0 * rise + 7.0 * turn - 2.0 * bend;
    c5 = 6.0 * rise - 3.0 * turn + bend;
  }

  [[nodiscard]] Vector at(Vector t) const { return c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * c5)))); }
  [[nodiscard]] Vector slope(Vector t) const {
    return c1 + t * (2.0 * c2 + t * (3.0 * c3 + t * (4.0 * c4 + t * (5.0 * c5))));
  }

  /// A root between a positive and a negative end, by Newton's method with bisection as a safeguard; its error is a
  /// few per cent at most.
  [[nodiscard]] Vector root(Vector t) const {
    Vector low = splat<P>(0.0);
    Vector high = splat<P>(1.0);
    for (int i = 0; i < 2; ++i) {
      const Vector value = at(t);
      const typename P::Mask above = value > 0.0;
      low = P::choose(above, t, low);
      high = P::choose(above, high, t);
      const Vector next = t - value / slope(t);
      t = P::choose((next >= low) & (next <= high), next, 0.5 * (low + high));
    }
    return t;
  }
};

template <Pack P>
class ReversalSearch {
 public:
  using Vector = typename P::Vector;
  using Mask = typename P::Mask;
  using Complex = ComplexPack<P>;

  /// Searches in the lanes of `wanted`, up to `horizon` (natural time). `from_reversal`: g has a simple zero at the
  /// start.
  ReversalSearch(const Oscillation<P>& oscillation, const Interval<P>& interval, Vector horizon, Mask wanted,
                 Mask from_reversal);

  /// The reversal of these lanes is certified.
  [[nodiscard]] Mask found() const { return found_; }
  /// These lanes have none before the horizon, certified.
  [[nodiscard]] Mask beyond() const { return beyond_; }
  /// Number of certified panels, and of halvings.
  [[nodiscard]] Vector panels() const { return panels_; }
  [[nodiscard]] Vector halvings() const { return halvings_; }
  /// Natural time of the reversal, and exp(z s), e^{i angle} there.
  [[nodiscard]] Vector time() const { return time_; }
  [[nodiscard]] const Complex& own() const { return own_; }
  [[nodiscard]] const Complex& turn() const { return turn_; }

 private:
  static constexpr int most_halvings = 5;

  [[nodiscard]] Jet<P> jet(const Complex& free, const Complex& driven) const {
    const Motion<P> m = interval_.at(o_, free, driven);
    return {interval_.side * m.v, interval_.side * m.a, interval_.side * m.jerk};
  }
  [[nodiscard]] Vector slack(Vector s) const { return (16.0 * epsilon + epsilon * o_.fastest * s) * amplitude_; }
  [[nodiscard]] Vector remainder() const {
    const Vector h2 = width_ * width_;
    return sixth_ * h2 * h2 * h2 * (1.0 / 14400.0);
  }

  void bound();
  void halve(Mask which);
  void step();
  void locate();
  Mask polish(Vector& s, Complex& own, Complex& turn, Jet<P>& at) const;
  [[nodiscard]] Mask certify(const Quintic<P>& quintic, Vector root, Vector slope) const;

  const Oscillation<P>& o_;
  const Interval<P>& interval_;
  Vector horizon_;
  Vector amplitude_;  ///< bounds of |g|, |g''| and the sixth derivative over the whole interval
  Vector curvature_;
  Vector sixth_;

  // The present panel [begin_, begin_ + width_].
  Vector begin_;
  Vector width_;
  Complex free_;    ///< c e^{z s} at its start
  Complex driven_;  ///< G e^{i angle} there
  Jet<P> left_;
  Complex free_gain_;  ///< factor of free_ from its start to its end
  Complex driven_gain_;
  Vector halvings_;
  Vector panels_;
  Mask at_zero_;  ///< g has a known zero at the start

  Mask searching_;
  Mask pending_;  ///< one root in the panel, still to be located
  Mask found_;
  Mask beyond_;
  Vector time_;
  Complex own_;
  Complex turn_;
};

template <Pack P>
ReversalSearch<P>::ReversalSearch(const Oscillation<P>& oscillation, const Interval<P>& interval, Vector horizon,
                                  Mask wanted, Mask from_reversal)
    : o_(oscillation),
      interval_(interval),
      horizon_(horizon),
      begin_(splat<P>(0.0)),
      width_(oscillation.panel),
      free_(interval.own),
      driven_(interval.forced),
      left_(jet(free_, driven_)),
      free_gain_(oscillation.own_panel),
      driven_gain_(oscillation.turn_panel),
      halvings_(splat<P>(0.0)),
      panels_(splat<P>(0.0)),
      at_zero_(from_reversal),
      searching_(wanted),
      time_(splat<P>(0.0)),
      own_(interval.own),
      turn_(interval.forced) {
  pending_ = found_ = beyond_ = wanted & !wanted;
  update<P>(left_.value, at_zero_, splat<P>(0.0));
  bound();
  while (P::any(searching_)) {
    while (P::any(searching_)) step();
    if (P::any(pending_)) locate();
  }
}

/// In natural time |z| of the own motion is 1, and the own motion never grows.
template <Pack P>
void ReversalSearch<P>::bound() {
  const Vector free = P::sqrt(interval_.own.norm());
  const Vector driven = o_.r * P::sqrt(interval_.forced.norm());
  const Vector r2 = o_.r * o_.r;
  amplitude_ = free + driven;
  curvature_ = free + r2 * driven;
  sixth_ = free + r2 * r2 * r2 * driven;
}

template <Pack P>
void ReversalSearch<P>::halve(Mask which) {
  if (!P::any(which)) return;
  update<P>(width_, which, 0.5 * width_);
  update<P>(halvings_, which, halvings_ + 1.0);
  update<P>(free_gain_, which, o_.own(width_));
  update<P>(driven_gain_, which, o_.turn(width_));
}

/// Certifies that the present panel has no zero, finds that it has one root, or halves it.
template <Pack P>
void ReversalSearch<P>::step() {
  const Complex free = free_ * free_gain_;
  const Complex driven = driven_ * driven_gain_;
  const Jet<P> right = jet(free, driven);
  const Vector end = begin_ + width_;
  const Vector rounding = slack(end);

  // Degree five, elevated to six.
  const Vector bend = 0.05 * width_ * width_;
  const Vector left_rise = 0.2 * width_ * left_.slope;
  const Vector right_rise = 0.2 * width_ * right.slope;
  const Vector b1 = left_.value + left_rise;
  const Vector b2 = b1 + left_rise + bend * left_.curvature;
  const Vector b4 = right.value - right_rise;
  const Vector b3 = b4 - right_rise + bend * right.curvature;
  const Mask p0 = at_zero_ | (left_.value > rounding);
  const Mask p1 = left_.value + (5.0 / 6.0) * left_rise > rounding;
  const Mask p2 = b1 + (2.0 / 3.0) * (b2 - b1) > rounding;
  const Mask p3 = 0.5 * (b2 + b3) - remainder() > rounding;
  const Mask p4 = b4 + (2.0 / 3.0) * (b3 - b4) > rounding;
  const Mask p5 = right.value - (5.0 / 6.0) * right_rise > rounding;
  const Mask p6 = right.value > rounding;

  const Mask clear = searching_ & (p0 & p1 & p2 & p3 & p4 & p5 & p6);
  const Mask once = p0 & (p1 | !p2) & (p2 | !p3) & (p3 | !p4) & (p4 | !p5) & (right.value < -rounding);
  const Mask crossed = searching_ & once;
  const Mask undecided = searching_ & !(clear | crossed);

  update<P>(free_, clear, free);
  update<P>(driven_, clear, driven);
  left_.update(clear, right);
  update<P>(begin_, clear, end);
  panels_ = panels_ + flag<P>(clear);
  at_zero_ = at_zero_ & !clear;
  const Mask past = clear & (begin_ >= horizon_);
  beyond_ = beyond_ | past;
  pending_ = pending_ | crossed;
  const Mask given_up = undecided & (halvings_ >= most_halvings);
  searching_ = searching_ & !(crossed | past | given_up);
  halve(undecided & !given_up);
}

/// Polishes the root of the interpolant on the closed form and certifies it; else halves the panel.
template <Pack P>
void ReversalSearch<P>::locate() {
  const Jet<P> right = jet(free_ * free_gain_, driven_ * driven_gain_);
  const Quintic<P> quintic(left_, right, width_);
  // Start from the end at which the guard is smaller, but not from a known zero.
  const Vector share = P::choose(at_zero_, splat<P>(0.9), left_.value / (left_.value - right.value));
  const Mask late = share > 0.5;
  const Vector seen = P::choose(late, 1.0 - right.halley() / width_, -left_.halley() / width_);
  const Vector guess = P::choose((seen > 0.0) & (seen < 1.0), seen, share);
  Vector s = begin_ + width_ * quintic.root(guess);
  Complex own = o_.own(s);
  Complex turn = interval_.turn(o_, s);
  Jet<P> at = jet(interval_.own * own, interval_.driven * turn);
  const Mask settled = pending_ & polish(s, own, turn, at);
  const Mask accepted = settled & certify(quintic, s, at.slope);
  found_ = found_ | accepted;
  panels_ = panels_ + flag<P>(accepted);
  update<P>(time_, accepted, s);
  update<P>(own_, accepted, own);
  update<P>(turn_, accepted, turn);

  const Mask again = pending_ & !accepted & (halvings_ < most_halvings);
  pending_ = pending_ & !pending_;
  searching_ = again;
  halve(again);
}

/// Up to this exponent the series below are exact to rounding.
inline constexpr double small_exponent = 0.03;

/// value e^{i angle} for a small angle.
template <Pack P>
ComplexPack<P> turned_by(const ComplexPack<P>& value, typename P::Vector angle) {
  const typename P::Vector y = angle * angle;
  const typename P::Vector sine =
      angle * (1.0 - y * (1.0 / 6.0) * (1.0 - y * (1.0 / 20.0) * (1.0 - y * (1.0 / 42.0))));
  const typename P::Vector less = 0.5 * y * (1.0 - y * (1.0 / 12.0) * (1.0 - y * (1.0 / 30.0)));
  return {value.re - (value.re * less + value.im * sine), value.im + (value.re * sine - value.im * less)};
}

/// value e^x for a small x.
template <Pack P>
ComplexPack<P> scaled_by(const ComplexPack<P>& value, typename P::Vector x) {
  const typename P::Vector x2 = x * x;
  const typename P::Vector odd =
      x * (1.0 + x2 * (1.0 / 6.0) * (1.0 + x2 * (1.0 / 20.0) * (1.0 + x2 * (1.0 / 42.0))));
  const typename P::Vector even = 0.5 * x2 * (1.0 + x2 * (1.0 / 12.0) * (1.0 + x2 * (1.0 / 30.0)));
  const typename P::Vector gain = odd + even;
  return {value.re + value.re * gain, value.im + value.im * gain};
}

/// Halley's iteration. The exponentials are evaluated once and then shifted; after a large step they are evaluated
/// again.
template <Pack P>
typename P::Mask ReversalSearch<P>::polish(Vector& s, Complex& own, Complex& turn, Jet<P>& at) const {
  Mask moving = pending_;
  Mask settled = pending_ & !pending_;
  for (int i = 0; i < 6; ++i) {
    const Vector step = at.halley();
    const Vector size = abs<P>(step);
    const Mask large = moving & !(size * o_.fastest < small_exponent);
    const Vector next = s - step;
    Complex next_own = scaled_by<P>(turned_by<P>(own, -o_.eta * step), o_.zeta * step);
    Complex next_turn = turned_by<P>(turn, -o_.r * step);
    if (P::any(large)) {
      update<P>(next_own, large, o_.own(next));
      update<P>(next_turn, large, interval_.turn(o_, next));
    }
    update<P>(s, moving, next);
    update<P>(own, moving, next_own);
    update<P>(turn, moving, next_turn);
    // Convergence is cubic on the guard's own scales: after such a small step the error is below rounding.
    const Mask last = moving & (size * o_.fastest < 5e-6) & (size * abs<P>(at.curvature) < 5e-6 * abs<P>(at.slope));
    update<P>(at.slope, last, at.slope - at.curvature * step);
    settled = settled | last;
    moving = moving & !last;
    if (!P::any(moving)) break;
    const Jet<P> there = jet(interval_.own * own, interval_.driven * turn);
    at.update(moving, there);
  }
  return settled;
}

/// Whether g >= L > 0 up to a point shortly before `root`, and g is monotone from there to beyond the root.
template <Pack P>
typename P::Mask ReversalSearch<P>::certify(const Quintic<P>& quintic, Vector root, Vector slope) const {
  const Vector rounding = slack(begin_ + width_);
  // |g - H| <= 14400/46080 of the remainder anywhere on the panel.
  const Vector reach = 2.0 * (0.3125 * remainder() + rounding) / -slope;
  const Vector room = root - begin_;
  const Vector gap = P::choose(reach < room, reach, room);
  const Vector before = (room - gap) / width_;
  const Vector edge = before * (1.0 - before);
  const Vector low = quintic.at(before) - 20.0 * remainder() * edge * edge * edge - rounding;
  const Mask positive = (before > 0.0) & (low > 0.0);
  const Mask from_begin = (before <= 0.0) & !at_zero_;
  return (slope < 0.0) & (root > begin_) & (root <= begin_ + width_) & (curvature_ * gap < -slope) &
         (positive | from_begin);
}

}  // namespace dualdamp::sim::batch
