#include "bench/stress_test.hpp"

#include <algorithm>
#include <cmath>

#include "bench/campaign.hpp"
#include "bench/departure_names.hpp"
#include "bench/random_response.hpp"
#include "bench/score/program_answer.hpp"
#include "bench/score/score_tables.hpp"
#include "bench/truth.hpp"
#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/statistics/median.hpp"
#include "scenarios/format/common_keys.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/measurements/method_choice.hpp"
#include "scenarios/measurements/sensors.hpp"
#include "scenarios/measurements/work_checks.hpp"
#include "scenarios/results/motion.hpp"

namespace dualdamp::bench {

namespace {

using scenarios::Analysis;
using scenarios::Answer;
using scenarios::Campaign;
using scenarios::CheckedFile;
using scenarios::CheckedValues;
using scenarios::Field;
using scenarios::Json;
using scenarios::Question;
using scenarios::RunContext;
using scenarios::Section;

class StressTestQuestion final : public Question, public Campaign {
 public:
  explicit StressTestQuestion(StressTest question) : question_(std::move(question)) {}

  [[nodiscard]] Answer run(const RunContext& context) const override { return run_campaign(question_, context); }
  [[nodiscard]] const StressTest& question() const { return question_; }
  [[nodiscard]] std::string size(const RunContext& context) const override {
    return describe(size_of(question_, context));
  }

