#include "identify/methods/any_law/any_law.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>
#include <variant>

#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/methods/any_law/decay_readings.hpp"
#include "identify/methods/any_law/law_intervals.hpp"
#include "identify/methods/any_law/steady_readings.hpp"
#include "identify/models/force_parameters.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

namespace {

using Readings = std::variant<std::unique_ptr<const ReadingModel>, std::string>;

std::string lacks_readings(const Record& record) {
  if (record.pairs && !record.pairs->pairs.empty()) return {};
  return record.decay ? std::string() : "the record holds neither steady states nor extremes of a free vibration";
}

Readings readings_of(const Record& record, const KnownConstants& constants, const AnyLawOptions& options) {
  std::string fault = lacks_readings(record);
  if (fault.empty()) fault = lacks_constants(constants);
  if (!fault.empty()) return fault;
  if (record.pairs && !record.pairs->pairs.empty()) return steady_readings(record, constants, options);
  return decay_readings(record, constants, options.sigma_x);
}

/// Sets both ends of an interval, and moves the value between them.
void place(double& value, Interval& into, const Interval& hull, double scale) {
  into = {hull[0] * scale, hull[1] * scale};
  value = std::clamp(value, into[0], into[1]);
}

void take(const LawIntervals& laws, const KnownConstants& constants, Estimate& estimate) {
  estimate.value = laws.mean;
  estimate.std = laws.std;
  estimate.interval95.emplace();
  place(estimate.value.zeta, estimate.interval95->zeta, laws.zeta_hull, 1.0);
  place(estimate.value.c, estimate.interval95->c, laws.zeta_hull, constants.critical_damping());
  place(estimate.value.F0, estimate.interval95->F0, laws.F0_hull, 1.0);
  place(estimate.value.x_f, estimate.interval95->x_f, laws.F0_hull, 1.0 / constants.stiffness);
}

/// Plain friction with the stated constants. The fit with a constant moved a little begins here: a new search might
/// end in another minimum, which differs by more than the effect of the constant. Both fits have the same weights:
/// otherwise the effect of the constants would be lost in that of the weights.
struct StatedFit {
  ChannelNoise noise;
  Eigen::VectorXd unknowns;
  double F0_unit = 1.0;
  double c_unit = 1.0;
};

std::optional<StatedFit> stated_fit(const ReadingModel& model, const AnyLawOptions& options) {
  std::optional<PlainFit> plain = plain_fit(model);
  if (plain) plain = with_law_error(model, std::move(*plain), options.law_error);
  if (!plain) return std::nullopt;
  return StatedFit{plain->noise, plain->fit.unknowns, model.F0_unit(), model.c_unit()};
}

/// The best fit next to `stated` of readings with a moved constant.
std::optional<SeverityFit> fit_beside(const StatedFit& stated, const ReadingModel& model) {
  LawStart start{.unknowns = stated.unknowns};
  start.unknowns[0] *= stated.F0_unit / model.F0_unit();
  start.unknowns[1] *= stated.c_unit / model.c_unit();
  const std::unique_ptr<NearbyOrbits> near = model.no_orbits(stated.noise.deviations);
  std::optional<SeverityFit> fit;
  // A fit ends within a tenth of a standard deviation; another one from there is practically exact.
  constexpr int rounds = 3;
  for (int i = 0; i < rounds; ++i) {
    fit = fit_law(model, {}, stated.noise, start, *near);
    if (!fit) break;
    start.unknowns = fit->unknowns;
  }
  return fit;
}

/// The readings that any_law compares. If the record has none: nothing, and the estimate is refused.
std::unique_ptr<const ReadingModel> readings_for(Estimate& estimate, const Record& record,
                                                 const KnownConstants& constants, const AnyLawOptions& options) {
  Readings readings = readings_of(record, constants, options);
  if (const auto* why = std::get_if<std::string>(&readings)) {
    refuse(estimate, *why);
    return nullptr;
  }
  return std::get<std::unique_ptr<const ReadingModel>>(std::move(readings));
}

/// Plain friction fitted to the readings of any_law, with standard errors of zero: only those of the constants are
/// added later. The first call, with the stated constants, sets `stated`.
Estimate plain_estimate(const Record& record, const KnownConstants& constants, const AnyLawOptions& options,
                        std::optional<StatedFit>& stated) {
  Estimate estimate;
  estimate.method = any_law_method.name;
  const std::unique_ptr<const ReadingModel> readings = readings_for(estimate, record, constants, options);
  if (!readings) return estimate;
  const ReadingModel& model = *readings;
  if (!stated) stated = stated_fit(model, options);
  const std::optional<SeverityFit> fit = stated ? fit_beside(*stated, model) : std::nullopt;
  if (!fit) {
    refuse(estimate, "no Coulomb and viscous friction has readings like these");
    return estimate;
  }
  estimate.value = parameters(
      {constants.mass, fit->unknowns[1] * model.c_unit(), constants.stiffness, fit->unknowns[0] * model.F0_unit()});
  estimate.std.emplace();
  return estimate;
}

/// The largest relative uncertainty.
double largest_of(const ConstantUncertainties& u, const KnownConstants& constants) {
  double largest = 0.0;
  for (const StatedNumber& number : stated_numbers) largest = std::max(largest, number.relative(u, constants));
  return largest;
}

/// Forces and dampings are not negative.
void widen(Interval& ends, double about, double by) {
  ends = widened(ends, about, by);
  ends[0] = std::max(ends[0], 0.0);
}

}  // namespace

