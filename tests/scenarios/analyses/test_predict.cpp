#include "scenarios/analyses/predict.hpp"

#include <catch2/catch.hpp>
#include <cstdio>
#include <fstream>

#include "core/diagnostics.hpp"
#include "tests/scenarios/answers.hpp"

using namespace dualdamp;
using scenarios::parse_scenario;

TEST_CASE("predict: a rig of too much friction is called wrong", "[scenarios][predict]") {
  const std::string file = "predict_decay.csv";
  {
    // x_(i+1) = -(x_i - 2 F/k): a decay under 1 N alone, to 5 um.
    std::ofstream out(file);
    out << "x [mm]\n30\n-28.005\n25.995\n-24\n22.004\n-19.996\n18.001\n-16.003\n13.998\n";
  }
  const auto text = [](const std::string& kinetic, const std::string& more) {
    return "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m, damping: 0 N.s/m, friction: {law: "
           "coulomb, "
           "kinetic: " +
           kinetic + "}}\nanalysis: {type: predict, data: predict_decay.csv, free: kinetic, " + more + "}\n";
  };
  const auto validation_of = [&](const std::string& kinetic) {
    const scenarios::RunResult result =
        scenarios::run(parse_scenario(text(kinetic, "covariance: [1e-6]"), "test.yaml"));
    REQUIRE(result.failure.empty());
    return testing::result_of(result).at("validation");
  };
  const nlohmann::json right = validation_of("1 N");
  CHECK(right.at("wrong") == false);
  const nlohmann::json wrong = validation_of("1.2 N");
  CHECK(wrong.at("wrong") == true);
  CHECK(wrong.at("error").get<double>() > 10.0 * wrong.at("attainable").get<double>());
  CHECK_THROWS_AS(parse_scenario(text("1 N", "covariance: [1e-6, 0]"), "test.yaml"), core::InputError);
  std::remove(file.c_str());
}