 private:
  StressTest question_;
};

std::vector<std::string> departure_names() {
  std::vector<std::string> names;
  for (const Departure& departure : departures()) names.emplace_back(departure.name);
  return names;
}

/// Names of the departures that can be the second of a pair.
std::vector<std::string> companion_names() {
  std::vector<std::string> names;
  for (const Departure& departure : departures())
    if (leaves_friction_alone(departure)) names.emplace_back(departure.name);
  return names;
}

/// {from, to}: range of the rigs, on a logarithmic scale.
Field between(const std::string& name, const std::string& meaning) {
  using namespace scenarios;
  return section(name,
                 {{quantity("from", {"1"}, "smallest").required().above(0),
                   quantity("to", {"1"}, "largest").required().above(0)}},
                 meaning);
}

Section rig_keys() {
  using namespace scenarios;
  constexpr int max_rigs = 10'000;
  return {
      {integer("count", "how many").required().at_least(1).at_most(max_rigs),
       between("damping_ratio", "zeta; default: that of the scenario"),
       between("friction_ratio",
               "F0 over k Y, Y the amplitude in the middle of the first range; default: that of the scenario"),
       between("frequency_ratio",
               "forcing frequency over the natural one, where a range names no frequencies; default: that of the "
               "scenario")}};
}

Section stress_test_keys() {
  using namespace scenarios;
  constexpr int max_seeds = 1'000'000;
  std::vector<Field> set = {text("name", "name in the results").required()};
  for (Field& field : sensor_fields())
    if (field.name != "seed") set.push_back(std::move(field));
  constexpr int max_sweeps = 100;
  const Section range = {{text("name", "name in the results").required(), amplitudes(), optional(frequencies()),
                          integer("sweeps", "how often all its states are measured, sweep after sweep")
                              .with_fallback(1)
                              .at_least(1)
                              .at_most(max_sweeps)}};
  const Section pair = {
      {words("law", departure_names(), "the first departure").required(),
       words("beside", companion_names(), "a second one, in spring, sensors, constants or drive").required()}};
  const Section decay = {
      {quantity("displacement", {"m"}, "initial displacement of a release from rest").required().above(0),
       peaks()}};
  return {
      {word_list("laws", departure_names(), "departures from Coulomb + viscous friction; default: all"),
       section_list("pairs", pair, "two departures together, both at each severity; default: none")
           .items(1, max_sets),
       grid("severities", {"1"}, "severities; their meaning depends on the departure")
           .required()
           .above(0)
           .items(1, max_sets),
       section_list("ranges", range, "input amplitudes, and frequencies, of the steady states that are measured")
           .required()
           .items(1, max_sets),
       section_list("sensors", Section{std::move(set)},
                    "what the curves are measured with; default: perfect sensors")
           .items(1, max_sets),
       integer("seeds", "how often each set of sensors reads each motion, each time with other noise")
           .with_fallback(1)
           .at_least(1)
           .at_most(max_seeds),
       seed(),
       section("rigs", rig_keys(), "rigs of a low-discrepancy set (Halton); default: the rig of the scenario"),
       section("decay", decay, "a free vibration in addition to each curve, for the methods that need one"),
       random_response_key(), methods_key("all that the measurements allow"),
       boolean("answer",
               "the program's own answer is scored too, as a method: the answer of 'identify' without any_law")
           .with_fallback(false)}};
}

/// An item of `pairs`; nothing where the reader has refused a part of it.
std::optional<CaseDeparture> pair_of(const Json& item) {
  if (!item.contains("law") || !item.contains("beside")) return std::nullopt;
  return CaseDeparture{find_departure(item.at("law").get<std::string>()),
                       find_departure(item.at("beside").get<std::string>())};
}

/// The departures in the order of the file: single ones, then the pairs.
std::vector<CaseDeparture> departures_of(const Json& analysis) {
  std::vector<CaseDeparture> list;
  for (const Json& name : analysis.at("laws")) list.push_back({find_departure(name.get<std::string>())});
  for (const Json& item : analysis.value("pairs", Json::array()))
    if (const std::optional<CaseDeparture> pair = pair_of(item)) list.push_back(*pair);
  return list;
}

/// Beyond its largest severity a departure has no meaning, and equal severities would be one cell twice.
void check_severities(CheckedFile& file, const Json& analysis) {
  std::vector<double> severities = scenarios::grid_values(analysis.at("severities"));
  std::ranges::sort(severities);
  if (const auto twice = std::ranges::adjacent_find(severities); twice != severities.end())
    file.complain("analysis.severities", "'analysis.severities' has a value twice", "each once",
                  core::format_number(*twice, 6));
  const double most = severities.back();
  for (const CaseDeparture& departure : departures_of(analysis)) {
    if (most > departure.largest())
      file.complain("analysis.severities", "'" + departure.name() + "' has no such severity",
                    "at most " + core::format_number(departure.largest(), 3) + ": " + departure.severity(),
                    core::format_number(most, 6));
  }
}

/// Whether some range is measured more than once.
bool has_sweeps(const Json& analysis) {
  return std::ranges::any_of(analysis.at("ranges"), [](const Json& range) { return range.value("sweeps", 1) > 1; });
}

void check_sweeps(CheckedFile& file, const Json& analysis) {
  for (const CaseDeparture& departure : departures_of(analysis))
    if (departure.needs_sweeps() && !has_sweeps(analysis))
      file.complain("analysis.ranges", "'" + departure.name() + "' has an effect only in records of several sweeps",
                    "a range with 'sweeps' above 1");
}

/// Refuses pairs within one family, which would cancel or repeat each other, and equal pairs.
void check_pairs(CheckedFile& file, const Json& analysis) {
  const Json pairs = analysis.value("pairs", Json::array());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::string place = "analysis.pairs[" + std::to_string(i) + "]";
    const std::optional<CaseDeparture> both = pair_of(pairs.at(i));
    if (!both) continue;
    if (both->first->family == both->beside->family)
      file.complain(place + ".beside", "both departures lie in one family",
                    "a departure that is not of " + std::string(name_of(both->first->family)),
                    std::string(both->beside->name));
    names.push_back(both->name());
    if (std::ranges::count(names, names.back()) > 1)
      file.complain(place + ".law", "there are two pairs of these departures", "distinct pairs", names.back());
  }
}

void check_names(CheckedFile& file, const std::string& key) {
  if (!file.has("analysis", key)) return;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < file.values().at("analysis").at(key).size(); ++i) {
    const Json& item = file.values().at("analysis").at(key).at(i);
    if (!item.contains("name")) continue;
    names.push_back(item.at("name").get<std::string>());
    if (std::ranges::count(names, names.back()) > 1)
      file.complain("analysis." + key + "[" + std::to_string(i) + "].name",
                    "there are two " + key + " with this name", "distinct names", names.back());
  }
}

