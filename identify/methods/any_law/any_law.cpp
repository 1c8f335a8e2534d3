#include "identify/methods/any_law/any_law.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <variant>

#include "core/numbers.hpp"
#include "identify/methods/any_law/decay_readings.hpp"
#include "identify/methods/any_law/law_intervals.hpp"
#include "identify/methods/any_law/steady_readings.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

namespace {

using Readings = std::variant<std::unique_ptr<const ReadingModel>, std::string>;

Readings readings_of(const Record& record, const KnownConstants& constants, const AnyLawOptions& options) {
  if (record.pairs && !record.pairs->pairs.empty()) return steady_readings(record, constants, options);
  return decay_readings(record, constants, options.sigma_x);
}

std::string lacks_readings(const Record& record) {
  if (record.pairs && !record.pairs->pairs.empty()) return {};
  return record.decay ? std::string() : "the record holds neither steady states nor extremes of a free vibration";
}

/// Both ends and the value between them.
void place(double& value, std::array<double, 2>& into, const Interval& hull, double scale) {
  into = {hull[0] * scale, hull[1] * scale};
  value = std::clamp(value, into[0], into[1]);
}

void take(const LawIntervals& laws, const KnownConstants& constants, Estimate& estimate) {
  const double critical = 2.0 * std::sqrt(constants.mass * constants.stiffness);
  estimate.value = laws.mean;
  estimate.std = laws.std;
  estimate.interval95.emplace();
  place(estimate.value.zeta, estimate.interval95->zeta, laws.zeta_hull, 1.0);
  place(estimate.value.c, estimate.interval95->c, laws.zeta_hull, critical);
  place(estimate.value.F0, estimate.interval95->F0, laws.F0_hull, 1.0);
  place(estimate.value.x_f, estimate.interval95->x_f, laws.F0_hull, 1.0 / constants.stiffness);
}

void tell(const LawIntervals& laws, Estimate& estimate) {
  constexpr int digits = 3;
  if (laws.inflation > 1.0)
    estimate.warnings.push_back("no law of the library fits: the noise was raised by a factor of " +
                                core::format_number(laws.inflation, digits) + " until the best one did");
  for (const std::string& name : laws.unsolved)
    estimate.warnings.push_back("no steady states were found under '" + name + "', which is left out");
  const auto bounded = std::ranges::count_if(laws.laws, [](const LawAnswer& law) {
    constexpr double near = 0.99;
    return !law.rejected && law.largest > 0.0 && std::abs(law.severity) > near * law.largest;
  });
  if (bounded > 0)
    estimate.warnings.push_back(std::to_string(bounded) + (bounded == 1 ? " law fits" : " laws fit") +
                                " best at the largest severity: raise 'largest_severity' to see what lies beyond");
}

}  // namespace

LawIntervalOptions interval_options(const AnyLawOptions& options) {
  return {.largest_severity = options.largest_severity,
          .severity_deviation = options.severity_deviation,
          .law_error = options.law_error,
          .without = options.without};
}

Estimate any_law(const Record& record, const KnownConstants& constants, const AnyLawOptions& options) {
  Estimate estimate;
  estimate.method = any_law_method.name;
  std::string fault = lacks_readings(record);
  if (fault.empty()) fault = fault_of(constants);
  if (!fault.empty()) {
    refuse(estimate, std::move(fault));
    return estimate;
  }
  const Readings readings = readings_of(record, constants, options);
  if (const auto* why = std::get_if<std::string>(&readings)) {
    refuse(estimate, *why);
    return estimate;
  }
  const ReadingModel& model = *std::get<std::unique_ptr<const ReadingModel>>(readings);
  std::variant<LawStudy, std::string> found = study_laws(model, constants, interval_options(options));
  if (const auto* why = std::get_if<std::string>(&found)) {
    refuse(estimate, *why);
    return estimate;
  }
  const auto laws = std::make_shared<const LawIntervals>(std::get<LawStudy>(std::move(found)).intervals);
  estimate.laws = laws;
  estimate.used = model.numbers();
  take(*laws, constants, estimate);
  tell(*laws, estimate);
  const auto allowed = std::ranges::count_if(laws->laws, [](const LawAnswer& law) { return !law.rejected; });
  conclude(estimate, {},
           "rests on " + laws->data + ", which allow " + std::to_string(allowed) + " of " +
               std::to_string(laws->laws.size()) + " laws");
  return estimate;
}

void add_uncertainty_of(const Estimate& stated, const Estimate& uncertain, Estimate& estimate) {
  if (!stated.interval95 || !uncertain.interval95 || !estimate.interval95) return;
  std::shared_ptr<LawIntervals> laws = estimate.laws ? std::make_shared<LawIntervals>(*estimate.laws) : nullptr;
  const auto half = [](const Interval& ends) { return 0.5 * (ends[1] - ends[0]); };
  const auto widen = [](Interval& ends, double about, double extra) {
    const double value = std::clamp(about, ends[0], ends[1]);
    ends = {value - std::hypot(value - ends[0], extra), value + std::hypot(ends[1] - value, extra)};
  };
  struct Row {
    double ParameterSet::* value;
    Interval ParameterIntervals::* interval;
    Interval LawIntervals::* hull;
    Interval LawIntervals::* average;
  };
  using Laws = LawIntervals;
  for (const Row& row : {Row{&ParameterSet::zeta, &ParameterIntervals::zeta, &Laws::zeta_hull, &Laws::zeta_average},
                         Row{&ParameterSet::c, &ParameterIntervals::c, nullptr, nullptr},
                         Row{&ParameterSet::x_f, &ParameterIntervals::x_f, nullptr, nullptr},
                         Row{&ParameterSet::F0, &ParameterIntervals::F0, &Laws::F0_hull, &Laws::F0_average}}) {
    const double with = half((*uncertain.interval95).*row.interval);
    const double without = half((*stated.interval95).*row.interval);
    const double extra = std::sqrt(std::max(with * with - without * without, 0.0));
    widen((*estimate.interval95).*row.interval, estimate.value.*row.value, extra);
    if (!laws || row.hull == nullptr) continue;
    widen((*laws).*row.hull, estimate.value.*row.value, extra);
    widen((*laws).*row.average, laws->mean.*row.value, extra);
  }
  estimate.laws = std::move(laws);
}

using enum Assumption;
constinit const MethodEntry any_law_method{
    "any_law",
    "ranges of zeta and F0 over all friction laws that the record allows",
    "one law of the library up to a largest severity; sensors and drive as stated; checked: each law by its misfit",
    "hull and average over laws of the profile likelihood over severity, readings by the engines in time",
    "brynjarsdottir2014, pasquier2015, birge1932",
    RecordKind::states,
    lacks_readings,
    call_of<any_law>,
    AssumptionSet::all_but(constants, spring, friction_velocity, friction_displacement),
    true};

}  // namespace dualdamp::identify
