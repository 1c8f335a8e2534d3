#include "bench/stress_test.hpp"

#include <algorithm>
#include <cmath>

#include "bench/campaign.hpp"
#include "bench/departure_names.hpp"
#include "bench/random_response.hpp"
#include "bench/score/program_answer.hpp"
#include "bench/score/score_tables.hpp"
#include "bench/stress_test_checks.hpp"
#include "identify/statistics/median.hpp"
#include "scenarios/format/common_keys.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/measurements/method_choice.hpp"
#include "scenarios/measurements/sensors.hpp"
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
