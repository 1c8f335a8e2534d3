#pragma once
/// A law whose mass moves at constant speed.

#include "sim/law_host/law_host.hpp"

namespace dualdamp::test {

/// Continues at this speed for this time, without a stop before; the host has the direction.
inline void go_on(sim::LawHost& host, double speed, double duration) {
  const friction::Instant from = host.now();
  host.move_along(from.t + duration, [=](double t) {
    return friction::Instant{.t = t, .x = from.x + speed * (t - from.t), .v = speed};
  });
}

/// Stops, then slides at this speed for this time; 0: stays at rest.
inline void slide(sim::LawHost& host, double speed, double duration) {
  using friction::Direction;
  host.change_direction(speed > 0.0 ? Direction::forward : speed < 0.0 ? Direction::backward : Direction::none);
  go_on(host, speed, duration);
}

}  // namespace dualdamp::test
