/// Results computed again in another way (`numerics: {verify: true}`).

#include "scenarios/verification/verification.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/diagnostics.hpp"
#include "scenarios/analysis.hpp"
#include "scenarios/run.hpp"
#include "sim/engine/state.hpp"

using namespace dualdamp;
using scenarios::Answer;
using scenarios::Json;
using scenarios::Verification;

namespace {

scenarios::Scenario verified_scenario(
    const std::string& friction, const std::string& analysis,
    const std::string& excitation = "base_harmonic, amplitude: 0.1, frequency: 10 rad/s",
    const std::string& more = "numerics: {verify: true}") {
  return scenarios::parse_scenario("schema: dualdamp/1\nsystem: {mass: 1, stiffness: 100, damping: 4, friction: " +
                                       friction + "}\nexcitation: {type: " + excitation +
                                       "}\ninitial: {position: 0.01}\nanalysis: " + analysis + "\n" + more + "\n",
                                   "test.yaml");
}

const std::string coulomb = "{law: coulomb, kinetic: 2, static: 2.5}";

const std::vector<scenarios::ResultField> fields = {{"peak", "m", ""}};

/// A steady state that the smooth engine finds only from a state near it.
class HardSteadyState : public scenarios::Question {
 public:
  HardSteadyState(bool is_reached, double peak_of_smooth) : is_reached_(is_reached), peak_(peak_of_smooth) {}

  [[nodiscard]] Answer run(const scenarios::RunContext& context) const override {
    const bool is_exact = context.model.solver.kind == sim::SolverKind::automatic;
    if (!is_exact && context.from == nullptr) return scenarios::failed("too many steps");
    if (!is_exact) CHECK(context.from->x == 0.1);
    Answer found;
    found.result = {{"peak", is_exact ? 0.1 : peak_}};
    found.orbit = std::make_shared<const sim::State>(sim::State{.x = 0.1});
    return found;
  }
  [[nodiscard]] std::optional<scenarios::OtherWay> other_way(const scenarios::RunContext& /*context*/,
                                                             const Answer& /*answer*/) const override {
    scenarios::OtherWay transient{"the transient", scenarios::failed("it has not settled")};
    if (is_reached_) transient.answer.result = {{"peak", 0.1}};
    return transient;
  }

 private:
  bool is_reached_;
  double peak_;
};

/// A peak of 0.1 m by the exact engine.
class PeakBySteps : public scenarios::Question {
 public:
  PeakBySteps(double by_explicit, double by_implicit) : explicit_(by_explicit), implicit_(by_implicit) {}

  [[nodiscard]] Answer run(const scenarios::RunContext& context) const override {
    const sim::SolverKind kind = context.model.solver.kind;
    const double by_steps = kind == sim::SolverKind::explicit_steps ? explicit_ : implicit_;
    Answer found;
    found.result = {{"peak", kind == sim::SolverKind::automatic ? 0.1 : by_steps}};
    return found;
  }

 private:
  double explicit_;
  double implicit_;
};

Verification verification_of_hard(bool is_reached, double peak_of_smooth) {
  scenarios::Scenario scenario = verified_scenario(coulomb, "{type: steady_state}");
  scenario.question = std::make_shared<HardSteadyState>(is_reached, peak_of_smooth);
  scenario.result_fields = fields;
  const scenarios::RunOptions options;
  return scenarios::verify(scenario, options, scenario.question->run({scenario.model, 1e-14, "", options}));
}

}  // namespace

TEST_CASE("verification: a steady state whose way is too long for the other engine is computed again on its orbit",
          "[scenarios][verification]") {
  const Verification found = verification_of_hard(true, 0.1);
  CHECK(found.agrees);
  CHECK(found.engine == "smooth engine, explicit steps at tolerance 1e-13, begun on the orbit; the transient");
  CHECK_FALSE(verification_of_hard(true, 0.2).agrees);
  // Another orbit than the one that the motion approaches could be on its own orbit too.
  const Verification unreached = verification_of_hard(false, 0.1);
  CHECK_FALSE(unreached.agrees);
  CHECK(unreached.reason == "the other computation has no result: too many steps");
}

TEST_CASE("verification: an orbit of any period has as many samples in each of its forcing periods",
          "[scenarios][verification]") {
  // So that it can be compared with an orbit that begins with another period: there are seven, and 720 is not a
  // multiple of 7.
  const scenarios::RunResult result = scenarios::run(scenarios::parse_scenario(
      "schema: dualdamp/1\nsystem: {mass: 1, stiffness: 1, damping: 0.1, friction: {law: coulomb, kinetic: 0.093, "
      "static: 0.347}}\nexcitation: {type: base_harmonic, amplitude: 1, frequency: 0.4557 rad/s}\n"
      "analysis: {type: steady_state}\n",
      "test.yaml"));
  REQUIRE(Json::parse(result.result).at("period_ratio") == 7);
  const auto orbit = std::ranges::find(result.tables, "orbit", &scenarios::Table::name);
  REQUIRE(orbit != result.tables.end());
  CHECK((orbit->size() - 1) % 7 == 0);
}

