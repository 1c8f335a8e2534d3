#pragma once
/// Symmetric periodic orbits without sticking, as fixed points of the half-period map.
///
/// The map. From the turning point x = X, v = 0 at the drive's angle `alpha` the mass moves back until its
/// certified first reversal, after the time s: (X, alpha) -> (-x(s), alpha + r s - pi). The orbit is a fixed point;
/// its second half period is the mirror image of the first. The derivative D of the map is exact: the propagator of
/// the interval, and the shift of the reversal ds = -dv/a. The full period's Floquet multipliers are the squares of
/// D's eigenvalues.
///
/// Newton's method starts from the response to the fundamental of the friction force (harmonic balance). Its result
/// is accepted only if the map closes to 1e-14, each half period is certified and the mass does not stick at the
/// turning point (|pull| > static); the caller checks that the orbit attracts. With zeta >= 0 and a friction force
/// that never falls with speed (static = kinetic) two motions never move apart, so an orbit that attracts is the
/// only one.

#include <numbers>

#include "core/constants.hpp"
#include "sim/batch/reversal_search.hpp"

namespace dualdamp::sim::batch {

/// A limit nearer than this (relative) is left to the exact engine.
inline constexpr double clearly = 1e-9;
inline constexpr int shots = 3;
inline constexpr int most_newton_steps = 10;

/// A candidate orbit in each lane, and the half-period map from it.
template <Pack P>
struct OrbitCandidate {
  using Vector = typename P::Vector;
  using Mask = typename P::Mask;
  using Complex = ComplexPack<P>;

  Vector peak;         ///< X [m]
  Complex turned;      ///< e^{i alpha}
  Complex half_cycle;  ///< exp(z s) over half a period
  Mask alive;

  // Of the map at the candidate.
  Vector peak_gap;   ///< image - X [m]
  Vector angle_gap;  ///< image - alpha
  Vector d00, d01, d10, d11;

  // Certificate of the map, all candidates together.
  Vector searches;
  Vector panels;
  Vector splits;

  explicit OrbitCandidate(const Oscillation<P>& o);
  void shoot(const Oscillation<P>& o);
  void apply_map(const Oscillation<P>& o);
  void newton_step();
  void move(Vector peak_step, Vector angle_step);

  [[nodiscard]] Mask closes() const {
    return alive & (abs<P>(peak_gap) <= closure * peak) & (abs<P>(angle_gap) <= closure);
  }
  /// Largest modulus of the full period's Floquet multipliers.
  [[nodiscard]] Vector radius() const;
};

/// The start by harmonic balance: the friction's fundamental 4 x_f/pi opposes the velocity, so at the peak
/// Y e^{i alpha} = (1 - r^2) X + i (2 zeta r X + 4 x_f/pi).
template <Pack P>
OrbitCandidate<P>::OrbitCandidate(const Oscillation<P>& o)
    : searches(splat<P>(0.0)), panels(searches), splits(searches) {
  const Vector friction = (4.0 / std::numbers::pi) * o.slip;
  const Vector elastic = 1.0 - o.r * o.r;
  const Vector viscous = 2.0 * o.zeta * o.r;
  const Vector square = elastic * elastic + viscous * viscous;
  const Vector half = viscous * friction;
  peak = (P::sqrt(half * half + square * (o.drive.norm() - friction * friction)) - half) / square;
  alive = o.simple & (o.hold == o.slip) & (peak > 0.0);
  turned = Complex{elastic * peak, viscous * peak + friction} / o.drive;
  const Vector size = 1.0 / P::sqrt(turned.norm());
  turned = {turned.re * size, turned.im * size};
  half_cycle = o.own(std::numbers::pi / o.r);
  for (int i = 0; i < shots; ++i) shoot(o);
}

/// Derivative of the end of an interval by its start X, alpha at fixed duration.
template <Pack P>
struct IntervalDerivative {
  using Vector = typename P::Vector;
  Vector x_peak, x_angle, v_peak, v_angle;

