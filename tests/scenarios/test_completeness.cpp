// A number that left the range of double precision is a failure with its name, not a null.
#include "scenarios/results/completeness.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "scenarios/run.hpp"
#include "scenarios/scenario.hpp"

using namespace dualdamp;
using scenarios::Answer;
using scenarios::Json;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

scenarios::RunResult run(const std::string& system, const std::string& analysis) {
  return scenarios::run(
      scenarios::parse_scenario("schema: dualdamp/1\nsystem: " + system + "\n" + analysis, "t.yaml"));
}

}  // namespace

TEST_CASE("completeness: the first number that is not finite is named", "[scenarios][completeness]") {
  Answer answer;
  answer.result = {
      {"x", 1.0}, {"absent", nullptr}, {"energy", {{"input", 0.0}}}, {"list", Json::array({1.0, 2.0})}};
  CHECK(missing_number(answer).empty());
  answer.result["energy"]["input"] = infinity;
  CHECK(missing_number(answer) == "energy.input");
  answer.result["energy"]["input"] = 1.0;
  answer.result["list"][1] = scenarios::none;
  CHECK(missing_number(answer) == "list[1]");
  answer.result["list"][1] = Json::array({0.0, -infinity});
  CHECK(missing_number(answer) == "list[1][1]");
}

TEST_CASE("completeness: a row of a complete table lacks numbers only with a reason", "[scenarios][completeness]") {
  Answer answer;
  answer.result = {{"points", nullptr}};
  answer.tables = {
      {.name = "curve",
       .columns = {{.name = "Y", .numbers = {1.0, 2.0}}, {.name = "x", .numbers = {1.0, scenarios::none}}},
       .key = "points"}};
  CHECK(missing_number(answer).empty());  // of a table that need not be complete
  answer.tables[0].is_complete = true;
  CHECK(missing_number(answer) == "points[1].x");
  answer.tables[0].columns.push_back(
      {.name = "reason", .texts = {"", "it grows"}, .kind = scenarios::CellKind::text});
  CHECK(missing_number(answer).empty());
  answer.tables[0].columns[0].numbers[0] = infinity;
  CHECK(missing_number(answer) == "points[0].Y");
}

TEST_CASE("completeness: a cell may have a reason of its own", "[scenarios][completeness]") {
  Answer answer;
  answer.tables = {
      {.name = "curve",
       .columns = {{.name = "phase", .numbers = {1.0, scenarios::none}},
                   {.name = "x", .numbers = {1.0, 2.0}},
                   {.name = "phase_reason", .texts = {"", "at rest"}, .kind = scenarios::CellKind::text}},
       .is_complete = true}};
  CHECK(missing_number(answer).empty());
  answer.tables[0].columns[1].numbers[1] = infinity;
  CHECK(missing_number(answer) == "curve[1].x");
}

TEST_CASE("completeness: a growing mode that takes no part in a stick loses no release",
          "[scenarios][completeness]") {
  // At rest under a slow drive with a damping of -12 N.s/m: the free motion would grow by e^12000 in that time. The
  // base moves at 1e-5 m/s, so that 100 N/m reach 2 N at 2000 s.
  const std::string system =
      "{mass: 1 kg, stiffness: 100 N/m, damping: -12 N.s/m, friction: {law: coulomb, kinetic: 2 N}}";
  const std::string drive = "excitation: {type: base_ramp, velocity: 1.0e-5 m/s}\n";
  const auto before = run(system, drive + "analysis: {type: simulate, duration: 1999.9 s}");
  REQUIRE(before.status == core::ExitStatus::done);
  const Json result = Json::parse(before.result);
  CHECK(result.at("final").at("x") == 0.0);
  CHECK(result.at("energy").at("friction") == 0.0);
  const auto after = run(system, drive + "analysis: {type: simulate, duration: 2000.2 s}");
  REQUIRE(after.status == core::ExitStatus::done);
  REQUIRE(after.tables.at(0).size() > 0);
  CHECK(after.tables.at(0).columns.at(0).numbers.at(0) == Approx(2000.0).epsilon(1e-12));
}

TEST_CASE("completeness: a motion that runs away is a numerical failure", "[scenarios][completeness]") {
  // Without friction that could stop the mass: damping ratio -0.6, growth above e^708 after 118 s.
  const auto result =
      run("{mass: 1 kg, stiffness: 100 N/m, damping: -12 N.s/m, friction: {law: coulomb, kinetic: 0.1 N}}",
          "initial: {position: 1 m}\nexcitation: {type: none}\nanalysis: {type: simulate, duration: 4000 s}");
  CHECK(result.status == core::ExitStatus::numerical_failure);
  CHECK(result.failure.find("range of double precision") != std::string::npos);
}