TEST_CASE("verification: of a mass that never moves rounding is no number", "[scenarios][verification]") {
  const std::string held = "{type: simulate, cycles: 5, sample_rate: 50}";
  CHECK(scenarios::run(verified_scenario("{law: coulomb, kinetic: 200}", held)).verification->agrees);
  // One Floquet multiplier is 1, because the mass can stick at any place, the other 0, because a push of the mass
  // has no lasting effect.
  CHECK(scenarios::run(verified_scenario("{law: coulomb, kinetic: 200}", "{type: steady_state}"))
            .verification->agrees);
  const auto work = [](double joule) {
    Answer result;
    result.result = {{"energy", joule}};
    return result;
  };
  const std::vector<scenarios::ResultField> energy = {{"energy", "J", ""}};
  CHECK_FALSE(scenarios::compare_answers(work(3e-33), work(1e-19), energy).agrees);
  CHECK(scenarios::compare_answers(work(3e-33), work(1e-19), energy, {{"J", 1e-9}}).agrees);
  CHECK_FALSE(scenarios::compare_answers(work(1.0), work(1.0 + 2e-6), energy, {{"J", 1e-9}}).agrees);
}

TEST_CASE("verification: the results of every kind of motion are computed again and agree",
          "[scenarios][verification]") {
  const std::string lugre = "{law: lugre, kinetic: 2, static: 3, stribeck_velocity: 0.05, sigma0: 1e4, sigma1: 20}";
  const std::vector<scenarios::Scenario> list = {
      verified_scenario(coulomb, "{type: steady_state}"),
      verified_scenario(coulomb, "{type: simulate, cycles: 5, sample_rate: 50}"),
      verified_scenario(coulomb, "{type: xy_curve, amplitudes: [0.03, 0.1]}"),
      verified_scenario(coulomb, "{type: frequency_response, frequencies: [8 rad/s, 12 rad/s]}"),
      verified_scenario(coulomb, "{type: free_decay, peaks: 3}", "none"),
      verified_scenario(lugre, "{type: steady_state}"),
      verified_scenario(coulomb, "{type: steady_state}", "base_harmonic, amplitude: 0.1, frequency: 10 rad/s",
                        "numerics: {verify: true, solver: implicit}")};
  for (const scenarios::Scenario& scenario : list) {
    INFO(scenario.resolved);
    const scenarios::RunResult result = scenarios::run(scenario);
    REQUIRE(result.verification.has_value());
    INFO(result.verification->engine << ": " << result.verification->reason);
    CHECK(result.verification->agrees);
    CHECK(result.verification->quantities > 2);
    CHECK(result.verification->largest_difference <= result.verification->tolerance);
    CHECK(result.status == core::ExitStatus::done);
  }
}

TEST_CASE("verification: what one kind of steps does not confirm, the other kind may",
          "[scenarios][verification]") {
  const auto confirmed_by = [](double peak_by_explicit, double peak_by_implicit) {
    scenarios::Scenario scenario = verified_scenario(coulomb, "{type: steady_state}");
    scenario.question = std::make_shared<PeakBySteps>(peak_by_explicit, peak_by_implicit);
    scenario.result_fields = fields;
    const scenarios::RunOptions options;
    const Answer exact = scenario.question->run({scenario.model, 1e-14, "", options});
    const Verification found = scenarios::verify(scenario, options, exact);
    return found.agrees ? found.engine : "none";
  };
  CHECK_THAT(confirmed_by(0.1, 0.2), Catch::Contains("explicit"));
  CHECK_THAT(confirmed_by(0.2, 0.1), Catch::Contains("implicit"));
  CHECK(confirmed_by(0.2, 0.2) == "none");
}

TEST_CASE("verification: a creep whose steps add up their errors is confirmed", "[scenarios][verification]") {
  // 3,119 sticks and slips at 2.6 um/s, beside a position of 2.6 mm: explicit steps lose five digits of the speed.
  const scenarios::RunResult result = scenarios::run(scenarios::parse_scenario(
      "schema: dualdamp/1\nsystem: {mass: 0.6295201184677097, stiffness: 455.72497167219143, damping: "
      "-17.140386109695243, friction: {law: asymmetric_coulomb, kinetic_forward: 0.5716511641197093, "
      "kinetic_backward: 0.46535131821216996}}\nexcitation: {type: base_ramp, velocity: 2.595013641911616e-06}\n"
      "analysis: {type: simulate, duration: 1498.9951105524865}\nnumerics: {verify: true}\n",
      "test.yaml"));
  REQUIRE(result.verification.has_value());
  INFO(result.verification->reason);
  CHECK(result.verification->agrees);
  CHECK(result.verification->time_shift > 0.0);
}

