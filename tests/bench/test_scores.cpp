// Scores of a grid written by hand.

#include "bench/scores.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

using namespace dualdamp;

namespace {

/// Two severities of one law, two seeds, two methods.
bench::StressTest question() {
  bench::StressTest result;
  result.F0 = 10.0;
  result.laws = {bench::find_departure("dahl")};
  result.severities = {0.01, 0.1};
  result.ranges = {{"low", {0.1, 0.2}, {10.0}}};
  result.sensors = {{"perfect", {}}};
  result.seeds = 2;
  result.methods = {identify::find_method("resonance_least_squares"), identify::find_method("resonance_two_point")};
  return result;
}

std::string estimate(double zeta, double F0, bool has_diagnostic) {
  const auto around = [](double value) {
    return "[" + std::to_string(0.99 * value) + "," + std::to_string(1.01 * value) + "]";
  };
  return R"({"method":"m","zeta":)" + std::to_string(zeta) + R"(,"F0":)" + std::to_string(F0) + R"(,"zeta95":)" +
         around(zeta) + R"(,"F095":)" + around(F0) + R"(,"usable":)" + (has_diagnostic ? "false" : "true") +
         R"(,"fired":false})";
}

}  // namespace

TEST_CASE("scores: bias, coverage, what was wrong and what was detected, and where a method breaks down") {
  const std::string none = R"({"method":"m","reason":"no estimate"})";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {estimate(0.1, 10.0, false), estimate(0.1, 10.0, true)},  // the truth: the second is a false alarm
      {estimate(0.1, 10.05, false), estimate(0.1, 10.0, false)},
      {estimate(0.1, 10.2, false), estimate(0.1, 9.0, true)},  // 0.01
      {estimate(0.1, 10.2, false), estimate(0.1, 9.0, false)},
      {estimate(0.1, 13.0, false), none},  // 0.1
      {estimate(0.1, 13.0, true), none}};
  const auto path = std::filesystem::temp_directory_path() / ("dualdamp-scores-" + std::to_string(::getpid()));
  {
    std::ofstream file(path);
    file << "{\"campaign\":\"\"}\n";
    for (std::size_t i = 0; i < cases.size(); ++i)
      file << "{\"case\":" << i << ",\"estimates\":[" << cases[i].first << "," << cases[i].second << "]}\n";
  }
  const bench::StressTest asked = question();
  const bench::Grid grid(asked);
  REQUIRE(grid.cases() == 6);
  const bench::Scores scores = bench::score(path.string(), grid, 0.1, 10.0);
  std::filesystem::remove(path);

  REQUIRE(scores.scores.size() == 6);
  const bench::Score& truth = scores.scores[1];
  CHECK(truth.false_alarm == 0.5);
  CHECK(std::isnan(truth.knew));
  const bench::Score& mild = scores.scores[3];
  CHECK(mild.F0.bias == Approx(-0.1));
  CHECK(mild.F0.coverage == 0.0);
  CHECK(mild.wrong == 1.0);
  CHECK(mild.knew == 0.5);
  CHECK(scores.scores[4].knew == 0.5);
  CHECK(scores.scores[5].estimates == 0);
  CHECK(scores.scores[5].knew == 1.0);
  CHECK(scores.failed_cases == 0);

  REQUIRE(scores.breakdowns.size() == 2);
  // |error| 0.02 at 0.01 and 0.3 at 0.1: straight in the logarithms.
  CHECK(scores.breakdowns[0].F0_5 == Approx(0.01 * std::pow(10.0, std::log(0.05 / 0.02) / std::log(0.3 / 0.02))));
  CHECK(scores.breakdowns[0].F0_20 == Approx(0.01 * std::pow(10.0, std::log(0.2 / 0.02) / std::log(0.3 / 0.02))));
  CHECK(std::isinf(scores.breakdowns[0].zeta_5));
  CHECK(scores.breakdowns[1].F0_5 == Approx(0.01));
  CHECK(scores.breakdowns[1].F0_20 == Approx(0.1));

  // Each has one missed detection in four cases; of the first method, two are right without a diagnostic.
  REQUIRE(scores.ranking.size() == 2);
  CHECK(scores.ranking[0].method == 0);
  CHECK(scores.ranking[0].trusted == 0.5);
  CHECK(scores.ranking[0].unwarned == 0.25);
  CHECK(scores.ranking[0].worth == 0.25);
  CHECK(scores.ranking[1].trusted == 0.0);
  CHECK(scores.ranking[1].unwarned == 0.25);
  CHECK(scores.ranking[1].worth == -0.25);
  CHECK(scores.ranking[1].false_alarm == 0.5);
}
