#include "identify/records/repeats.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace dualdamp::identify;

namespace {

History history(double factor = 1.0) {
  History test{.sample_rate = 100.0};
  for (int i = 0; i < 100; ++i) {
    test.x.push_back(factor * std::sin(0.1 * i));
    test.force.push_back(3.0 * std::cos(0.1 * i));
  }
  return test;
}

Record with(std::vector<History> histories) {
  Record record;
  record.histories = std::move(histories);
  return record;
}

}  // namespace

TEST_CASE("repeats: the same readings in two records, whatever the units and the length of their files") {
  CHECK(share_readings(with({history()}), with({history()}), false));
  // Millimetres that were metres before.
  CHECK(share_readings(with({history()}), with({history(1.0 + 1e-12)}), false));
  CHECK(share_readings(with({history(2.0), history()}), with({history()}), false));
  CHECK_FALSE(share_readings(with({history()}), with({history(1.001)}), false));
  // A loop compares the force, which is the same here.
  CHECK(share_readings(with({history()}), with({history(2.0)}), true));
  // A signal that never moves is no reading.
  History still = history();
  still.x.assign(100, 0.0);
  CHECK_FALSE(share_readings(with({still}), with({still}), false));
}

TEST_CASE("repeats: what stands in a record twice is told") {
  CHECK(repeated_readings(with({history(), history(2.0)})).empty());
  History first = history();
  first.sweep = "a";
  History again = history();
  again.sweep = "b";
  const std::vector<std::string> warnings = repeated_readings(with({first, again}));
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings.front(), Catch::StartsWith("tests 'a' and 'b' hold the same samples"));

  Record pairs;
  pairs.pairs = PairRecord{{{.Y = 1e-3, .x = 2e-3, .number = 1, .omega = 10.0},
                            {.Y = 2e-3, .x = 5e-3, .number = 2, .omega = 10.0},
                            {.Y = 1e-3, .x = 2e-3, .number = 3, .omega = 11.0}}};
  CHECK(repeated_readings(pairs).empty());
  pairs.pairs->pairs.push_back({.Y = 1e-3, .x = 2e-3, .number = 4, .omega = 10.0});
  const std::vector<std::string> told = repeated_readings(pairs);
  REQUIRE(told.size() == 1);
  CHECK_THAT(told.front(), Catch::Contains("4 that of 1"));
}