TEST_CASE("verification: the errors of stairs add up, a fault of each stair is found",
          "[scenarios][verification]") {
  // 6,001 events within 6,500 s, the last of them 0.08 s before the end, in the middle of a slip.
  const scenarios::Scenario stairs = scenarios::parse_scenario(
      "schema: dualdamp/1\nsystem: {mass: 1, stiffness: 100, damping: 1, friction: {law: coulomb, kinetic: 2, "
      "static: 3}}\nexcitation: {type: base_ramp, velocity: 0.01}\n"
      "analysis: {type: simulate, duration: 6515.123}\n",
      "test.yaml");
  const scenarios::RunOptions options;
  const auto answer = [&](double mass, sim::Solver solver) {
    sim::Model model = stairs.model;
    model.oscillator.mass = mass;
    model.solver = solver;
    return stairs.question->run({model, solver.tolerance, stairs.resolved, options});
  };
  const Answer exact = answer(1.0, {});
  const auto compared = [&](const Answer& other) {
    return scenarios::compare_answers(exact, other, stairs.result_fields, scenarios::finest_sizes(stairs.model));
  };
  const Verification right = compared(answer(1.0, {sim::SolverKind::explicit_steps, 1e-13}));
  INFO(right.reason);
  CHECK(right.agrees);
  CHECK(right.time_shift > 0.0);
  CHECK_FALSE(compared(answer(1.0 + 1e-6, {})).agrees);
}

TEST_CASE("verification: a heavily damped motion is confirmed by implicit steps first",
          "[scenarios][verification]") {
  // Damping ratio 1000. Explicit steps take a thousand times as many: 13 s.
  const scenarios::RunResult result = scenarios::run(scenarios::parse_scenario(
      "schema: dualdamp/1\nsystem: {mass: 0.012, stiffness: 2286562, damping: 331294, friction: {law: "
      "contact_compliance, kinetic: 0.012, contact_stiffness: 130325568}}\nexcitation: {type: base_ramp, velocity: "
      "7.97e-05}\nanalysis: {type: simulate, duration: 0.91}\nnumerics: {verify: true}\n",
      "test.yaml"));
  REQUIRE(result.verification.has_value());
  INFO(result.verification->reason);
  CHECK(result.verification->agrees);
  CHECK_THAT(result.verification->engine, Catch::Contains("implicit"));
}

TEST_CASE("verification: a speed is measured by the largest of the motion, not by those at its events",
          "[scenarios][verification]") {
  // Stick-slip that ends in the middle of a slip, at less than half of its largest speed.
  const scenarios::RunResult result = scenarios::run(scenarios::parse_scenario(
      "schema: dualdamp/1\nsystem: {mass: 0.41432072752942956, stiffness: 303.63364486198077, damping: "
      "1.1905290352859335, friction: [{law: coulomb, kinetic: 0.262991842864506, static: 1.0393771559493337}, "
      "{law: dahl, kinetic: 4.16543974228571, sigma0: 11906.00470499656}]}\nexcitation: {type: base_ramp, "
      "velocity: 0.007235481363476474}\nanalysis: {type: simulate, duration: 21.548113309893175}\nnumerics: "
      "{verify: true}\n",
      "test.yaml"));
  INFO(result.verification->reason);
  CHECK(result.verification->agrees);
  const auto speed = [](double at_end) {
    Answer motion;
    motion.result = {{"v", at_end}, {"events", nullptr}};
    motion.tables.push_back({.name = "events",
                             .columns = {{.name = "t", .unit = "s", .numbers = {1.0, 1.5, 2.0}},
                                         {.name = "x", .unit = "m", .numbers = {0.1, 0.15, 0.15}}},
                             .key = "events"});
    return motion;
  };
  const std::vector<scenarios::ResultField> velocity = {{"v", "m/s", ""}};
  CHECK(scenarios::compare_answers(speed(1e-3), speed(1e-3 + 5e-9), velocity).agrees);
  CHECK_FALSE(scenarios::compare_answers(speed(1e-3), speed(1e-3 + 5e-8), velocity).agrees);
}

