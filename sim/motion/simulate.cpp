#include "sim/motion/simulate.hpp"

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
  // The engine adds up periods and pieces of the drive, and ends there within rounding.
  if (history.outcome.ok()) history.final.t = options.duration;
  sampler.finish(history.final);
  history.samples = std::move(sampler.samples());
  history.energy = energy.account();
  history.certificate = engine.count();
  return history;
}

}  // namespace dualdamp::sim
