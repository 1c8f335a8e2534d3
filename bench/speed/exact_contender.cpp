#include <cmath>

#include "bench/speed/contender.hpp"

namespace dualdamp::bench::speed {

Followed ExactContender::follow(int periods) {
  engine_.start(work_.start_position, work_.start_velocity);
  const double end = periods * engine_.period();
  Followed followed;
  double turning = 0.0;
  while (const sim::Interval* interval = engine_.next(end)) {
    if (interval->ending != sim::EventKind::reversal) continue;
    followed.amplitude = 0.5 * std::abs(engine_.position() - turning);
    turning = engine_.position();
    ++followed.reversals;
  }
  return followed;
}

}  // namespace dualdamp::bench::speed