LawIntervalOptions interval_options(const AnyLawOptions& options) {
  const bool stated = !std::isnan(options.largest_severity);
  return {.largest_severity = stated ? options.largest_severity : LawIntervalOptions{}.largest_severity,
          .further = !stated,
          .severity_deviation = options.severity_deviation,
          .law_error = options.law_error,
          .without = options.without};
}

std::vector<std::string> warnings_about(const LawIntervals& laws, const AnyLawOptions& options) {
  std::vector<std::string> warnings;
  const bool stated = !std::isnan(options.largest_severity);
  constexpr int digits = 3;
  if (laws.inflation > 1.0)
    warnings.push_back("no law of the library fits: the noise was raised by a factor of " +
                       core::format_number(laws.inflation, digits) + " until the best one did");
  for (const std::string& name : laws.unsolved)
    warnings.push_back("no steady states were found under '" + name + "', which is left out");
  std::vector<std::string> bounded;
  for (const LawAnswer& law : laws.laws) {
    constexpr double near = 0.99;
    // A law that is rejected at the user's bound might be allowed beyond it.
    if ((stated || !law.rejected) && law.severity != 0.0 && std::abs(law.severity) > near * std::abs(law.largest))
      bounded.push_back(law.name);
  }
  if (!bounded.empty())
    warnings.push_back("the range may be wider: these laws fit best at the largest severity that was tried: " +
                       core::joined(bounded) +
                       (stated ? "; without 'largest_severity' they are followed on where they can be" : ""));
  return warnings;
}

Estimate any_law(const Record& record, const KnownConstants& constants, const AnyLawOptions& options) {
  Estimate estimate;
  estimate.method = any_law_method.name;
  const std::unique_ptr<const ReadingModel> readings = readings_for(estimate, record, constants, options);
  if (!readings) return estimate;
  const ReadingModel& model = *readings;
  std::variant<LawStudy, std::string> found = study_laws(model, constants, interval_options(options));
  if (const auto* why = std::get_if<std::string>(&found)) {
    refuse(estimate, *why);
    return estimate;
  }
  const auto laws = std::make_shared<const LawIntervals>(std::get<LawStudy>(std::move(found)).intervals);
  estimate.laws = laws;
  estimate.used = model.numbers();
  take(*laws, constants, estimate);
  std::ranges::move(warnings_about(*laws, options), std::back_inserter(estimate.warnings));
  const auto allowed = std::ranges::count_if(laws->laws, [](const LawAnswer& law) { return !law.rejected; });
  conclude(estimate, {},
           "rests on " + laws->data + ", which allow " + std::to_string(allowed) + " of " +
               std::to_string(laws->laws.size()) + " laws");
  return estimate;
}

Estimate moved_by_constants(const Record& record, const KnownConstants& constants,
                            const ConstantUncertainties& uncertainties, const AnyLawOptions& options) {
  // A spring or a mass that is far off has no motion like the record's: a small step is made and scaled.
  constexpr double small = 2e-3;
  const double times = std::max(largest_of(uncertainties, constants) / small, 1.0);
  ConstantUncertainties step = uncertainties;
  for (const StatedNumber& number : stated_numbers) step.*number.uncertainty /= times;
  std::optional<StatedFit> stated;
  const Reader read = [&options, &stated](const Record& again, const KnownConstants& moved) {
    return plain_estimate(again, moved, options, stated);
  };
  Estimate estimate = with_uncertainties(read, record, constants, step);
  if (!estimate.outcome.ok())
    estimate.warnings.push_back("the uncertainties of the constants are not in the ranges over laws: " +
                                estimate.outcome.reason);
  if (estimate.std)
    for (const ReportedParameter& parameter : reported_parameters) (*estimate.std).*parameter.value *= times;
  return estimate;
}

void widen(const ParameterSet& by, LawIntervals& laws) {
  widen(laws.zeta_hull, laws.mean.zeta, by.zeta);
  widen(laws.F0_hull, laws.mean.F0, by.F0);
  widen(laws.zeta_average, laws.mean.zeta, by.zeta);
  widen(laws.F0_average, laws.mean.F0, by.F0);
}

void widen(const ParameterSet& by, Estimate& estimate) {
  if (!estimate.interval95 || !estimate.laws) return;
  for (const auto& [name, unit, value, interval] : reported_parameters)
    widen((*estimate.interval95).*interval, estimate.value.*value, by.*value);
  auto laws = std::make_shared<LawIntervals>(*estimate.laws);
  widen(by, *laws);
  estimate.laws = std::move(laws);
}

using enum Assumption;
constinit const MethodEntry any_law_method{
    .name = "any_law",
    .summary = "ranges of zeta and F0 over all friction laws that the record allows",
    .assumes =
        "one law of the library up to a largest severity; sensors and drive as stated; checked: each law by its misfit",
    .equation =
        "hull and average over laws of the profile likelihood over severity, readings by the engines in time",
    .sources = "brynjarsdottir2014, pasquier2015, birge1932",
    .needs = RecordKind::readings,
    .lacks = lacks_readings,
    .call = call_of<any_law>,
    .rests_on = AssumptionSet::all_but(constants, spring, friction_velocity, friction_displacement),
    .takes_seconds = true,
};

}  // namespace dualdamp::identify