/// Smallest F0/k of the rigs [m]: the input amplitude up to which all of them stick. Nothing where it is not known
/// or more than F0 and k decides.
std::optional<double> least_moving_amplitude(const CheckedFile& file, const Json& analysis) {
  const Json& system = file.values().at("system");
  const std::optional<double> k = file.number_at("system", "stiffness");
  if (!k || !file.has("system", "friction") || file.number_at("system", "cubic_stiffness").value_or(0.0) != 0.0 ||
      (file.has("system", "damper_to") && file.text_at("system", "damper_to") != "ground") ||
      file.has("excitation", "harmonics"))
    return std::nullopt;
  const Json& levels = analysis.at("ranges").at(0);
  if (analysis.contains("rigs") && analysis.at("rigs").contains("friction_ratio")) {
    const Json& ratio = analysis.at("rigs").at("friction_ratio");
    if (!levels.contains("amplitudes") || !ratio.contains("from") || !ratio.contains("to")) return std::nullopt;
    return identify::upper_median(scenarios::grid_values(levels.at("amplitudes"))) *
           std::min(scenarios::number(ratio.at("from")), scenarios::number(ratio.at("to")));
  }
  const Json& friction = system.at("friction");
  if (!friction.is_object() || !friction.contains("kinetic")) return std::nullopt;
  return scenarios::number(friction.at("kinetic")) / *k;
}

/// Refuses a range in which every rig sticks at every level: it has no motion that severities could refer to.
void check_motion(CheckedFile& file, const Json& analysis) {
  const std::optional<double> limit = least_moving_amplitude(file, analysis);
  if (!limit) return;
  for (std::size_t i = 0; i < analysis.at("ranges").size(); ++i) {
    const Json& range = analysis.at("ranges").at(i);
    if (!range.contains("amplitudes") || !range.contains("name")) continue;
    const double most = std::ranges::max(scenarios::grid_values(range.at("amplitudes")));
    if (most > *limit) continue;
    constexpr int digits = 3;
    const std::string unit = " " + core::unit_for(file.coordinate(), "m");
    file.complain("analysis.ranges[" + std::to_string(i) + "].amplitudes",
                  "the mass sticks at every level of the range '" + range.at("name").get<std::string>() +
                      "': F0/(kY) is " + core::format_number(*limit / most, digits) + " at the largest Y",
                  "an amplitude above F0/k = " + core::format_number(*limit, digits) + unit,
                  core::format_number(most, digits) + unit);
  }
}

/// Number of steady states of a range.
std::size_t states_of(const Json& range) {
  return scenarios::grid_size(range.at("amplitudes")) *
         (range.contains("frequencies") ? scenarios::grid_size(range.at("frequencies")) : 1) *
         static_cast<std::size_t>(range.value("sweeps", 1));
}

/// A record of the kind that each range gives with each set of sensors.
std::vector<identify::Record> outlines(const CheckedFile& file) {
  const Json& analysis = file.values().at("analysis");
  std::vector<identify::Record> records;
  const Json sets = analysis.value("sensors", Json::array({Json::object()}));
  for (const Json& range : analysis.at("ranges")) {
    if (!range.contains("amplitudes")) continue;
    for (const Json& sensors : sets) {
      identify::Record& record = records.emplace_back();
      std::vector<identify::Pair>& pairs = record.pairs.emplace().pairs;
      const std::size_t amplitudes = scenarios::grid_size(range.at("amplitudes"));
      const int sweeps = range.value("sweeps", 1);
      const std::size_t in_sweep = states_of(range) / static_cast<std::size_t>(sweeps);
      for (std::size_t i = 0; i < states_of(range); ++i) {
        const std::size_t frequency = 1 + i % in_sweep / amplitudes;
        pairs.push_back({.Y = 1.0,
                         .x = 1.0,
                         .sweep = sweeps > 1 ? std::to_string(1 + i / in_sweep) : "",
                         .omega = static_cast<double>(frequency),
                         .phase = 0.0,
                         .fundamental = 1.0,
                         .mean_square_speed = 1.0});
      }
      if (analysis.contains("decay")) record.decay = identify::DecayRecord{{1.0}, {0.0}};
      // A faulty section is reported once, not also as missing.
      if (file.stands_in_file("analysis", "random_response"))
        record.histories.push_back(random_outline(analysis.value("random_response", Json::object())));
      if (sensors.contains("sample_rate"))
        record.histories.resize(pairs.size(), {.sample_rate = 1.0, .y = {0.0}, .x = {0.0}, .v = {0.0}, .a = {0.0}});
    }
  }
  return records;
}

