#include "bench/case.hpp"

#include <nlohmann/json.hpp>

#include "identify/estimate.hpp"
#include "scenarios/measurements/measure.hpp"

namespace dualdamp::bench {

namespace {

using Json = nlohmann::ordered_json;
using identify::Estimate;

/// What all cases of a motion share: perfect sensors' view of its steady states and of its decay.
struct Motions {
  scenarios::MotionRecord curve;
  std::optional<scenarios::MotionRecord> decay;
  double stated = 1.0;  ///< forcing frequency that the laboratory believes in, over the one it drives at
};

ReferenceMotion reference_of(const Truth& truth, const ExcitationRange& range,
                             const sim::SteadyStateOptions& options) {
  sim::Model model = undisturbed(truth);
  model.excitation.amplitude = range.amplitudes[range.amplitudes.size() / 2];
  model.excitation.frequency = range.frequencies[range.frequencies.size() / 2];
  const sim::SteadyState middle = sim::steady_state(model, options);
  return {.amplitude = middle.amplitude, .frequency = model.excitation.frequency, .Y = model.excitation.amplitude};
}

sim::Model model_of(const Grid::Motion& motion, const Truth& truth, const sim::SteadyStateOptions& options) {
  if (motion.law == nullptr) return undisturbed(truth);
  return departed(*motion.law, truth, reference_of(truth, *motion.range, options), motion.severity);
}

Motions motions_of(const Grid& grid, const Grid::Motion& motion, const Truth& truth,
                   const identify::Sensors& sensors, const sim::SteadyStateOptions& options) {
  const sim::Model model = model_of(motion, truth, options);
  Motions result;
  scenarios::Measurement curve{.kind = scenarios::MeasurementKind::steady_states};
  curve.amplitudes = motion.range->amplitudes;
  curve.frequencies = motion.range->frequencies;
  result.stated = truth.model.excitation.frequency / model.excitation.frequency;
  for (double& frequency : curve.frequencies) frequency /= result.stated;
  result.curve = scenarios::motion_of(model, curve, sensors, options);
  if (!grid.question().decay) return result;
  sim::Model released = model;
  released.excitation = {};
  released.initial = {.position = grid.question().decay->displacement};
  scenarios::Measurement decay{.kind = scenarios::MeasurementKind::free_decay};
  decay.peaks = grid.question().decay->peaks;
  result.decay = scenarios::motion_of(released, decay, sensors, options);
  return result;
}

Json interval_json(const std::optional<identify::ParameterIntervals>& intervals,
                   std::array<double, 2> identify::ParameterIntervals::* member) {
  if (!intervals) return nullptr;
  return Json::array({((*intervals).*member)[0], ((*intervals).*member)[1]});
}

Json estimate_json(const Estimate& estimate) {
  Json json = {{"method", estimate.method}};
  if (!estimate.outcome.ok()) {
    json["reason"] = estimate.outcome.reason;
    return json;
  }
  json["zeta"] = estimate.value.zeta;
  json["F0"] = estimate.value.F0;
  json["zeta95"] = interval_json(estimate.interval95, &identify::ParameterIntervals::zeta);
  json["F095"] = interval_json(estimate.interval95, &identify::ParameterIntervals::F0);
  json["usable"] = estimate.usable;
  json["fired"] = estimate.lack_of_fit && estimate.lack_of_fit->fired;
  return json;
}

}  // namespace

void run_motion(const Grid& grid, const Truth& truth, const sim::SteadyStateOptions& options, std::size_t number,
                const std::function<bool(std::size_t)>& wanted, const TakeLine& take) {
  const StressTest& question = grid.question();
  const Grid::Motion motion = grid.motion(number);
  const sim::Oscillator& oscillator = truth.model.oscillator;
  const identify::KnownConstants constants{oscillator.mass, oscillator.stiffness, truth.model.excitation.frequency};
  std::size_t place = number * grid.cases_per_motion();
  std::optional<Motions> unsampled;  // serves all sensors that sample nothing
  for (const SensorSet& sensors : question.sensors) {
    std::optional<Motions> sampled;
    std::optional<Motions>& motions = sensors.sensors.sample_rate > 0.0 ? sampled : unsampled;
    for (int seed = 0; seed < question.seeds; ++seed, ++place) {
      if (!wanted(place)) continue;
      if (!motions) motions = motions_of(grid, motion, truth, sensors.sensors, options);
      std::vector<std::string> warnings;
      const auto random = static_cast<std::uint64_t>(seed);
      identify::Record record = scenarios::reading(motions->curve, sensors.sensors, random, warnings);
      if (record.pairs)
        for (identify::Pair& pair : record.pairs->pairs) pair.omega *= motions->stated;
      if (motions->decay)
        record.decay = scenarios::reading(*motions->decay, sensors.sensors, random, warnings).decay;
      Json line = {{"case", place},
                   {"law", motion.name()},
                   {"severity", motion.severity},
                   {"range", motion.range->name},
                   {"sensors", sensors.name},
                   {"seed", seed}};
      if (!motions->curve.warnings.empty()) line["reason"] = motions->curve.warnings.front();
      line["estimates"] = Json::array();
      for (const identify::MethodEntry* method : question.methods)
        line["estimates"].push_back(estimate_json(method->run(record, constants, {})));
      take(line.dump());
    }
  }
}

}  // namespace dualdamp::bench
