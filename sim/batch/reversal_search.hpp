#pragma once
/// The first reversal of each oscillator of a pack, with the certificate of core/first_crossing.hpp.
///
/// The guard is g = side v, positive while the phase lasts. A panel's quintic Hermite interpolant less the remainder of the
/// sixth derivative, in Bernstein form of degree six, is a lower bound L of g: all coefficients positive, no zero; one
/// sign change, one root, accepted when g is monotone from where L still is positive up to it. Everything else halves the
/// panel. A lane that after `most_halvings` is still undecided (a grazing, a flat reversal) is given up, not guessed.
/// Every lower bound is lowered further by the rounding of g: (16 eps + eps max|z| s) times the sum of its amplitudes.

#include "sim/batch/oscillation.hpp"

namespace dualdamp::sim::batch {

inline constexpr double epsilon = 0x1p-52;

/// g and its derivatives at one end of a panel.
template <Pack P>
struct Jet {
  typename P::Vector value;
  typename P::Vector slope;
  typename P::Vector curvature;

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

  /// A root between a positive and a negative end: Newton with bisection as a safeguard, good to about 1e-3.
  [[nodiscard]] Vector root(Vector t) const {
    Vector low = splat<P>(0.0);
    Vector high = splat<P>(1.0);
    for (int i = 0; i < 3; ++i) {
      const Vector value = at(t);
      low = value > 0.0 ? t : low;
      high = value > 0.0 ? high : t;
      const Vector next = t - value / slope(t);
      t = (next >= low) & (next <= high) ? next : 0.5 * (low + high);
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

  /// For the lanes of `wanted`; `from_reversal`: g has a simple zero at the start. Behind `horizon` (natural time) a lane
  /// need not look.
  ReversalSearch(const Oscillation<P>& oscillation, const Phase<P>& phase, Vector horizon, Mask wanted,
                 Mask from_reversal);

  /// The reversal of these lanes is certified.
  [[nodiscard]] Mask found() const { return found_; }
  /// These lanes have none before the horizon, certified.
  [[nodiscard]] Mask beyond() const { return beyond_; }
  /// Natural time of the reversal, and exp(z s), exp(i r s) there.
  [[nodiscard]] Vector time() const { return time_; }
  [[nodiscard]] const Complex& own() const { return own_; }
  [[nodiscard]] const Complex& turn() const { return turn_; }

 private:
  static constexpr double panel_angle = 3.2;
  static constexpr int most_halvings = 5;

  [[nodiscard]] Jet<P> jet(const Complex& free, const Complex& driven) const {
    const Motion<P> m = phase_.at(o_, free, driven);
    return {phase_.side * m.v, phase_.side * m.a, phase_.side * m.jerk};
  }
  [[nodiscard]] Vector slack(Vector s) const { return (16.0 * epsilon + epsilon * o_.fastest * s) * amplitude_; }
  [[nodiscard]] Vector remainder() const {
    const Vector h2 = width_ * width_;
    return sixth_ * h2 * h2 * h2 * (1.0 / 14400.0);
  }

  void bound();
  void set_panel();
  void halve(Mask which);
  void step();
  void locate();
  Mask polish(Vector& s, Complex& own, Complex& turn, Jet<P>& at) const;
  [[nodiscard]] Mask certify(const Quintic<P>& quintic, Vector root, Vector slope) const;

  const Oscillation<P>& o_;
  const Phase<P>& phase_;
  Vector horizon_;
  Vector amplitude_;  ///< bounds of |g|, |g''| and the sixth derivative over the whole phase
  Vector curvature_;
  Vector sixth_;

  // The present panel [begin_, begin_ + width_].
  Vector begin_;
  Vector width_;
  Complex free_;    ///< c e^{z s} at its begin
  Complex driven_;  ///< G e^{i angle} there
  Jet<P> left_;
  Complex free_gain_;  ///< from its begin to its end
  Complex driven_gain_;
  Vector halvings_;
  Mask at_zero_;  ///< g has a known zero at the begin

  Mask searching_;
  Mask pending_;  ///< one root in the panel, still to be located
  Mask found_;
  Mask beyond_;
  Vector time_;
  Complex own_;
  Complex turn_;
};

template <Pack P>
ReversalSearch<P>::ReversalSearch(const Oscillation<P>& oscillation, const Phase<P>& phase, Vector horizon,
                                  Mask wanted, Mask from_reversal)
    : o_(oscillation),
      phase_(phase),
      horizon_(horizon),
      begin_(splat<P>(0.0)),
      width_(panel_angle / oscillation.fastest),
      free_(phase.own),
      driven_(phase.forced),
      left_(jet(free_, driven_)),
      halvings_(splat<P>(0.0)),
      at_zero_(from_reversal),
      searching_(wanted),
      time_(splat<P>(0.0)),
      own_{splat<P>(1.0), splat<P>(0.0)},
      turn_{splat<P>(1.0), splat<P>(0.0)} {
  pending_ = found_ = beyond_ = wanted & !wanted;
  left_.value = at_zero_ ? splat<P>(0.0) : left_.value;
  bound();
  set_panel();
  while (P::any(searching_)) {
    while (P::any(searching_)) step();
    if (P::any(pending_)) locate();
  }
}

/// Every |z| of the own motion is 1 in natural time, and it never grows.
template <Pack P>
void ReversalSearch<P>::bound() {
  const Vector free = P::sqrt(phase_.own.norm());
  const Vector driven = o_.r * P::sqrt(phase_.forced.norm());
  const Vector r2 = o_.r * o_.r;
  amplitude_ = free + driven;
  curvature_ = free + r2 * driven;
  sixth_ = free + r2 * r2 * r2 * driven;
}

template <Pack P>
void ReversalSearch<P>::set_panel() {
  free_gain_ = o_.own(width_);
  driven_gain_ = o_.turn(width_);
}

template <Pack P>
void ReversalSearch<P>::halve(Mask which) {
  if (!P::any(which)) return;
  width_ = which ? 0.5 * width_ : width_;
  halvings_ = which ? halvings_ + 1.0 : halvings_;
  set_panel();
}

/// Clears the present panel, finds that it holds one root, or halves it.
template <Pack P>
void ReversalSearch<P>::step() {
  const Complex free = free_ * free_gain_;
  const Complex driven = driven_ * driven_gain_;
  const Jet<P> right = jet(free, driven);
  const Vector end = begin_ + width_;
  const Vector rounding = slack(end);

  // Degree five, raised to six.
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

  free_ = choose<P>(clear, free, free_);
  driven_ = choose<P>(clear, driven, driven_);
  left_ = {clear ? right.value : left_.value, clear ? right.slope : left_.slope,
           clear ? right.curvature : left_.curvature};
  begin_ = clear ? end : begin_;
  at_zero_ = at_zero_ & !clear;
  const Mask past = clear & (begin_ >= horizon_);
  beyond_ = beyond_ | past;
  pending_ = pending_ | crossed;
  const Mask given_up = undecided & (halvings_ >= most_halvings);
  searching_ = searching_ & !(crossed | past | given_up);
  halve(undecided & !given_up);
}

/// Newton's root of the interpolant, polished on the closed form and certified; otherwise the panel is halved.
template <Pack P>
void ReversalSearch<P>::locate() {
  const Jet<P> right = jet(free_ * free_gain_, driven_ * driven_gain_);
  const Quintic<P> quintic(left_, right, width_);
  // Seen from the far end, where the guard is negative.
  const Vector seen = 1.0 - right.halley() / width_;
  const Vector guess = (seen > 0.0) & (seen <= 1.0) ? seen : splat<P>(1.0);
  Vector s = begin_ + width_ * quintic.root(guess);
  Complex own = o_.own(s);
  Complex turn = o_.turn(s);
  Jet<P> at = jet(phase_.own * own, phase_.forced * turn);
  const Mask settled = pending_ & polish(s, own, turn, at);
  const Mask accepted = settled & certify(quintic, s, at.slope);
  found_ = found_ | accepted;
  time_ = accepted ? s : time_;
  own_ = choose<P>(accepted, own, own_);
  turn_ = choose<P>(accepted, turn, turn_);

  const Mask again = pending_ & !accepted & (halvings_ < most_halvings);
  pending_ = pending_ & !pending_;
  searching_ = again;
  halve(again);
}

/// exp(w) - 1 for |w| < 0.03, to rounding of exp.
template <Pack P>
ComplexPack<P> small_exponential(const ComplexPack<P>& w) {
  ComplexPack<P> sum{splat<P>(1.0), splat<P>(0.0)};
  for (const double part : {1.0 / 7.0, 1.0 / 6.0, 1.0 / 5.0, 1.0 / 4.0, 1.0 / 3.0, 1.0 / 2.0}) {
    sum = sum * ComplexPack<P>{part * w.re, part * w.im};
    sum.re = sum.re + 1.0;
  }
  return sum * w;
}

template <Pack P>
ComplexPack<P> shifted(const ComplexPack<P>& value, const ComplexPack<P>& by) {
  const ComplexPack<P> gain = value * small_exponential<P>(by);
  return {value.re + gain.re, value.im + gain.im};
}

/// Halley's iteration. The exponentials are evaluated once and then shifted, but for large steps.
template <Pack P>
typename P::Mask ReversalSearch<P>::polish(Vector& s, Complex& own, Complex& turn, Jet<P>& at) const {
  Mask moving = pending_;
  Mask settled = pending_ & !pending_;
  for (int i = 0; i < 6 && P::any(moving); ++i) {
    const Vector step = at.halley();
    const Vector size = abs<P>(step);
    const Mask large = moving & !(size * o_.fastest < 0.03);
    const Vector next = s - step;
    Complex next_own = shifted<P>(own, {o_.zeta * step, -o_.eta * step});
    Complex next_turn = shifted<P>(turn, {splat<P>(0.0), -o_.r * step});
    if (P::any(large)) {
      next_own = choose<P>(large, o_.own(next), next_own);
      next_turn = choose<P>(large, o_.turn(next), next_turn);
    }
    s = moving ? next : s;
    own = choose<P>(moving, next_own, own);
    turn = choose<P>(moving, next_turn, turn);
    // Convergence is cubic on the guard's own scales: behind so small a step nothing is left to correct.
    const Mask last = (size * o_.fastest < 5e-6) & (size * abs<P>(at.curvature) < 5e-6 * abs<P>(at.slope));
    at = jet(phase_.own * own, phase_.forced * turn);
    settled = settled | (moving & last);
    moving = moving & !last;
  }
  return settled;
}

/// g >= L > 0 up to a point shortly before `root`, and g is monotone from there across it.
template <Pack P>
typename P::Mask ReversalSearch<P>::certify(const Quintic<P>& quintic, Vector root, Vector slope) const {
  const Vector rounding = slack(begin_ + width_);
  // |g - H| <= 14400/46080 of the remainder anywhere on the panel.
  const Vector reach = 2.0 * (0.3125 * remainder() + rounding) / -slope;
  const Vector room = root - begin_;
  const Vector gap = reach < room ? reach : room;
  const Vector before = (room - gap) / width_;
  const Vector edge = before * (1.0 - before);
  const Vector low = quintic.at(before) - 20.0 * remainder() * edge * edge * edge - rounding;
  const Mask positive = (before > 0.0) & (low > 0.0);
  const Mask from_begin = (before <= 0.0) & !at_zero_;
  return (slope < 0.0) & (root > begin_) & (root <= begin_ + width_) & (curvature_ * gap < -slope) &
         (positive | from_begin);
}

}  // namespace dualdamp::sim::batch
