// The composed list of analyses: the analyses that a file may ask for depend on the list alone, and abilities are
// detected.
#include "bench/analyses.hpp"

#include <catch2/catch.hpp>
#include <set>
#include <string>

#include "core/diagnostics.hpp"
#include "scenarios/scenario.hpp"

using namespace dualdamp;

namespace {

const std::string system_text =
    "schema: dualdamp/1\nsystem: {mass: 1, stiffness: 100, damping: 2, friction: {law: coulomb, kinetic: 2}}\n"
    "excitation: {type: base_harmonic, amplitude: 0.1, frequency: natural}\n";

const std::string stress_test =
    system_text +
    "analysis: {type: stress_test, severities: [0.1], ranges: [{name: low, amplitudes: [0.1, 0.2]}]}\n";

scenarios::Scenario parsed(const std::string& text) {
  return scenarios::parse_scenario(text, "test", {.analyses = bench::analyses()});
}

bool is_campaign(const std::string& text) {
  return dynamic_cast<const scenarios::Campaign*>(parsed(text).question.get()) != nullptr;
}

}  // namespace

TEST_CASE("analyses: the list holds each once, with all that the contract asks for") {
  std::set<std::string> names;
  for (const scenarios::Analysis* analysis : bench::analyses()) {
    CAPTURE(std::string(analysis->name));
    CHECK(names.emplace(analysis->name).second);
    CHECK_FALSE(analysis->summary.empty());
    CHECK_FALSE(analysis->needs.empty());
    CHECK(analysis->ask != nullptr);
  }
  for (const scenarios::Analysis* analysis : scenarios::analyses())
    CHECK(names.contains(std::string(analysis->name)));
  CHECK(names.size() == scenarios::analyses().size() + 2);
}

TEST_CASE("analyses: a file may ask for what the list has, and for nothing else") {
  CHECK_NOTHROW(parsed(stress_test));
  CHECK_THROWS_AS(scenarios::parse_scenario(stress_test, "test"), core::InputError);
}

TEST_CASE("analyses: only a long run is a campaign") {
  CHECK(is_campaign(stress_test));
  CHECK_FALSE(is_campaign(system_text + "analysis: {type: steady_state}\n"));
  CHECK_FALSE(
      is_campaign("schema: dualdamp/1\nanalysis: {type: formula, formula: {name: friction_force, stiffness: 100, "
                  "x_f: [0.01]}}\n"));
}

TEST_CASE(
    "analyses: an expected point of a branch is checked after the run, since the number of points is not known") {
  CHECK_NOTHROW(parsed(system_text + "analysis: {type: frequency_branch, frequencies: {from: 1 Hz, to: 2 Hz}}\n"
                                     "expect: [{value: 'points[7].x', equals: 1}]\n"));
}

TEST_CASE("analyses: a stress test has ten million cases at most, with those of the truth") {
  const auto asked = [](int severities) {
    return system_text +
           "analysis: {type: stress_test, laws: [detuning], seeds: 1000000, severities: {from: 0.01, to: 0.1, count: " +
           std::to_string(severities) + "}, ranges: [{name: low, amplitudes: [0.1, 0.2]}]}\n";
  };
  CHECK_NOTHROW(parsed(asked(9)));  // the truth and nine severities of one law, a million times
  try {
    static_cast<void>(parsed(asked(10)));
    FAIL("too many cases were not refused");
  } catch (const core::InputError& error) {
    CHECK(error.diagnostics().front().message == "the stress test has too many cases");
    CHECK(error.diagnostics().front().found == "11000000");
  }
}