/// Bounds the samples of one motion, whose histories are in memory together.
void check_samples(CheckedFile& file, const Json& analysis) {
  if (!analysis.contains("sensors")) return;
  double most = 0.0;
  for (const Json& range : analysis.at("ranges"))
    if (range.contains("amplitudes")) most = std::max(most, static_cast<double>(states_of(range)));
  const double period = core::two_pi / file.number_at("excitation", "frequency").value_or(1.0);
  for (std::size_t i = 0; i < analysis.at("sensors").size(); ++i) {
    const Json& set = analysis.at("sensors").at(i);
    if (set.contains("sample_rate"))
      check_rows(file, "analysis.sensors[" + std::to_string(i) + "].sample_rate",
                 most * scenarios::number(set.at("sample_rate")) * period * set.value("average_cycles", 1));
  }
}

void check_stress_test(CheckedFile& file) {
  const Json& analysis = file.values().at("analysis");
  if (!file.has("analysis", "severities") || !file.has("analysis", "ranges")) return;
  check_truth(file);
  check_names(file, "ranges");
  check_names(file, "sensors");
  check_samples(file, analysis);
  for (std::size_t i = 0; i < analysis.value("sensors", Json::array()).size(); ++i)
    scenarios::check_outliers(file, "analysis.sensors[" + std::to_string(i) + "]");
  check_random_response(file);
  if (!file.stands_in_file("analysis", "laws")) {
    Json all = Json::array();
    for (const Departure& departure : departures())
      if (!departure.needs_sweeps || has_sweeps(analysis)) all.push_back(departure.name);
    file.fill_in("laws", std::move(all));
  }
  resolve_methods(file, outlines(file), scenarios::SlowMethods::only_where_named);
  if (!analysis.contains("laws")) return;
  check_pairs(file, analysis);
  check_severities(file, analysis);
  check_motion(file, analysis);
  check_sweeps(file, analysis);
  const std::size_t departures = departures_of(analysis).size();
  const std::size_t motions =
      (1 + departures * scenarios::grid_size(analysis.at("severities"))) * analysis.at("ranges").size();
  const std::size_t sets = analysis.contains("sensors") ? analysis.at("sensors").size() : 1;
  constexpr double most_cases = 1e7;
  const int rigs = analysis.contains("rigs") ? analysis.at("rigs").value("count", 1) : 1;
  const double cases = static_cast<double>(motions) * static_cast<double>(sets) * analysis.value("seeds", 1) *
                       static_cast<double>(rigs);
  if (cases > most_cases)
    file.complain("analysis.type", "the stress test has too many cases",
                  "at most " + core::format_number(most_cases, 6) +
                      ": laws times severities times ranges times sensors times rigs times seeds",
                  core::format_number(cases, 9));
}

/// Van der Corput's sequence: the digits of n in this base, mirrored at the point.
double mirrored(int n, int base) {
  double result = 0.0;
  for (double place = 1.0 / base; n > 0; n /= base, place /= base) result += place * (n % base);
  return result;
}

