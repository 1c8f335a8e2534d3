#include "bench/motions.hpp"

#include <algorithm>
#include <iterator>

#include "bench/departure_names.hpp"
#include "bench/random_response.hpp"
#include "identify/statistics/median.hpp"

namespace dualdamp::bench {

identify::Record Motions::reading(const identify::Sensors& sensors, std::uint64_t seed,
                                  std::vector<std::string>& warnings) const {
  constexpr std::uint64_t of_decay = 0xD1B54A32D192ED03U;  // other draws than those of the curve
  identify::Record record = scenarios::reading(curve, sensors, seed, warnings);
  if (record.pairs)
    for (identify::Pair& pair : record.pairs->pairs) pair.omega *= stated;
  if (decay) record.decay = scenarios::reading(*decay, sensors, seed ^ of_decay, warnings).decay;
  return record;
}

void add_reading(const scenarios::MotionRecord& response, const identify::Sensors& sensors, std::uint64_t seed,
                 identify::Record& record) {
  constexpr std::uint64_t of_response = 0x2545F4914F6CDD1DU;  // other draws than those of curve and decay
  identify::Record read = identify::read(response.exact, sensors, seed ^ of_response);
  std::ranges::move(read.histories, std::back_inserter(record.histories));
}

MotionMaker::MotionMaker(const StressTest& question, const TrueRig& rig, const ExcitationRange& range,
                         const sim::SteadyStateOptions& options)
    : question_(question), rig_(rig), range_(range), options_(options) {}

Reference MotionMaker::reference() const {
  sim::Model model = undisturbed(rig_.truth);
  model.excitation.amplitude = identify::upper_median(range_.amplitudes);
  model.excitation.frequency = identify::upper_median(range_.frequencies_or(rig_.frequency));
  const sim::SteadyState middle = sim::steady_state(model, options_);
  Reference reference{
      {.amplitude = middle.amplitude, .frequency = model.excitation.frequency, .Y = model.excitation.amplitude},
      middle.outcome};
  constexpr double least = 1e-3;  // over Y; below it contacts so stiff that nothing computes them follow from F0/X
  if (reference.outcome.ok() && !(middle.amplitude > least * model.excitation.amplitude))
    reference.outcome = {
        core::OutcomeKind::not_identifiable,
        "the mass sticks, or hardly moves, in the middle of the range, and severities are relative to its motion there"};
  return reference;
}

Motions MotionMaker::motions(const sim::Model& model, const identify::Sensors& sensors, double growth,
                             double stretch) const {
  Motions result;
  scenarios::Measurement curve{.kind = scenarios::MeasurementKind::steady_states};
  curve.amplitudes = range_.amplitudes;
  for (double& amplitude : curve.amplitudes) amplitude *= stretch;
  curve.frequencies = range_.frequencies_or(rig_.frequency);
  curve.sweeps = range_.sweeps;
  if (range_.sweeps > 1) curve.drift.rate = growth / (range_.sweeps - 1);
  result.stated = rig_.truth.model.excitation.frequency / model.excitation.frequency;
  for (double& frequency : curve.frequencies) frequency /= result.stated;
  result.curve = scenarios::motion_of(model, curve, sensors, options_);
  if (!question_.decay) return result;
  sim::Model released = model;
  released.excitation = {};
  released.initial = {.position = question_.decay->displacement};
  scenarios::Measurement decay{.kind = scenarios::MeasurementKind::free_decay};
  decay.peaks = result.peaks = question_.decay->peaks;
  result.decay = scenarios::motion_of(released, decay, sensors, options_);
  return result;
}

std::optional<scenarios::MotionRecord> MotionMaker::random_response(const sim::Model& model,
                                                                    const identify::Sensors& sensors,
                                                                    std::uint64_t seed) const {
  if (!question_.random) return std::nullopt;
  return random_motion(*question_.random, model, seed, sensors, rig_.truth.model.excitation.frequency);
}

UnmeasuredAmplitudes MotionMaker::unmeasured(const sim::Model& model) const {
  sim::SteadyStateOptions amplitude_alone = options_;
  amplitude_alone.detail = sim::OrbitDetail::extremes;
  // A departure may drive at another frequency than the laboratory sets.
  const double detuning = model.excitation.frequency / rig_.truth.model.excitation.frequency;
  UnmeasuredAmplitudes result{};
  std::ranges::transform(unmeasured_tests(range_, rig_), result.begin(), [&](const UnmeasuredTest& test) {
    sim::Model driven = model;
    driven.excitation.amplitude = test.Y;
    driven.excitation.frequency = test.frequency * detuning;
    const sim::SteadyState state = sim::steady_state(driven, amplitude_alone);
    return state.outcome.ok() && state.amplitude > 0.0 ? state.amplitude : not_stated;
  });
  return result;
}

}  // namespace dualdamp::bench
