#include "scenarios/analyses/identify.hpp"

#include <catch2/catch.hpp>

#include "tests/scenarios/answers.hpp"

using namespace dualdamp;
using testing::answer_to;

TEST_CASE("identify: an exact method finds the friction of the simulated system", "[scenarios][identify]") {
  const auto answer = answer_to(
      "{type: identify, measurement: {type: xy_curve, amplitudes: {from: 0.1 m, to: 0.6 m, count: 6}}, "
      "methods: [den_hartog_fit]}");
  const auto& estimate = answer.at("estimates").at(0);
  CHECK(estimate.at("c").get<double>() == Approx(4.0).epsilon(1e-9));
  CHECK(estimate.at("F0").get<double>() == Approx(2.0).epsilon(1e-9));
  CHECK(estimate.at("usable") == true);
}

TEST_CASE("identify: stated uncertainties of constants are in the intervals", "[scenarios][identify]") {
  const std::string analysis =
      "{type: identify, measurement: {type: xy_curve, amplitudes: {from: 0.1 m, to: 0.6 m, count: 6}}, "
      "sensors: {x: {noise: 1 mm}, seed: 1}, methods: [resonance_least_squares]";
  const auto std_of = [](const nlohmann::json& answer, const char* name) {
    return answer.at("estimates").at(0).at("std").at(name).get<double>();
  };
  // x_f follows from the line x(Y) at resonance, where F0 = k x_f; the gains multiply x_f.
  const auto exact = answer_to(analysis + "}");
  const auto gains = answer_to(analysis + ", gain_uncertainty: {x: 3 %, y: 3 %}}");
  CHECK(std_of(gains, "F0") > std_of(exact, "F0"));
  const std::string system =
      "schema: dualdamp/1\n"
      "system: {mass: 1 kg +- 2 g, stiffness: 100 N/m ± 2 %, damping: 4 N.s/m, friction: {law: coulomb, kinetic: 2 "
      "N}}\n"
      "excitation: {type: base_harmonic, amplitude: 0.1 m, frequency: 10 rad/s ± 0.01}\nanalysis: ";
  const auto scenario = scenarios::parse_scenario(system + analysis + "}\n", "test.yaml");
  const auto resolved = nlohmann::json::parse(scenario.resolved);
  CHECK(resolved.at("system").at("mass_uncertainty").get<double>() == Approx(0.002));
  CHECK(resolved.at("system").at("stiffness_uncertainty").get<double>() == Approx(2.0));
  CHECK(resolved.at("excitation").at("frequency_uncertainty") == "0.01 rad/s");
  CHECK(std_of(testing::result_of(scenarios::run(scenario)), "F0") > std_of(exact, "F0"));
}
