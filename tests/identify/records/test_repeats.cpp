#include "identify/records/repeats.hpp"

#include <algorithm>
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

TEST_CASE("repeats: marks know readings again as the readings themselves would") {
  const auto share = [](const Record& a, const Record& b, bool are_loops) {
    return share_marks(marks_of(a, are_loops), marks_of(b, are_loops));
  };
  CHECK(share(with({history()}), with({history()}), false));
  CHECK(share(with({history(1.0 + 1e-12)}), with({history()}), false));
  CHECK(share(with({history(2.0), history()}), with({history()}), false));
  CHECK_FALSE(share(with({history(1.001)}), with({history()}), false));
  History other = history();
  other.x[40] += 1e-6;
  CHECK_FALSE(share(with({other}), with({history()}), false));
  std::ranges::reverse(other.x);
  CHECK_FALSE(share(with({other}), with({history()}), false));
  CHECK(share(with({other}), with({history()}), true));
  History still = history();
  still.x.assign(100, 0.0);
  CHECK_FALSE(share(with({still}), with({still}), false));
  const auto pairs = [](double x) {
    Record record;
    record.pairs = PairRecord{};
    for (int i = 1; i < 6; ++i) record.pairs->pairs.push_back({.Y = 0.001 * i, .x = x * i, .omega = 30.0});
    return record;
  };
  CHECK(share(pairs(0.002), pairs(0.002), false));
  // Pairs of a linear rig differ in the scale alone.
  CHECK_FALSE(share(pairs(0.002), pairs(0.003), false));
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
