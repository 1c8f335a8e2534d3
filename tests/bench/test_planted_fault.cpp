/// A law whose exact form differs from its force: the campaign and the verification of a run both find it. This is
/// a separate program, because the law is registered for the whole process.

#include <catch2/catch.hpp>
#include <memory>
#include <sstream>

#include "bench/crosscheck/case.hpp"
#include "scenarios/output.hpp"
#include "scenarios/run.hpp"
#include "tests/support/crooked_law.hpp"

using namespace dualdamp;
using scenarios::Json;

namespace {

const std::string file = R"(schema: dualdamp/1
system: {mass: 1, stiffness: 100, damping: 4, friction: [{law: crooked, kinetic: 2}]}
excitation: {type: base_harmonic, amplitude: 0.1, frequency: 10 rad/s}
analysis: {type: steady_state}
numerics: {verify: true}
)";

}  // namespace

TEST_CASE("planted fault: a run that is verified ends with status 1, and the document says why", "[verification]") {
  test::add_crooked_law();
  const scenarios::Scenario scenario = scenarios::parse_scenario(file, "planted.yaml");
  const scenarios::RunResult result = scenarios::run(scenario);
  CHECK(result.status == core::ExitStatus::check_failed);
  std::ostringstream text;
  scenarios::json_document(std::make_shared<scenarios::Scenario>(scenario),
                           std::make_shared<scenarios::RunResult>(result))(text);
  const Json document = Json::parse(text.str());
  CHECK(document.at("status") == 1);
  const Json& verification = document.at("verification");
  CHECK(verification.at("agrees") == false);
  CHECK(verification.at("largest_difference").get<double>() > 1e-5);
  CHECK_FALSE(verification.at("quantity").get<std::string>().empty());
  CHECK_THAT(verification.at("engine").get<std::string>(), Catch::Contains("smooth engine"));
}

TEST_CASE("planted fault: the campaign finds it", "[crosscheck]") {
  test::add_crooked_law();
  const Json law = {{"law", "crooked"}, {"kinetic", 2.0}};
  const Json scenario = {
      {"schema", "dualdamp/1"},
      {"system", {{"mass", 1.0}, {"stiffness", 100.0}, {"damping", 4.0}, {"friction", Json::array({law})}}},
      {"excitation", {{"type", "base_harmonic"}, {"amplitude", 0.1}, {"frequency", "10.0 rad/s"}}},
      {"analysis", {{"type", "steady_state"}}}};
  const crosscheck::CaseReport report = crosscheck::check_case(scenario, 1, 1);
  CHECK(report.verdict() == crosscheck::Verdict::disagree);
}