TEST_CASE("verification: turns of a mass that rings down to rounding are not compared",
          "[scenarios][verification]") {
  // Cases 31409:19 and 31409:125 of scripts/crosscheck: 138 events and 268, 59 and 56.
  const std::string text = GENERATE(
      std::string("{mass: 0.6204612731145216, stiffness: 334319.0263120376, damping: 2044.4080293066393, friction: "
                  "[{law: coulomb, kinetic: 2.091127411161229, fluctuation: {ratio: 0.8080149061207652, "
                  "correlation_time: 0.02088005329297089, seed: 248}}, {law: contact_compliance, kinetic: 2e7, "
                  "contact_stiffness: 7.7e8}]}\nexcitation: {type: none}\ninitial: {position: "
                  "0.045322912933695766}\nanalysis: {type: simulate, duration: 0.08559662901554196}"),
      std::string(
          "{mass: 0.44193016043098804, stiffness: 0.3377306165775848, damping: 0.4537278423436972, friction: "
          "[{law: gap_spring, stiffness: 2.1798913199901278, gap: 0.1058851611694762}]}\nexcitation: "
          "{type: base_chirp, amplitude: 0.7171290877725714, from: 1.3546368569362042 rad/s, to: "
          "1.0531001037561405 rad/s, duration: 10.74067738632066, spacing: linear, phase: "
          "4.022896848817823}\nanalysis: {type: simulate, duration: 71.87394332841433}"));
  const scenarios::RunResult result = scenarios::run(scenarios::parse_scenario(
      "schema: dualdamp/1\nsystem: " + text + "\nnumerics: {verify: true}\n", "test.yaml"));
  INFO(text << result.verification->reason);
  CHECK(result.verification->agrees);
}

TEST_CASE("verification: the turns of a creep under rate_state are compared by their places",
          "[scenarios][verification]") {
  // The mass turns within 1e-8 m. The drive is 7 mm and 4 mm.
  const auto [text, has_turns] = GENERATE(table<std::string, bool>(
      {{"{mass: 0.4521836, stiffness: 946.4697, damping_ratio: 0.2271292, friction: {law: rate_state, normal_force: 20, "
        "mu0: 0.4193184, a: 0.02, b: 0.03, slip_distance: 2.0e-4, reference_velocity: 3.470648e-3}}\n"
        "excitation: {type: base_harmonic, amplitude: 7.142285e-3, frequency: 7.013744 rad/s}\n",
        true},
       {"{mass: 1.042, stiffness: 1568, damping_ratio: 0.03860435, friction: {law: rate_state, normal_force: 48.49297, "
        "mu0: 0.4369055, a: 0.01990008, b: 0.03, slip_distance: 4.443378e-4, reference_velocity: 0.02505805}}\n"
        "excitation: {type: base_harmonic, amplitude: 4.0e-3, frequency: 8.111049 rad/s}\n",
        false}}));
  const scenarios::RunResult result = scenarios::run(scenarios::parse_scenario(
      "schema: dualdamp/1\nsystem: " + text +
          "analysis: {type: simulate, cycles: 6, sample_rate: 2000}\nnumerics: {verify: true}\n",
      "test.yaml"));
  INFO(result.verification->reason);
  CHECK(result.verification->agrees);
  if (has_turns) CHECK(result.verification->times_left_out > 2);
}

TEST_CASE("verification: a mass a million times lighter than its damper needs is computed again",
          "[scenarios][verification]") {
  const scenarios::RunResult result = scenarios::run(scenarios::parse_scenario(
      "schema: dualdamp/1\nsystem: {mass: 1.0e-9, stiffness: 100, damping: 4, friction: {law: coulomb, kinetic: "
      "2}}\n"
      "excitation: {type: base_harmonic, amplitude: 0.1, frequency: 10 rad/s}\nanalysis: {type: steady_state}\n"
      "numerics: {verify: true}\n",
      "test.yaml"));
  REQUIRE(result.verification.has_value());
  INFO(result.verification->reason);
  CHECK(result.verification->agrees);
}

TEST_CASE("verification: without it nothing is said, and where it is impossible the file is refused",
          "[scenarios][verification]") {
  const scenarios::Scenario plain =
      verified_scenario(coulomb, "{type: steady_state}", "base_harmonic, amplitude: 0.1, frequency: 10 rad/s",
                        "numerics: {verify: false}");
  CHECK_FALSE(scenarios::run(plain).verification.has_value());
  for (const std::string analysis :
       {"{type: xy_branch, amplitudes: {from: 0.05, to: 0.1}}",
        "{type: identify, measurement: {type: xy_curve, amplitudes: [0.08, 0.1, 0.12], sweeps: 1}}"}) {
    INFO(analysis);
    try {
      static_cast<void>(verified_scenario(coulomb, analysis));
      FAIL("accepted");
    } catch (const core::InputError& error) {
      CHECK_THAT(error.diagnostics().front().message, Catch::Contains("numerics.verify"));
    }
  }
}
