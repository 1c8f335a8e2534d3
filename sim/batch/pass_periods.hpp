#pragma once
/// Motions from a given state, reversal by reversal, over whole forcing periods.

#include "core/constants.hpp"
#include "sim/batch/find_orbits.hpp"

namespace dualdamp::sim::batch {

/// A motion in each lane, at the start of an interval.
template <Pack P>
struct Traveller {
  using Vector = typename P::Vector;
  using Mask = typename P::Mask;

  Vector x;
  Vector v;  ///< by natural time
  Vector side;
  Vector angle;           ///< of the drive, in [0, 2 pi)
  ComplexPack<P> turned;  ///< e^{i angle}
  Vector left;            ///< whole periods to come, including the present one
  Vector turning;
  Vector amplitude;
  Vector reversals;
  Mask running;
  Mask arrived;

  Traveller(const Oscillation<P>& o, Vector position, Vector velocity, int periods)
      : x(position),
        v(velocity / o.natural),
        side(P::choose(velocity < 0.0, splat<P>(-1.0), splat<P>(1.0))),
        angle(splat<P>(0.0)),
        turned{splat<P>(1.0), splat<P>(0.0)},
        left(splat<P>(periods)),
        turning(splat<P>(0.0)),
        amplitude(splat<P>(0.0)),
        reversals(splat<P>(0.0)) {
    running = o.simple & ((v < 0.0) | (v > 0.0));
    arrived = running & !running;
  }

  void pass_interval(const Oscillation<P>& o);
};

/// Carries the motions to the next reversal, or to the end if that is first.
template <Pack P>
void Traveller<P>::pass_interval(const Oscillation<P>& o) {
  const Interval<P> interval(o, x, v, side, angle, turned);
  const Vector remaining = (left * core::two_pi - angle) / o.r;
  const ReversalSearch<P> search(o, interval, remaining, running, running & (v == 0.0));

  const Mask reverses = search.found() & (search.time() < remaining);
  const Motion<P> reversal = interval.after(o, search.own(), search.turn());
  // The new direction is that of the pull, which must exceed the static limit.
  const Mask moves = reverses & (abs<P>(reversal.a) > o.slip + o.hold + clearly * (abs<P>(reversal.x) + o.hold));
  const Mask ends = search.beyond() | (search.found() & !reverses);
  if (P::any(ends)) {
    const Motion<P> end = interval.after(o, o.own(remaining), interval.turn(o, remaining));
    update<P>(x, ends, end.x);
    update<P>(v, ends, end.v);
  }
  arrived = arrived | ends;
  running = moves;

  update<P>(amplitude, moves, 0.5 * abs<P>(reversal.x - turning));
  update<P>(turning, moves, reversal.x);
  update<P>(reversals, moves, reversals + 1.0);
  update<P>(x, moves, reversal.x);
  update<P>(v, moves, splat<P>(0.0));
  side = -side;
  turned = search.turn();
  update<P>(angle, moves, angle + o.r * search.time());
  const Mask wraps = angle >= core::two_pi;
  update<P>(angle, wraps, angle - core::two_pi);
  update<P>(left, wraps, left - 1.0);
}

template <Pack P>
void pass_periods(const Oscillators& all, const PeriodsAhead& ahead) {
  for (std::size_t first = 0; first < all.count; first += P::width) {
    const Oscillation<P> oscillation(all, first);
    Traveller<P> traveller(oscillation, P::load(ahead.position + first), P::load(ahead.velocity + first),
                           ahead.periods);
    while (P::any(traveller.running)) traveller.pass_interval(oscillation);
    P::store(traveller.x, ahead.position + first);
    P::store(traveller.v * oscillation.natural, ahead.velocity + first);
    P::store(traveller.amplitude, ahead.amplitude + first);
    P::store(traveller.reversals, ahead.reversals + first);
    P::store(flag<P>(traveller.arrived), ahead.certified + first);
  }
}

}  // namespace dualdamp::sim::batch
