#include "scenarios/analyses/predict.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
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
           "coulomb, kinetic: " +
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
  // The same numbers, of which the fit determines nothing.
  const scenarios::RunResult open =
      scenarios::run(parse_scenario(text("1.2 N", "covariance: [1e-6], undetermined: [1]"), "test.yaml"));
  REQUIRE(open.failure.empty());
  const nlohmann::json left = testing::result_of(open).at("validation");
  CHECK(left.at("compromise").at("freedom") == 0.0);
  CHECK(left.at("uncertainty").is_null());
  CHECK(left.at("wrong") == false);
  std::remove(file.c_str());
}

TEST_CASE("predict: steady states, of which nothing is free", "[scenarios][predict]") {
  const std::string file = "predict_pairs.csv";
  {
    // At resonance of zeta 0.05 and x_f 1 mm, x = (Y - 4/pi x_f)/(2 zeta) nearly.
    std::ofstream out(file);
    out << "Y [mm],x [mm]\n4,27.27\n5,37.27\n6,47.27\n7,57.27\n";
  }
  const scenarios::RunResult result = scenarios::run(parse_scenario(
      "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m, damping: 3.1623 N.s/m, friction: "
      "{law: coulomb, kinetic: 1 N}}\nexcitation: {type: base_harmonic, frequency: natural}\n"
      "analysis: {type: predict, data: predict_pairs.csv, free: kinetic, covariance: [1e-4]}\n",
      "test.yaml"));
  REQUIRE(result.failure.empty());
  const nlohmann::json validation = testing::result_of(result).at("validation");
  CHECK(validation.at("error").get<double>() < 0.01);
  std::remove(file.c_str());
}

TEST_CASE("predict: what pairs lack is told with what states it", "[scenarios][predict]") {
  const auto fault_of = [](const std::string& columns) -> std::string {
    const std::string file = "predict_lacking.csv";
    {
      std::ofstream out(file);
      out << columns << "\n4,27.27\n5,37.27\n6,47.27\n7,57.27\n";
    }
    std::string text;
    try {
      static_cast<void>(parse_scenario(
          "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m, damping: 3 N.s/m, friction: {law: coulomb, "
          "kinetic: 1 N}}\nanalysis: {type: predict, data: " +
              file + "}\n",
          "test.yaml"));
    } catch (const core::InputError& error) {
      text = error.what();
    }
    std::remove(file.c_str());
    return text;
  };
  CHECK_THAT(fault_of("Y [mm],x [mm]"), Catch::Contains("forcing frequency") && Catch::Contains("omega"));
  CHECK_THAT(fault_of("Y [N],x [mm]"),
             Catch::Contains("amplitude of a driving force") && Catch::Contains("force_harmonic"));
}

TEST_CASE("predict: a drive that the file holds and the model lacks", "[scenarios][predict]") {
  const std::string file = "predict_driven.csv";
  {
    std::ofstream out(file);
    out << "t [s],y [mm],x [mm]\n";
    for (int i = 0; i < 200; ++i)
      out << 0.01 * i << ',' << std::cos(0.3 * i) << ',' << 5.0 * std::sin(0.3 * i) << '\n';
  }
  const std::string system =
      "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m, damping: 3 N.s/m, friction: {law: coulomb, "
      "kinetic: 1 N}}\n";
  const std::string none = "excitation: {type: none}\n";
  const auto fault_of = [](const std::string& text) -> std::string {
    try {
      static_cast<void>(scenarios::run(parse_scenario(text, "a.yaml")));
    } catch (const core::InputError& error) {
      return error.what();
    }
    return {};
  };
  const std::string lacks = "nothing drives the model";
  CHECK(fault_of(system + none + "analysis: {type: predict, data: " + file + "}\n").find(lacks) !=
        std::string::npos);
  CHECK(fault_of("schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m, friction: {law: coulomb}}\n" +
                 none + "analysis: {type: fit, data: " + file + "}\n")
            .find(lacks) != std::string::npos);
  // The same readings must not count twice, and must not predict themselves.
  const std::string fit =
      "schema: dualdamp/1\nsystem: {mass: 1 kg, stiffness: 1000 N/m, friction: {law: coulomb}}\nexcitation: {type: "
      "measured_base, file: " +
      file + ", column: y}\nanalysis: {type: fit, ";
  CHECK_NOTHROW(parse_scenario(fit + "data: " + file + "}\n", "d.yaml"));
  CHECK_THROWS_AS(parse_scenario(fit + "data: [" + file + ", " + file + "]}\n", "e.yaml"), core::InputError);
  CHECK_THROWS_AS(parse_scenario(fit + "data: " + file + ", validate: " + file + "}\n", "f.yaml"),
                  core::InputError);
  // The error of straight lines between 21 samples in a period is 0.75 %.
  const scenarios::RunResult lines =
      scenarios::run(parse_scenario(system + "excitation: {type: measured_base, file: " + file +
                                        ", column: y}\nanalysis: {type: predict, data: " + file + "}\n",
                                    "c.yaml"));
  REQUIRE(lines.failure.empty());
  const auto& warnings = lines.warnings;
  CHECK(std::ranges::any_of(
      warnings, [](const std::string& w) { return w.find("interpolation: cubic") != std::string::npos; }));
  std::remove(file.c_str());
}