  /// For exp(z s) and G e^{i angle} at the end.
  IntervalDerivative(const Oscillation<P>& o, const Interval<P>& interval, const ComplexPack<P>& own,
                     const ComplexPack<P>& pushed) {
    // Free motion from unit velocity and from unit position.
    const Vector from_velocity = own.im / o.eta;
    const Vector from_position = own.re + o.zeta * from_velocity;
    x_peak = from_position;
    v_peak = -from_velocity;
    const Vector start_x = interval.forced.im;
    const Vector start_v = o.r * interval.forced.re;
    x_angle = start_x * from_position + start_v * from_velocity - pushed.im;
    v_angle = start_v * (own.re - o.zeta * from_velocity) - start_x * from_velocity - o.r * pushed.re;
  }
};

/// One Newton step for x = -X and v = 0 after exactly half a period.
template <Pack P>
void OrbitCandidate<P>::shoot(const Oscillation<P>& o) {
  const Interval<P> interval(o, peak, splat<P>(0.0), splat<P>(-1.0), turned);
  const Complex pushed{-interval.driven.re, -interval.driven.im};
  const Motion<P> end = interval.at(o, interval.own * half_cycle, pushed);
  const IntervalDerivative<P> d(o, interval, half_cycle, pushed);
  const Vector miss = end.x + peak;
  const Vector x_peak = d.x_peak + 1.0;
  const Vector scale = 1.0 / (x_peak * d.v_angle - d.x_angle * d.v_peak);
  move((d.x_angle * end.v - d.v_angle * miss) * scale, (d.v_peak * miss - x_peak * end.v) * scale);
}

template <Pack P>
void OrbitCandidate<P>::apply_map(const Oscillation<P>& o) {
  const Vector pull = (o.drive * turned).re - peak;
  alive = alive & (peak > 0.0) & (-pull > o.hold + clearly * (peak + o.hold));
  const Interval<P> interval(o, peak, splat<P>(0.0), splat<P>(-1.0), turned);
  const ReversalSearch<P> search(o, interval, core::two_pi / o.r, alive, alive);
  searches = searches + flag<P>(alive);
  panels = panels + search.panels();
  splits = splits + search.halvings();
  alive = search.found();

  const Complex pushed = interval.driven * search.turn();
  const Motion<P> end = interval.at(o, interval.own * search.own(), pushed);
  peak_gap = -end.x - peak;
  angle_gap = o.r * search.time() - std::numbers::pi;
  const IntervalDerivative<P> d(o, interval, search.own(), pushed);
  d00 = -d.x_peak;
  d01 = -d.x_angle;
  d10 = -o.r * d.v_peak / end.a;
  d11 = 1.0 - o.r * d.v_angle / end.a;
}

/// Solves (D - 1) step = -gap.
template <Pack P>
void OrbitCandidate<P>::newton_step() {
  const Vector a = d00 - 1.0;
  const Vector d = d11 - 1.0;
  const Vector scale = 1.0 / (a * d - d01 * d10);
  move((d01 * angle_gap - d * peak_gap) * scale, (d10 * peak_gap - a * angle_gap) * scale);
}

/// The phasor turns by atan(angle_step), which differs from angle_step at third order only.
template <Pack P>
void OrbitCandidate<P>::move(Vector peak_step, Vector angle_step) {
  peak = peak + peak_step;
  const Complex next = turned * Complex{splat<P>(1.0), angle_step};
  const Vector size = 1.0 / P::sqrt(next.norm());
  turned = {next.re * size, next.im * size};
}

template <Pack P>
typename P::Vector OrbitCandidate<P>::radius() const {
  const Vector half_trace = 0.5 * (d00 + d11);
  const Vector determinant = d00 * d11 - d01 * d10;
  const Vector gap = half_trace * half_trace - determinant;
  const Vector real = abs<P>(half_trace) + P::sqrt(larger<P>(gap, splat<P>(0.0)));
  return P::choose(gap >= 0.0, real * real, determinant);
}

/// Lag of x's fundamental behind the drive, in [0, 2 pi). With the angle counted from the peak the friction force
/// is a square wave with the fundamental i 4 x_f/pi.
template <Pack P>
typename P::Vector fundamental_lag(const Oscillation<P>& o, const OrbitCandidate<P>& orbit) {
  using Complex = ComplexPack<P>;
  Complex force = o.drive * orbit.turned;
  force.im = force.im - (4.0 / std::numbers::pi) * o.slip;
  const Complex lag = orbit.turned * (Complex{1.0 - o.r * o.r, 2.0 * o.zeta * o.r} / force);
  const typename P::Vector angle = P::atan2(lag.im, lag.re);
  return P::choose(angle < 0.0, angle + core::two_pi, angle);
}

template <Pack P>
void find_orbits(const Oscillators& all, const Orbits& orbits) {
  using Vector = typename P::Vector;
  using Mask = typename P::Mask;
  for (std::size_t first = 0; first < all.count; first += P::width) {
    const Oscillation<P> oscillation(all, first);
    OrbitCandidate<P> orbit(oscillation);
    Vector peak = splat<P>(0.0);
    Vector lag = peak;
    Vector radius = peak;
    Vector turned_re = peak;
    Vector turned_im = peak;
    Mask closed = orbit.alive & !orbit.alive;
    for (int i = 0; i < most_newton_steps && P::any(orbit.alive); ++i) {
      orbit.apply_map(oscillation);
      const Mask now = orbit.closes();
      update<P>(peak, now, orbit.peak);
      update<P>(radius, now, orbit.radius());
      update<P>(turned_re, now, orbit.turned.re);
      update<P>(turned_im, now, orbit.turned.im);
      if (P::any(now)) update<P>(lag, now, fundamental_lag<P>(oscillation, orbit));
      closed = closed | now;
      orbit.alive = orbit.alive & !now;
      orbit.newton_step();
    }
    P::store(peak, orbits.peak + first);
    P::store(lag, orbits.lag + first);
    P::store(radius, orbits.radius + first);
    P::store(turned_re, orbits.turned_re + first);
    P::store(turned_im, orbits.turned_im + first);
    P::store(orbit.searches, orbits.searches + first);
    P::store(orbit.panels, orbits.panels + first);
    P::store(orbit.splits, orbits.splits + first);
    P::store(flag<P>(closed), orbits.certified + first);
  }
}

}  // namespace dualdamp::sim::batch
