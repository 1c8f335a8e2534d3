#include "tests/identify/methods/any_law/law_laboratory.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>

#include "identify/records/derived_records.hpp"
#include "sim/motion/free_decay.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/identify/records.hpp"

namespace dualdamp::identify::testing {

using std::numbers::pi;

namespace {

/// Relative accuracy of the motions; the noise is thirty thousand times larger.
constexpr double accuracy = 1e-7;

double natural_frequency(const identify::departures::Truth& truth) {
  return std::sqrt(truth.model.oscillator.stiffness / truth.model.oscillator.mass);
}

sim::Model model_of(const LawRig& rig, const identify::departures::Truth& truth,
                    const identify::departures::Departure* departure, double severity) {
  sim::Model model = departure == nullptr
                         ? identify::departures::undisturbed(truth)
                         : identify::departures::departed(*departure, truth, rig.reference, severity);
  model.solver.tolerance = accuracy;
  return model;
}

/// Input amplitude that gives the output amplitude x at resonance.
double level_for(const LawRig& rig, double x) {
  return 2.0 * rig.zeta * x + 4.0 / pi * rig.truth.F0 / rig.truth.model.oscillator.stiffness;
}

std::optional<Pair> state_of(const LawRig& rig, const identify::departures::Departure* departure, double severity,
                             double Y, double omega) {
  identify::departures::Truth truth = rig.truth;
  truth.model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = Y, .frequency = omega};
  const sim::SteadyState state =
      sim::steady_state(model_of(rig, truth, departure, severity), {.tolerance = accuracy, .max_periods = 1000});
  if (!state.outcome.ok()) return std::nullopt;
  Pair pair{.Y = Y, .x = state.amplitude};
  pair.omega = omega;
  pair.phase = state.phase;
  return pair;
}

class Readings {
 public:
  Readings(const LawRig& rig, std::uint64_t seed) : normal_(seed ^ 0x9e3779b97f4a7c15U), rig_(rig) {}

  void add(const std::optional<Pair>& state, bool phases) {
    const double x_error = rig_.noise * rig_.reference.amplitude * normal_();
    const double phase_error = rig_.noise * normal_();
    if (!state) {
      complete_ = false;
      return;
    }
    Pair pair = *state;
    pair.x += x_error;
    pair.phase = phases ? pair.phase + phase_error : unknown;
    pair.number = static_cast<int>(record_.pairs.size()) + 1;
    record_.pairs.push_back(pair);
  }

  [[nodiscard]] Record record() const {
    Record record;
    if (complete_) record.pairs = record_;
    return record;
  }

 private:
  Normal normal_;
  const LawRig& rig_;
  PairRecord record_;
  bool complete_ = true;
};

Record response(const LawRig& rig, const identify::departures::Departure* departure, double severity,
                std::uint64_t seed) {
  constexpr int count = 21;
  Readings readings(rig, seed);
  for (int i = 0; i < count; ++i) {
    const double omega = rig.reference.frequency * (1.0 + 2.0 * rig.zeta * (2.0 * i / (count - 1.0) - 1.0));
    readings.add(state_of(rig, departure, severity, 1.15 * rig.reference.Y, omega), true);
  }
  return readings.record();
}

sim::Model released(const LawRig& rig, const identify::departures::Departure* departure, double severity) {
  identify::departures::Truth truth = rig.truth;
  truth.model.initial.position = 2.0 * rig.reference.amplitude;
  return model_of(rig, truth, departure, severity);
}

Record extremes(const LawRig& rig, const identify::departures::Departure* departure, double severity,
                std::uint64_t seed) {
  constexpr int most = 24;
  const sim::FreeDecay decay = sim::free_decay(released(rig, departure, severity), most);
  Record record;
  if (!decay.outcome.ok()) return record;
  Normal normal(seed ^ 0x9e3779b97f4a7c15U);
  record.decay.emplace();
  for (const sim::Extreme& peak : decay.extremes)
    record.decay->extremes.push_back(peak.x + rig.noise * rig.reference.amplitude * normal());
  return record;
}

Record history(const LawRig& rig, const identify::departures::Departure* departure, double severity,
               std::uint64_t seed) {
  const double period = 2.0 * pi / rig.reference.frequency;
  constexpr double periods = 12.0;
  constexpr double samples = 100.0;  // in a period
  const sim::History motion = sim::simulate(released(rig, departure, severity),
                                            {.duration = periods * period, .sample_rate = samples / period});
  Record record;
  if (!motion.outcome.ok()) return record;
  Normal normal(seed ^ 0x9e3779b97f4a7c15U);
  History history;
  history.sample_rate = samples / period;
  for (const sim::Sample& sample : motion.samples)
    history.x.push_back(sample.x + rig.noise * rig.reference.amplitude * normal());
  record.histories.push_back(std::move(history));
  static_cast<void>(complete(record, unknown));
  return record;
}

}  // namespace

std::string_view name_of(LawRecord kind) {
  constexpr std::array<std::string_view, 5> names = {"phases", "amplitudes", "response", "extremes", "history"};
  return names[static_cast<std::size_t>(kind)];
}

LawRig law_rig(LawRecord kind, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  const auto ratio_between = [&](double low, double high) { return low * std::pow(high / low, between(0.0, 1.0)); };
  const bool free = kind == LawRecord::extremes || kind == LawRecord::history;
  LawRig rig;
  sim::Oscillator& oscillator = rig.truth.model.oscillator;
  oscillator.mass = ratio_between(0.3, 10.0);
  const double omega = 2.0 * pi * ratio_between(2.0, 20.0);
  oscillator.stiffness = oscillator.mass * omega * omega;
  rig.zeta = ratio_between(0.02, 0.12) * (free ? 0.25 : 1.0);
  oscillator.damping = 2.0 * rig.zeta * std::sqrt(oscillator.mass * oscillator.stiffness);
  const double X = ratio_between(1e-3, 2e-2);
  // Share of friction in the equivalent damping at the amplitude X.
  const double share = between(0.25, 0.6);
  const double viscous = 2.0 * rig.zeta * oscillator.stiffness * X;
  rig.truth.F0 = 0.25 * pi * viscous * share / (1.0 - share);
  rig.reference = {.amplitude = X, .frequency = omega};
  rig.reference.Y = level_for(rig, X);
  rig.constants = {oscillator.mass, oscillator.stiffness, free ? unknown : natural_frequency(rig.truth)};
  return rig;
}

Record states_record(const LawRig& rig, const identify::departures::Departure* departure, double severity,
                     const std::vector<PlannedState>& states, bool phases, std::uint64_t seed) {
  Readings readings(rig, seed);
  for (const PlannedState& state : states)
    readings.add(state_of(rig, departure, severity, state.Y, state.omega), phases);
  return readings.record();
}

Record law_record(LawRecord kind, const LawRig& rig, const identify::departures::Departure* departure,
                  double severity, std::uint64_t seed) {
  switch (kind) {
    case LawRecord::response:
      return response(rig, departure, severity, seed);
    case LawRecord::extremes:
      return extremes(rig, departure, severity, seed);
    case LawRecord::history:
      return history(rig, departure, severity, seed);
    default: {
      std::vector<PlannedState> levels;
      constexpr int count = 8;
      for (int i = 0; i < count; ++i)
        levels.push_back(
            {level_for(rig, rig.reference.amplitude * (0.5 + i / (count - 1.0))), rig.reference.frequency});
      return states_record(rig, departure, severity, levels, kind == LawRecord::phases, seed);
    }
  }
}

}  // namespace dualdamp::identify::testing
