#include "bench/stress_test.hpp"

#include <algorithm>
#include <numbers>

#include "bench/campaign.hpp"
#include "bench/truth.hpp"
#include "core/numbers.hpp"
#include "scenarios/format/common_keys.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/measurements/method_choice.hpp"
#include "scenarios/measurements/sensors.hpp"
#include "scenarios/measurements/work_checks.hpp"
#include "scenarios/results/motion.hpp"
#include "sim/rigs/rigs.hpp"

namespace dualdamp::bench {

namespace {

using namespace scenarios;

class StressTestQuestion final : public Question, public Campaign {
 public:
  explicit StressTestQuestion(StressTest question) : question_(std::move(question)) {}

  [[nodiscard]] Answer run(const RunContext& context) const override { return run_campaign(question_, context); }
  [[nodiscard]] std::string size(const RunContext& context) const override {
    return describe(size_of(question_, context));
  }

 private:
  StressTest question_;
};

std::vector<std::string> departure_names() {
  std::vector<std::string> names;
  for (const Rig& departure : departures()) names.emplace_back(departure.name);
  return names;
}

Section keys() {
  constexpr int max_seeds = 1'000'000;
  std::vector<Field> set = {text("name", "its name in the results").required()};
  for (Field& field : sensor_fields())
    if (field.name != "seed") set.push_back(std::move(field));
  const Section range = {
      {text("name", "its name in the results").required(), amplitudes(), optional(frequencies())}};
  const Section decay = {
      {quantity("displacement", {"m"}, "initial displacement of a release from rest").required().above(0),
       peaks()}};
  return {
      {word_list("laws", departure_names(), "departures from Coulomb + viscous friction; default: all"),
       grid("severities", {"1"}, "severities; each departure defines its own")
           .required()
           .above(0)
           .items(1, max_sets),
       section_list("ranges", range, "input amplitudes, and frequencies, of the steady states that are measured")
           .required()
           .items(1, max_sets),
       section_list("sensors", Section{std::move(set)},
                    "what the curves are measured with; default: perfect sensors")
           .items(1, max_sets),
       integer("seeds", "number of seeds of the sensors' noise").with_fallback(1).at_least(1).at_most(max_seeds),
       section("decay", decay, "a free vibration in addition to each curve, for the methods that need one"),
       methods_key("all that the measurements allow")}};
}

scenarios::ResultFields fields() {
  return {{"cases.all", "1", "cases of the grid"},
          {"cases.failed", "1", "cases without an estimate by any method"},
          {"cases.motions", "1", "motions computed for them"},
          {"cases.estimates", "1", "cases times methods"},
          {"ranking[].method", "", "a method, best first"},
          {"ranking[].unwarned", "1", "share of missed detections: wrong by more than 5 % without a diagnostic"},
          {"ranking[].wrong", "1", "share of cases that are off by more than 5 %"},
          {"ranking[].knew", "1", "share of the wrong ones with a diagnostic"},
          {"ranking[].false_alarm", "1", "share of false alarms where friction is Coulomb + viscous"},
          {"ranking[].coverage", "1", "share of 95 % intervals that hold the true F0 there"},
          {"breakdown[].law", "", "departure"},
          {"breakdown[].range", "", "range of excitation"},
          {"breakdown[].sensors", "", "sensors"},
          {"breakdown[].method", "", "method"},
          {"breakdown[].zeta_5", "1", "severity from which zeta is off by more than 5 %"},
          {"breakdown[].zeta_20", "1", "or by more than 20 %"},
          {"breakdown[].F0_5", "1", "severity from which F0 is off by more than 5 %"},
          {"breakdown[].F0_20", "1", "or by more than 20 %"},
          {"breakdown[].wrong", "1", "share of cases that are off by more than 5 %"},
          {"breakdown[].knew", "1", "share of the wrong ones with a diagnostic"},
          {"scores[].law", "", "departure, or coulomb_viscous"},
          {"scores[].severity", "1", "its size"},
          {"scores[].range", "", "range of excitation"},
          {"scores[].sensors", "", "sensors"},
          {"scores[].method", "", "method"},
          {"scores[].cases", "1", "seeds"},
          {"scores[].estimates", "1", "seeds with a number"},
          {"scores[].zeta_bias", "1", "mean error of zeta, relative"},
          {"scores[].zeta_spread", "1", "standard deviation of it"},
          {"scores[].zeta_error", "1", "median of its modulus"},
          {"scores[].zeta_coverage", "1", "share of 95 % intervals that hold the truth"},
          {"scores[].F0_bias", "1", "mean error of F0, relative"},
          {"scores[].F0_spread", "1", "standard deviation of it"},
          {"scores[].F0_error", "1", "median of its modulus"},
          {"scores[].F0_coverage", "1", "share of 95 % intervals that hold the truth"},
          {"scores[].wrong", "1", "share of cases that are off by more than 5 %"},
          {"scores[].knew", "1", "share of the wrong ones with a diagnostic"},
          {"scores[].false_alarm", "1", "share of the right ones with a diagnostic: false alarms"}};
}

/// Beyond its largest severity a departure has no meaning.
void check_severities(CheckedFile& file, const Json& analysis) {
  const Json& grid = analysis.at("severities");
  double most = 0.0;
  for (const Json& value : grid.is_array() ? grid : Json::array({grid.at("from"), grid.at("to")}))
    most = std::max(most, number(value));
  for (const Json& name : analysis.at("laws")) {
    const Rig& law = *find_departure(name.get<std::string>());
    if (most > law.largest)
      file.complain("analysis.severities", "'" + std::string(law.name) + "' has no such severity",
                    "at most " + core::format_number(law.largest, 3) + ": " + std::string(law.severity),
                    core::format_number(most, 6));
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

/// Number of steady states of a range.
std::size_t states_of(const Json& range) {
  return grid_size(range.at("amplitudes")) *
         (range.contains("frequencies") ? grid_size(range.at("frequencies")) : 1);
}

/// A record of the kind that each range gives with each set of sensors.
std::vector<identify::Record> outlines(const Json& analysis) {
  std::vector<identify::Record> records;
  const Json sets = analysis.value("sensors", Json::array({Json::object()}));
  for (const Json& range : analysis.at("ranges")) {
    if (!range.contains("amplitudes")) continue;
    for (const Json& sensors : sets) {
      identify::Record& record = records.emplace_back();
      std::vector<identify::Pair>& pairs = record.pairs.emplace().pairs;
      const std::size_t amplitudes = grid_size(range.at("amplitudes"));
      for (std::size_t i = 0; i < states_of(range); ++i) {
        const std::size_t frequency = 1 + i / amplitudes;
        pairs.push_back({.Y = 1.0,
                         .x = 1.0,
                         .omega = static_cast<double>(frequency),
                         .phase = 0.0,
                         .fundamental = 1.0,
                         .mean_square_speed = 1.0});
      }
      if (analysis.contains("decay")) record.decay = identify::DecayRecord{{1.0}, {0.0}};
      if (sensors.contains("sample_rate"))
        record.histories.resize(pairs.size(), {.sample_rate = 1.0, .y = {0.0}, .x = {0.0}, .v = {0.0}, .a = {0.0}});
    }
  }
  return records;
}

/// Histories of one motion are in memory together.
void check_samples(CheckedFile& file, const Json& analysis) {
  if (!analysis.contains("sensors")) return;
  double most = 0.0;
  for (const Json& range : analysis.at("ranges"))
    if (range.contains("amplitudes")) most = std::max(most, static_cast<double>(states_of(range)));
  const double period = 2.0 * std::numbers::pi / file.number_at("excitation", "frequency").value_or(1.0);
  for (const Json& set : analysis.at("sensors"))
    if (set.contains("sample_rate"))
      check_rows(file, "analysis.sample_rate",
                 most * number(set.at("sample_rate")) * period * set.value("average_cycles", 1));
}

void check(CheckedFile& file) {
  const Json& analysis = file.values().at("analysis");
  if (!file.has("analysis", "severities") || !file.has("analysis", "ranges")) return;
  check_truth(file);
  check_names(file, "ranges");
  check_names(file, "sensors");
  check_samples(file, analysis);
  if (!file.stands_in_file("analysis", "laws")) {
    Json all = Json::array();
    for (const Rig& departure : departures()) all.push_back(departure.name);
    file.fill_in("laws", std::move(all));
  }
  resolve_methods(file, outlines(analysis), scenarios::SlowMethods::only_where_named);
  if (!analysis.contains("laws")) return;
  check_severities(file, analysis);
  const std::size_t motions =
      (1 + analysis.at("laws").size() * grid_size(analysis.at("severities"))) * analysis.at("ranges").size();
  const std::size_t sets = analysis.contains("sensors") ? analysis.at("sensors").size() : 1;
  constexpr double most_cases = 1e7;
  const double cases = static_cast<double>(motions) * static_cast<double>(sets) * analysis.value("seeds", 1);
  if (cases > most_cases)
    file.complain("analysis.type", "the stress test has too many cases",
                  "at most " + core::format_number(most_cases, 6) +
                      ": laws times severities times ranges times sensors times seeds",
                  core::format_number(cases, 9));
}

/// The friction of the system is the truth, one Coulomb law (check_truth).
StressTest stress_test_of(const CheckedValues& values) {
  const Json& section = values.analysis;
  const double frequency = values.model.excitation.frequency;
  StressTest result;
  result.F0 = number(values.system.at("friction").at("kinetic"));
  for (const Json& name : section.at("laws")) result.laws.push_back(find_departure(name.get<std::string>()));
  result.severities = grid_values(section.at("severities"));
  std::ranges::sort(result.severities);
  for (const Json& range : section.at("ranges"))
    result.ranges.push_back(
        {range.at("name").get<std::string>(), grid_values(range.at("amplitudes")),
         range.contains("frequencies") ? grid_values(range.at("frequencies")) : std::vector<double>{frequency}});
  if (section.contains("sensors"))
    for (const Json& set : section.at("sensors"))
      result.sensors.push_back({set.at("name").get<std::string>(), sensors_of(set)});
  else
    result.sensors.push_back({"perfect", {}});
  result.seeds = section.at("seeds").get<int>();
  if (section.contains("decay"))
    result.decay = {number(section.at("decay").at("displacement")), section.at("decay").at("peaks").get<int>()};
  result.methods = methods_of(section.at("methods"));
  return result;
}

std::unique_ptr<const Question> ask(CheckedValues&& values) {
  return std::make_unique<StressTestQuestion>(stress_test_of(values));
}

}  // namespace

const Analysis& stress_test_analysis() {
  static const Analysis analysis = {
      .name = "stress_test",
      .summary =
          "how wrong each method is under friction that is not Coulomb + viscous, and whether its diagnostics say "
          "so",
      .keys = keys(),
      .needs = {{"", {"base_harmonic"}, {"frequency"}, true, "the methods need the amplitude of the base"}},
      .results = fields(),
      .check = check,
      .ask = ask};
  return analysis;
}

}  // namespace dualdamp::bench
