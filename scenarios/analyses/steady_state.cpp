#include "scenarios/analyses/steady_state.hpp"

#include <algorithm>
#include <cmath>

#include "scenarios/analyses/shared/motion_chart.hpp"
#include "scenarios/results/motion.hpp"
#include "sim/engine/engine.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/steady_state.hpp"
#include "sim/orbits/transient.hpp"

namespace dualdamp::scenarios {

namespace {

ResultFields steady_state_fields() {
  return joined({{"peak", "m", "max x"},
                 {"trough", "m", "min x"},
                 {"amplitude", "m", "(peak - trough)/2"},
                 {"phase", "rad", "lag of x's fundamental behind the excitation, in [0, 2 pi); null: one has none"},
                 {"phase_reason", "", "if there is no phase: the reason"},
                 {"period", "s", "period of the motion"},
                 {"period_ratio", "1", "forcing periods in one period of the motion; above 1: subharmonic"},
                 {"max_speed", "m/s", "max |v|"},
                 {"stops_per_cycle", "1", "stops in a period"},
                 {"sticks[].start", "s", "start of a stick, modulo one period"},
                 {"sticks[].duration", "s", "its duration"},
                 {"sticks[].position", "m", "its position"},
                 {"multipliers[][]", "1", "Floquet multipliers over one period, [re, im]"},
                 {"stable", "", "no Floquet multiplier lies outside the unit circle"},
                 {"others[].peak", "m", "max x of another steady state, if one is known"},
                 {"others[].trough", "m", "its min x"},
                 {"others[].period_ratio", "1", "forcing periods in its period"}},
                joined(energy_fields(), certificate_fields()));
}

std::unique_ptr<const Question> ask_steady_state(CheckedValues&& /*values*/) {
  return std::make_unique<SteadyStateQuestion>();
}

/// Samples of a period, for plots: equally many in each forcing period, so that orbits that begin with different
/// forcing periods can be compared.
int orbit_samples(int periods) {
  constexpr int least = 720;
  constexpr int least_of_each = 24;
  return periods * std::max(least_of_each, (least + periods - 1) / periods);
}

}  // namespace

Answer SteadyStateQuestion::run(const RunContext& context) const {
  const sim::Model& model = context.model;
  const sim::SteadyState state = sim::steady_state(model, context.steady_states());
  if (!state.outcome.ok()) return failed(state.outcome.reason);
  Answer answer;
  answer.warnings = state.warnings;
  answer.orbit = std::make_shared<const sim::State>(state.start);
  Json& result = answer.result;
  result["peak"] = state.peak;
  result["trough"] = state.trough;
  result["amplitude"] = state.amplitude;
  result["phase"] = finite_or_null(state.phase);
  if (std::isnan(state.phase)) result["phase_reason"] = why_no_phase(model, state.never_moves());
  result["period"] = state.period;
  result["period_ratio"] = state.period_ratio;
  result["max_speed"] = state.max_speed;
  result["stops_per_cycle"] = state.stops_per_cycle;
  result["sticks"] = Json::array();
  for (const sim::Stick& stick : state.sticks)
    result["sticks"].push_back(
        {{"start", stick.start}, {"duration", stick.duration}, {"position", stick.position}});
  result["multipliers"] = Json::array();
  for (const std::complex<double>& multiplier : state.multipliers)
    result["multipliers"].push_back({multiplier.real(), multiplier.imag()});
  result["stable"] = state.stable();
  result["others"] = Json::array();
  for (const sim::OtherState& other : state.others)
    result["others"].push_back(
        {{"peak", other.peak}, {"trough", other.trough}, {"period_ratio", other.period_ratio}});
  result["energy"] = energy_json(state.energy);
  add_certificate(result, model, state.certificate);
  if (!state.sticks.empty())
    answer.tables.push_back({.name = "sticks",
                             .columns = {column("start", "s", state.sticks, &sim::Stick::start),
                                         column("duration", "s", state.sticks, &sim::Stick::duration),
                                         column("position", "m", state.sticks, &sim::Stick::position)},
                             .is_complete = true});
  answer.tables.push_back(
      history_table("orbit", sim::one_period(model, state, orbit_samples(state.period_ratio)), model.excitation));
  return answer;
}

std::optional<OtherWay> SteadyStateQuestion::other_way(const RunContext& context, const Answer& answer) const {
  constexpr int most_exact = 2000;
  constexpr int most_smooth = 300;  // each of them costs a thousand times as much
  const int most = sim::is_exact(context.model) ? most_exact : most_smooth;
  const int ratio = answer.result.at("period_ratio").get<int>();
  const sim::Transient transient =
      sim::follow_transient(context.model, {.max_periods = most, .period_ratio = ratio});
  OtherWay other{"the transient over " + std::to_string(transient.periods) + " periods", {}};
  if (!transient.outcome.ok()) {
    other.answer = failed(transient.outcome.reason);
  } else if (!transient.settled) {
    other.answer = failed("it has not settled");
  } else {
    other.answer.result = {
        {"peak", transient.peak}, {"trough", transient.trough}, {"stops_per_cycle", transient.stops}};
  }
  return other;
}

const Analysis& steady_state_analysis() {
  static const Analysis analysis = {.name = "steady_state",
                                    .summary = "the periodic motion approached from the initial state",
                                    .keys = {},
                                    .needs = needs_of_steady_states({"amplitude", "frequency"}),
                                    .results = steady_state_fields(),
                                    .main = {"amplitude", "phase", "max_speed"},
                                    .chart = motion_chart("orbit"),
                                    .steady_vibrations = true,
                                    .verifiable = true,
                                    .ask = ask_steady_state};
  return analysis;
}

}  // namespace dualdamp::scenarios
