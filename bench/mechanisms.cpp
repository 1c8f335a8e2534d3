#include "bench/mechanisms.hpp"

#include <algorithm>
#include <iterator>

#include "bench/mechanisms/study.hpp"
#include "bench/truth.hpp"
#include "core/numbers.hpp"
#include "scenarios/format/common_keys.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/results/motion.hpp"

namespace dualdamp::bench {

namespace {

using scenarios::Analysis;
using scenarios::Answer;
using scenarios::CheckedFile;
using scenarios::CheckedValues;
using scenarios::Choice;
using scenarios::Field;
using scenarios::Json;
using scenarios::Question;
using scenarios::ResultFields;
using scenarios::RunContext;
using scenarios::Section;

class MechanismsQuestion final : public Question {
 public:
  explicit MechanismsQuestion(MechanismStudy study) : study_(std::move(study)) {}

  [[nodiscard]] Answer run(const RunContext& context) const override {
    return run_mechanism_study(study_, context.model);
  }

 private:
  MechanismStudy study_;
};

std::vector<std::string> mechanism_names() {
  std::vector<std::string> names;
  for (const Departure& mechanism : mechanisms()) names.emplace_back(mechanism.name);
  return names;
}

/// Values of each mechanism's own parameters.
Field plausible_values() {
  using namespace scenarios;
  Choice rigs{"mechanism", {}};
  for (const Departure& mechanism : mechanisms()) {
    std::vector<Field> fields = {text("case", "name of these values in the results").with_fallback(""),
                                 text("because", "where they come from").with_fallback("")};
    for (const DepartureParameter& parameter : mechanism.parameters) {
      Field field =
          quantity(std::string(parameter.name), {std::string(parameter.unit)}, std::string(parameter.meaning))
              .required();
      field.range = parameter.range;
      fields.push_back(std::move(field));
    }
    rigs.variants.push_back({std::string(mechanism.name), std::string(mechanism.meaning), {std::move(fields)}});
  }
  Field field = choice("plausible", std::move(rigs),
                       "plausible values of the mechanisms' parameters; they replace the default values of a "
                       "mechanism");
  field.listed = field.only_listed = true;
  return std::move(field).items(1, max_sets);
}

Section mechanisms_keys() {
  using namespace scenarios;
  const auto error = [](const char* name, const char* unit, const char* what) {
    return quantity(name, {unit}, std::string("standard error of this ") + what + ", rounding included")
        .required()
        .above(0);
  };
  const Section estimate = {{quantity("share", {"1"}, "lower part of the data").required().above(0).at_most(1),
                             quantity("zeta", {"1"}, "damping ratio that it gave").required().above(0),
                             quantity("F0", {"N"}, "friction force that it gave").required().above(0),
                             error("zeta_std", "1", "damping ratio"), error("F0_std", "N", "friction force")}};
  const auto segment = [](const char* name, const char* which) {
    return section(name,
                   {{quantity("zeta", {"1"}, "damping ratio").required().above(0),
                     quantity("x_f", {"m"}, "friction displacement").required().above(0)}},
                   std::string("what the ") + which + " four of five extremes gave")
        .required();
  };
  const Section decay = {
      {quantity("stiffness", {"N/m"}, "of the spring in this test").required().above(0),
       quantity("displacement", {"m"}, "initial displacement of a release from rest").required().above(0),
       segment("high", "first"), segment("low", "last")}};
  return {
      {section_list("estimates", estimate,
                    "estimates from straight lines through the data and through their lower parts")
           .required()
           .items(2, max_sets),
       integer("levels", "number of input levels, equally spaced at unknown values").at_least(4).at_most(max_sets),
       optional(grid("amplitudes", {"m"}, "input levels, where they are known").above(0).items(3, max_sets)),
       word_list("mechanisms", mechanism_names(), "mechanisms that are tried; default: all"), plausible_values(),
       section("decay", decay, "a free decay of the same mass and friction, to compare")},
      {{{"levels", "amplitudes"}, true}}};
}

/// Estimates, levels and decay under `prefix`.
ResultFields reading_fields(const std::string& prefix, const std::string& of) {
  return {{prefix + "bend", "1", "zeta of the smallest part over that of the largest, less 1" + of},
          {prefix + "estimates[].share", "1", "part of the data"},
          {prefix + "estimates[].zeta", "1", "damping ratio by the line through this part" + of},
          {prefix + "estimates[].F0", "N", "friction force by that line" + of}};
}

ResultFields levels_and_decay(const std::string& prefix) {
  return {{prefix + "levels[].Y", "m", "input level"},
          {prefix + "levels[].x", "m", "output amplitude"},
          {prefix + "decay.high.zeta", "1", "damping ratio from the first four extremes of the free decay"},
          {prefix + "decay.high.x_f", "m", "friction displacement from them"},
          {prefix + "decay.low.zeta", "1", "damping ratio from the last four"},
          {prefix + "decay.low.x_f", "m", "friction displacement from them"},
          {prefix + "decay.bend", "1", "decay.high.zeta over decay.low.zeta, less 1"}};
}

ResultFields mechanisms_fields() {
  const std::string fit = "mechanisms[].";
  ResultFields fields = joined({{"verdict", "", "conclusions of the study and their limits"}},
                               reading_fields("explained.", " (measured)"));
  fields =
      joined(joined(fields, levels_and_decay("explained.")),
             {{fit + "mechanism", "", "name, closest first"},
              {fit + "meaning", "", "what happens in the rig"},
              {fit + "unknowns", "1", "unknowns of the fit"},
              {fit + "reason", "", "without a fit: the reason"},
              {fit + "chi2", "1", "sum of squares of the misfits over their standard errors"},
              {fit + "misfit", "1", "largest relative misfit of all numbers"},
              {fit + "stretch", "1", "largest ratio between a parameter and its plausible value, either way"},
              {fit + "F0", "N", "Coulomb friction of the fit"},
              {fit + "c", "N.s/m", "viscous damping of the fit"},
              {fit + "parameters[].name", "", "a parameter of the mechanism"},
              {fit + "parameters[].unit", "", "its unit"},
              {fit + "parameters[].value", "", "its value"},
              {fit + "parameters[].at_bound", "", "the search ended at a bound"},
              {fit + "aliases[]", "", "mechanisms that differ from this one by less than the standard errors"}});
  fields = joined(joined(fields, reading_fields(fit, " (of the fit)")), levels_and_decay(fit));
  const std::string effect = "effects[].";
  return joined(joined(fields, {{effect + "mechanism", "", "a mechanism at plausible values"},
                                {effect + "case", "", "name of the values, if there are several"},
                                {effect + "because", "", "where the values come from"},
                                {effect + "parameters[].name", "", "a parameter"},
                                {effect + "parameters[].unit", "", "its unit"},
                                {effect + "parameters[].value", "", "its value"},
                                {effect + "sticks", "", "the mass sticks at one of the levels"},
                                {effect + "reason", "", "without estimates: the reason"}}),
                reading_fields(effect, ""));
}

/// Checks that the parts differ and have at least two levels each.
void check_shares(CheckedFile& file, std::size_t levels) {
  std::vector<std::size_t> parts;
  const Json& estimates = file.values().at("analysis").at("estimates");
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    if (!estimates.at(i).contains("share")) continue;
    const std::size_t part = part_of(levels, scenarios::number(estimates.at(i).at("share")));
    const std::string path = "analysis.estimates[" + std::to_string(i) + "].share";
    if (part < 2) {
      const double least = 2.0 / static_cast<double>(levels);
      file.complain(path, "a line needs two levels", "at least " + core::format_number(least, 3));
    } else if (std::ranges::find(parts, part) != parts.end()) {
      file.complain(path, "there are two estimates from " + std::to_string(part) + " levels", "distinct parts");
    }
    parts.push_back(part);
  }
}

void check_parts(CheckedFile& file) {
  const Json& analysis = file.values().at("analysis");
  const bool known = analysis.contains("amplitudes");
  if (!known && !analysis.contains("levels")) return;
  const std::size_t levels =
      known ? scenarios::grid_size(analysis.at("amplitudes")) : analysis.at("levels").get<std::size_t>();
  check_shares(file, levels);
  const std::size_t sought = levels + (known ? 0 : 2);
  const std::size_t count = analysis.at("estimates").size();
  if (2 * count < sought)
    file.complain("analysis.estimates", "the estimates are too few to tell the levels behind them",
                  "zeta and F0 of " + std::to_string((sought + 1) / 2) + " parts", std::to_string(count));
}

/// Plausible values of the table for the mechanisms without values in the file.
void complete_plausible(CheckedFile& file) {
  const Json& analysis = file.values().at("analysis");
  Json list = analysis.value("plausible", Json::array());
  const std::size_t given = list.size();
  for (const Json& name : analysis.at("mechanisms")) {
    // A faulty item has no name.
    const auto is_it = [&](const Json& item) { return item.contains("mechanism") && item.at("mechanism") == name; };
    if (std::any_of(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(given), is_it)) continue;
    const Departure* mechanism = find_mechanism(name.get<std::string>());
    for (const PlausibleValues& plausible : mechanism->plausible) {
      Json item = {{"mechanism", name}, {"case", plausible.name}, {"because", plausible.because}};
      for (std::size_t i = 0; i < plausible.values.size(); ++i)
        item[std::string(mechanism->parameters[i].name)] = plausible.values[i];
      list.push_back(std::move(item));
    }
  }
  file.fill_in("plausible", std::move(list));
}

void check_mechanisms(CheckedFile& file) {
  check_truth(file);
  if (!file.has("analysis", "amplitudes")) refuse_replaced_amplitude(file);
  const Json& analysis = file.values().at("analysis");
  if (analysis.contains("estimates")) check_parts(file);
  if (!file.stands_in_file("analysis", "mechanisms")) {
    Json all = Json::array();
    for (const Departure& mechanism : mechanisms()) all.push_back(mechanism.name);
    file.fill_in("mechanisms", std::move(all));
  }
  if (analysis.contains("mechanisms")) complete_plausible(file);
}

/// The friction of the system, one Coulomb law (check_truth), is that which the rig is believed to have.
MechanismStudy study_of(const Json& section, const Json& system) {
  MechanismStudy result;
  result.friction = {scenarios::number(system.at("friction").at("kinetic")),
                     scenarios::number(system.at("damping"))};
  for (const Json& item : section.at("estimates"))
    result.estimates.push_back({scenarios::number(item.at("share")), scenarios::number(item.at("zeta")),
                                scenarios::number(item.at("F0")), scenarios::number(item.at("zeta_std")),
                                scenarios::number(item.at("F0_std"))});
  std::ranges::sort(result.estimates, std::ranges::greater{}, &PartEstimate::share);
  if (section.contains("amplitudes")) result.amplitudes = scenarios::grid_values(section.at("amplitudes"));
  std::ranges::sort(result.amplitudes);
  result.levels = section.contains("levels") ? section.at("levels").get<std::size_t>() : result.amplitudes.size();
  for (const Json& name : section.at("mechanisms"))
    result.mechanisms.push_back(find_mechanism(name.get<std::string>()));
  for (const Json& item : section.at("plausible")) {
    const Departure* mechanism = find_mechanism(item.at("mechanism").get<std::string>());
    PlausibleRig rig{mechanism, item.at("case").get<std::string>(), {}, item.at("because").get<std::string>()};
    for (const DepartureParameter& parameter : mechanism->parameters)
      rig.values.push_back(scenarios::number(item.at(std::string(parameter.name))));
    result.plausible.push_back(std::move(rig));
  }
  if (!section.contains("decay")) return result;
  const Json& decay = section.at("decay");
  const auto segment = [&](const char* name) {
    return MeasuredDecay::Segment{scenarios::number(decay.at(name).at("zeta")),
                                  scenarios::number(decay.at(name).at("x_f"))};
  };
  result.decay = {scenarios::number(decay.at("stiffness")), scenarios::number(decay.at("displacement")),
                  segment("high"), segment("low")};
  return result;
}

/// Keys of the other sections that the study does not use.
std::vector<scenarios::IdleKey> idle_keys() {
  const std::string drive = "the levels are those of a sine without harmonics, at any phase";
  std::vector<scenarios::IdleKey> keys = {{"excitation", "phase", drive, ""},
                                          {"excitation", "harmonics", drive, "without it"}};
  std::ranges::move(scenarios::idle_start("the study is of steady states"), std::back_inserter(keys));
  return keys;
}

std::unique_ptr<const Question> ask_mechanisms(CheckedValues&& values) {
  return std::make_unique<MechanismsQuestion>(study_of(values.analysis, values.system));
}

}  // namespace

const Analysis& mechanisms_analysis() {
  static const Analysis analysis = {
      .name = "mechanisms",
      .summary = "which mechanism explains that estimates change as the upper x-Y data are left out",
      .keys = mechanisms_keys(),
      .needs =
          {{"", {"base_harmonic"}, {"frequency"}, true, "the lines are of the amplitude of the base", idle_keys()}},
      .results = mechanisms_fields(),
      .check = check_mechanisms,
      .ask = ask_mechanisms};
  return analysis;
}

}  // namespace dualdamp::bench
