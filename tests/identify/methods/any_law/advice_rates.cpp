#include "tests/identify/methods/any_law/advice_rates.hpp"

#include <algorithm>
#include <utility>
#include <variant>
#include <vector>

#include "identify/design/design.hpp"
#include "identify/methods/any_law/law_intervals.hpp"
#include "identify/methods/any_law/steady_readings.hpp"

namespace dualdamp::identify::testing {

namespace {

std::optional<LawIntervals> answer_of(const LawRig& rig, const Record& record, const LawIntervalOptions& options) {
  const auto readings = steady_readings(record, rig.constants, {});
  const auto* model = std::get_if<0>(&readings);
  if (model == nullptr) return std::nullopt;
  auto study = study_laws(**model, rig.constants, options);
  if (auto* found = std::get_if<LawStudy>(&study)) return std::move(found->intervals);
  return std::nullopt;
}

/// Both records as one.
Record together(const Record& first, const Record& second) {
  Record all = first;
  for (Pair pair : second.pairs->pairs) {
    pair.number = static_cast<int>(all.pairs->pairs.size()) + 1;
    all.pairs->pairs.push_back(pair);
  }
  return all;
}

/// The record with what the candidate gave: with the phases alone, or with all states.
Record continued(Record first, const Record& advised, const CandidateMeasurement& candidate) {
  if (!candidate.only_phases) return together(first, advised);
  for (std::size_t i = 0; i < first.pairs->pairs.size(); ++i)
    first.pairs->pairs[i].phase = advised.pairs->pairs[i].phase;
  return first;
}

bool rejects_plain(const LawIntervals& laws) {
  return std::ranges::find(laws.laws, "coulomb_viscous", &LawAnswer::name)->rejected;
}

}  // namespace

std::optional<Followed> followed_advice(const LawRig& rig, const identify::departures::Departure& departure,
                                        double severity, std::uint64_t seed, const LawIntervalOptions& options,
                                        LawRecord kind) {
  const Record first = law_record(kind, rig, &departure, severity, seed);
  if (!first.pairs) return std::nullopt;
  const auto found = design_after(first, rig.constants, {}, options);
  const auto* design = std::get_if<Design>(&found);
  if (design == nullptr) return std::nullopt;
  // A release cannot be read together with states.
  const auto best = std::ranges::find_if(design->advice, [](const MeasurementAdvice& advice) {
    return std::holds_alternative<std::vector<PlannedState>>(advice.candidate.plan);
  });
  if (best == design->advice.end()) return std::nullopt;
  const auto& states = std::get<std::vector<PlannedState>>(best->candidate.plan);
  Record advised = states_record(rig, &departure, severity, states, best->candidate.phases, seed + 1);
  const Record equal = law_record(kind, rig, &departure, severity, seed + 1);
  if (!advised.pairs || !equal.pairs) return std::nullopt;
  const auto after_advice = answer_of(rig, continued(first, advised, best->candidate), options);
  const auto after_equal = answer_of(rig, together(first, equal), options);
  if (!after_advice || !after_equal) return std::nullopt;
  const LawIntervals& now = design->now;
  const auto own = std::ranges::find(best->outcomes, departure.name, &LawOutcome::law);
  const Shrinkage promised = own == best->outcomes.end() ? best->hull : own->hull;
  return Followed{.advice = best->candidate.name,
                  .expected = {best->hull.zeta, best->hull.F0},
                  .promised = {promised.zeta, promised.F0},
                  .found = {width(after_advice->zeta_hull) / width(now.zeta_hull),
                            width(after_advice->F0_hull) / width(now.F0_hull)},
                  .narrower = {width(after_equal->zeta_hull) / width(after_advice->zeta_hull),
                               width(after_equal->F0_hull) / width(after_advice->F0_hull)},
                  .rejected = {rejects_plain(*after_equal), rejects_plain(*after_advice)},
                  .held = {holds(after_advice->zeta_hull, rig.zeta), holds(after_advice->F0_hull, rig.truth.F0)}};
}

}  // namespace dualdamp::identify::testing
