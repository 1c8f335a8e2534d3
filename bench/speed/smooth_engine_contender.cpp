#include <fmt/core.h>

#include <memory>

#include "bench/speed/smooth_contender.hpp"
#include "sim/engine/smooth_engine.hpp"

namespace dualdamp::bench::speed {

SmoothContender smooth_engine(const SmoothCase& work, double tolerance) {
  sim::Model model = work.model;
  model.solver.tolerance = tolerance;
  auto engine = std::make_shared<sim::SmoothEngine>(model);
  return {fmt::format("{:.0e}", tolerance),
          [engine, start = work.start](int periods, std::vector<double>& turning_points) {
            engine->restart(start);
            const double end = periods * engine->period();
            while (const sim::Interval* interval = engine->next(end)) {
              if (interval->ending == sim::EventKind::reversal) turning_points.push_back(engine->position());
            }
          }};
}

}  // namespace dualdamp::bench::speed
