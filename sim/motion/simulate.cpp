#include "sim/motion/simulate.hpp"

#include <cmath>

#include "sim/engine/engine.hpp"
#include "sim/motion/event_forecast.hpp"
#include "sim/motion/observers.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

History simulate(const Model& model, const SimulateOptions& options) {
  require_in(friction::not_negative, "analysis.duration", options.duration, "s");
  require_in(friction::not_negative, "analysis.sample_rate", options.sample_rate, "Hz");
  History history;
  const std::unique_ptr<Engine> owned = make_engine(model);
  Engine& engine = *owned;
  Sampler sampler = options.sample_rate > 0.0 ? Sampler(options.sample_rate) : Sampler(options.times);
  EnergyAudit energy(model.oscillator);
  EventForecast forecast(model, options.duration, options.max_events);
  while (const Interval* interval = engine.next(options.duration)) {
    sampler.observe(*interval);
    energy.observe(*interval);
    for (const core::Grazing& grazing : engine.grazings()) {
      const Sample grazed = interval->at(grazing.s);
      history.events.push_back({grazed.t, EventKind::grazing, grazed.x, grazed.v});
    }
    history.final = interval->at(interval->duration);
    if (!interval->ending) continue;
    history.final.v = engine.velocity();
    history.events.push_back({interval->end(), *interval->ending, engine.position(), engine.velocity()});
    const long count = static_cast<long>(history.events.size());
    forecast.observe(history.final, count);
    if (count >= options.max_events || forecast.is_hopeless()) {
      history.outcome = {core::OutcomeKind::event_limit,
                         "more than " + std::to_string(options.max_events) + " events before the end"};
      break;
    }
  }
  if (history.outcome.ok()) history.outcome = engine.outcome();
  sampler.finish(history.final);
  history.samples = std::move(sampler.samples());
  history.energy = energy.account();
  history.certificate = engine.count();
  return history;
}

FreeDecay free_decay(const Model& model, int count) {
  FreeDecay decay;
  const std::unique_ptr<Engine> owned = make_engine(valid_free(model, "free_decay"));
  Engine& engine = *owned;
  if (engine.velocity() == 0.0) decay.extremes.push_back({0.0, engine.position()});
  // A motion that creeps without reversals (strong damping, friction that never quite holds the mass) has no
  // further extreme. If damping is so close to critical that a swing lasts a hundred natural periods, the swing
  // ends at exp(-628) of its start.
  const double patience = 100.0 * 2.0 * std::acos(-1.0) / natural_frequency(model.oscillator);
  double deadline = patience;
  while (static_cast<int>(decay.extremes.size()) < count) {
    if (engine.direction() == friction::Direction::none) {
      decay.came_to_rest = true;
      break;
    }
    const Interval* interval = engine.next(deadline);
    if (interval == nullptr) {
      decay.creeps = engine.outcome().ok();
      break;
    }
    if (!interval->ending) continue;
    deadline = interval->end() + patience;
    if (interval->ending == EventKind::reversal || interval->ending == EventKind::stop) {
      decay.extremes.push_back({interval->end(), engine.position()});
    }
  }
  decay.outcome = engine.outcome();
  decay.accuracy = engine.accuracy();
  decay.work = engine.work();
  return decay;
}

}  // namespace dualdamp::sim