/// The truth of the scenario, or rigs at the points of Halton's sequence.
std::vector<TrueRig> rigs_of(const CheckedValues& values, double middle) {
  Truth truth{.model = values.model, .F0 = scenarios::number(values.system.at("friction").at("kinetic"))};
  truth.model.friction.clear();
  if (!values.analysis.contains("rigs")) return {{truth, values.model.excitation.frequency}};
  const Json& keys = values.analysis.at("rigs");
  const sim::Oscillator own = truth.model.oscillator;
  std::vector<TrueRig> rigs;
  for (int i = 1; i <= keys.at("count").get<int>(); ++i) {
    const auto drawn = [&](const char* key, int base, double fallback) {
      if (!keys.contains(key)) return fallback;
      const double from = scenarios::number(keys.at(key).at("from"));
      return from * std::pow(scenarios::number(keys.at(key).at("to")) / from, mirrored(i, base));
    };
    TrueRig rig{truth};
    rig.truth.model.oscillator.damping =
        identify::critical_damping(own.mass, own.stiffness) * drawn("damping_ratio", 2, sim::damping_ratio(own));
    rig.truth.F0 = own.stiffness * middle * drawn("friction_ratio", 3, truth.F0 / (own.stiffness * middle));
    rig.truth.model.excitation.frequency =
        sim::natural_frequency(own) *
        drawn("frequency_ratio", 5, truth.model.excitation.frequency / sim::natural_frequency(own));
    rig.frequency = rig.truth.model.excitation.frequency;
    rigs.push_back(std::move(rig));
  }
  return rigs;
}

/// The friction of the system is the truth, one Coulomb law (check_truth).
StressTest stress_test_of(const CheckedValues& values) {
  const Json& section = values.analysis;
  StressTest result;
  result.departures = departures_of(section);
  result.severities = scenarios::grid_values(section.at("severities"));
  std::ranges::sort(result.severities);
  for (const Json& range : section.at("ranges"))
    result.ranges.push_back(
        {range.at("name").get<std::string>(), scenarios::grid_values(range.at("amplitudes")),
         range.contains("frequencies") ? scenarios::grid_values(range.at("frequencies")) : std::vector<double>{},
         range.at("sweeps").get<int>()});
  result.rigs = rigs_of(values, identify::upper_median(result.ranges.front().amplitudes));
  if (section.contains("sensors"))
    for (const Json& set : section.at("sensors"))
      result.sensors.push_back({set.at("name").get<std::string>(), scenarios::sensors_of(set)});
  else
    result.sensors.push_back({"perfect", {}});
  result.seeds = section.at("seeds").get<int>();
  result.seed = section.at("seed").get<std::int64_t>();
  if (section.contains("decay"))
    result.decay = {scenarios::number(section.at("decay").at("displacement")),
                    section.at("decay").at("peaks").get<int>()};
  if (section.contains("random_response")) result.random = random_test_of(section.at("random_response"));
  result.methods = scenarios::methods_of(section.at("methods"));
  if (section.at("answer").get<bool>()) result.methods.push_back(&program_answer);
  return result;
}

std::unique_ptr<const Question> ask_stress_test(CheckedValues&& values) {
  return std::make_unique<StressTestQuestion>(stress_test_of(values));
}

}  // namespace

const StressTest* stress_test_of(const Question& question) {
  const auto* const asked = dynamic_cast<const StressTestQuestion*>(&question);
  return asked == nullptr ? nullptr : &asked->question();
}

std::unique_ptr<const Question> question_of(StressTest question) {
  return std::make_unique<StressTestQuestion>(std::move(question));
}

const Analysis& stress_test_analysis() {
  static const Analysis analysis = {
      .name = "stress_test",
      .summary = "how wrong each method is under friction that is not Coulomb + viscous, and whether it rejects",
      .keys = stress_test_keys(),
      .needs = {{"", {"base_harmonic"}, {"frequency"}, true, "the methods need the amplitude of the base"}},
      .results = score_fields(),
      .chart = {.table = "consequences",
                .list = "consequences",
                .x = "distance",
                .y = "harm",
                .x_label = "distance in units of noise",
                .y_label = "harm",
                .by = "law",
                .kind = scenarios::MainChart::Kind::points},
      .check = check_stress_test,
      .ask = ask_stress_test};
  return analysis;
}

}  // namespace dualdamp::bench
