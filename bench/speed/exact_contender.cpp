#include <cmath>
#include <memory>

#include "bench/speed/contender.hpp"
#include "sim/engine/exact_engine.hpp"

namespace dualdamp::bench::speed {
namespace {

IntegratedMotion integrate(const StandardCase& work, sim::ExactEngine& engine, int periods) {
  engine.start(work.start_position, work.start_velocity);
  const double end = periods * engine.period();
  IntegratedMotion motion;
  double turning = 0.0;
  while (const sim::Interval* interval = engine.next(end)) {
    if (interval->ending != sim::EventKind::reversal) continue;
    motion.amplitude = 0.5 * std::abs(engine.position() - turning);
    turning = engine.position();
    ++motion.reversals;
  }
  return motion;
}

}  // namespace

Contender exact_contender(const StandardCase& work) {
  return {"dualdamp, exact engine", 0.0, 1,
          [work, engine = std::make_shared<sim::ExactEngine>(model_of(work))](int periods) {
            return integrate(work, *engine, periods);
          }};
}

}  // namespace dualdamp::bench::speed
