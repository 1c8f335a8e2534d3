#include "bench/case.hpp"

#include <optional>

#include "bench/motions.hpp"
#include "identify/estimate.hpp"
#include "identify/methods/any_law/any_law.hpp"
#include "scenarios/format/json.hpp"

namespace dualdamp::bench {

namespace {

using identify::Estimate;
using scenarios::Json;

Json interval_json(const std::optional<identify::ParameterIntervals>& intervals,
                   identify::Interval identify::ParameterIntervals::* member) {
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
  json["p_value"] = estimate.lack_of_fit ? scenarios::finite_or_null(estimate.lack_of_fit->p_value) : Json(nullptr);
  // The method's own diagnostics, without the ledger of assumptions.
  json["usable"] = estimate.usable && !(estimate.lack_of_fit && estimate.lack_of_fit->fired);
  return json;
}

Json consequence_json(const Consequence& consequence) {
  return {{"distance", scenarios::finite_or_null(consequence.distance)},
          {"harm", scenarios::finite_or_null(consequence.harm())},
          {"harm_zeta", scenarios::finite_or_null(consequence.harm_zeta)},
          {"harm_F0", scenarios::finite_or_null(consequence.harm_F0)},
          {"attainable_power", scenarios::finite_or_null(consequence.attainable_power)},
          {"cramer_rao_zeta", scenarios::finite_or_null(consequence.cramer_rao_zeta)},
          {"cramer_rao_F0", scenarios::finite_or_null(consequence.cramer_rao_F0)}};
}

/// Why a part of a motion could not be measured; empty if all of it was.
std::string first_warning(const scenarios::MotionRecord& curve,
                          const std::optional<scenarios::MotionRecord>& response) {
  if (!curve.warnings.empty()) return curve.warnings.front();
  return response && !response->warnings.empty() ? response->warnings.front() : "";
}

/// The law that makes a record is taken out of the library of a method that fits a library of laws, so that the
/// method is scored by laws that it does not know.
identify::OptionValues options_for(const identify::MethodEntry& method, const CaseDeparture& departure) {
  if (!method.has(identify::without_option)) return {};
  std::vector<std::string> unknown;
  for (const std::string& name : identify::library_names())
    for (const Departure* one : {departure.first, departure.beside})
      if (one != nullptr && one->name == name) unknown.push_back(name);
  if (unknown.empty()) return {};
  return {{std::string(identify::without_option.name), unknown}};
}

/// The cases of a departure that has no meaning on its rig: without readings, and with the reason.
void take_unmeasured(const Grid& grid, std::size_t number, const std::string& reason,
                     const std::function<bool(std::size_t)>& wanted,
                     const std::function<void(const MeasuredCase&)>& take) {
  const StressTest& question = grid.question();
  const Grid::Motion motion = grid.motion(number);
  const sim::Model& model = question.rigs[motion.rig].truth.model;
  identify::Record nothing;
  nothing.pairs.emplace();
  const Consequence unknown;
  constexpr UnmeasuredAmplitudes unmeasured = {not_stated, not_stated};
  std::size_t place = number * grid.cases_per_motion();
  for (const SensorSet& sensors : question.sensors) {
    Laboratory laboratory{{model.oscillator.mass, model.oscillator.stiffness, model.excitation.frequency},
                          sensors.sensors};
    motion.departure.mislead(laboratory, {}, motion.severity);  // constants do not depend on the motion
    for (int seed = 0; seed < question.seeds; ++seed, ++place)
      if (wanted(place)) take({place, nothing, 0, laboratory.constants, sensors, unknown, unmeasured, reason});
  }
}

}  // namespace

void measure_motion(const Grid& grid, const sim::SteadyStateOptions& options, std::size_t number,
                    const std::function<bool(std::size_t)>& wanted,
                    const std::function<void(const MeasuredCase&)>& take) {
  const StressTest& question = grid.question();
  const Grid::Motion motion = grid.motion(number);
  const TrueRig& rig = question.rigs[motion.rig];
  const MotionMaker maker(question, rig, question.ranges[motion.range], options);
  const sim::Oscillator& oscillator = rig.truth.model.oscillator;
  std::size_t place = number * grid.cases_per_motion();
  DepartedRig departed{motion.departure, motion.severity};
  if (!motion.departure.is_truth()) {
    const Reference reference = maker.reference();
    if (!reference.outcome.ok()) return take_unmeasured(grid, number, reference.outcome.reason, wanted, take);
    departed.reference = reference.motion;
  }
  std::optional<DepartedMotions> unsampled;  // for all sensors without a sample rate
  for (const SensorSet& sensors : question.sensors) {
    Laboratory laboratory{{oscillator.mass, oscillator.stiffness, rig.truth.model.excitation.frequency},
                          sensors.sensors};
    motion.departure.mislead(laboratory, departed.reference, motion.severity);
    std::optional<DepartedMotions> sampled;
    std::optional<DepartedMotions>& motions = sensors.sensors.sample_rate > 0.0 ? sampled : unsampled;
    std::optional<Consequence> consequence;
    std::optional<scenarios::MotionRecord> response;
    for (int seed = 0; seed < question.seeds; ++seed, ++place) {
      if (!wanted(place)) continue;
      if (!consequence) {
        if (!motions) motions = departed_motions(maker, departed, rig.truth, laboratory);
        consequence = consequence_of(maker, departed, rig, *motions, laboratory, sensors.sensors);
        response = maker.random_response(motion.departure.model(rig.truth, departed.reference, motion.severity),
                                         laboratory.sensors, grid.drive_seed(number));
      }
      std::vector<std::string> warnings;
      identify::Record record = motions->here.reading(laboratory.sensors, grid.seed(place), warnings);
      if (response) add_reading(*response, laboratory.sensors, grid.seed(place), record);
      const std::size_t responses = response ? response->exact.histories.size() : 0;
      const std::string reason = first_warning(motions->here.curve, response);
      take({place, record, responses, laboratory.constants, sensors, *consequence, motions->unmeasured, reason});
    }
  }
}

void run_motion(const Grid& grid, const sim::SteadyStateOptions& options, std::size_t number,
                const std::function<bool(std::size_t)>& wanted, const TakeLine& take) {
  const Grid::Motion motion = grid.motion(number);
  measure_motion(grid, options, number, wanted, [&](const MeasuredCase& measured) {
    Json line = {{"case", measured.number},
                 {"law", motion.departure.name()},
                 {"severity", motion.severity},
                 {"rig", motion.rig},
                 {"range", grid.question().ranges[motion.range].name},
                 {"sensors", measured.sensors.name},
                 {"seed", grid.at(measured.number).seed}};
    line.update(consequence_json(measured.consequence));
    line["unmeasured"] = {scenarios::finite_or_null(measured.unmeasured[0]),
                          scenarios::finite_or_null(measured.unmeasured[1])};
    if (!measured.reason.empty()) line["reason"] = measured.reason;
    line["estimates"] = Json::array();
    for (const identify::MethodEntry* method : grid.question().methods)
      line["estimates"].push_back(
          estimate_json(method->run(measured.record, measured.constants, options_for(*method, motion.departure))));
    take(line.dump());
  });
}

}  // namespace dualdamp::bench
