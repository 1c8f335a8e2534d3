#include "identify/validate.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "identify/methods.hpp"
#include "identify/records/derived_records.hpp"
#include "identify/records/usable_histories.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

History with_lengths(std::size_t y, std::size_t x) {
  History history;
  history.sample_rate = 100.0;
  history.y.assign(y, 1.0);
  history.x.assign(x, 1.0);
  return history;
}

}  // namespace

TEST_CASE("Sound input has no faults, unknown constants are none") {
  CHECK(faults_of(pairs(table_1)).empty());
  CHECK(faults_of(table_1_constants).empty());
  CHECK(faults_of(KnownConstants{}).empty());
  CHECK(faults_of(KnownConstants{1.0, 0.0, 1.0}).empty());
  CHECK_NOTHROW(require_sound(pairs(table_1)));
  // Noise takes the reading of a small amplitude below zero.
  Record noisy = pairs(table_1);
  noisy.pairs->pairs[0].fundamental = -1e-6;
  CHECK(faults_of(noisy).empty());
}

TEST_CASE("Every fault of a record is found, with its place") {
  Record record = pairs(table_1);
  record.pairs->pairs[2].omega = -1.0;
  record.pairs->pairs[3].mean_square_speed = infinity;
  record.decay = DecayRecord{{1.0, -0.5}, {0.0}};
  record.histories = {with_lengths(10, 20), with_lengths(20, 20)};
  record.histories[1].x[3] = unknown;
  const auto faults = faults_of(record);
  REQUIRE(faults.size() == 5);
  CHECK(faults[0].message == "pair 3: the forcing frequency must be positive and finite");
  CHECK(faults[2].message == "decay: there are not as many times as extremes");
  CHECK(faults[3].message == "history 1: the signals are of different length");
  CHECK(faults[4].message == "history 2: a sample is not finite");
  CHECK_THROWS_AS(require_sound(record), core::InputError);
}

TEST_CASE("No method runs on constants that cannot be") {
  for (const MethodEntry& method : methods())
    for (const KnownConstants& constants : {KnownConstants{-1.0, 100.0, 10.0}, KnownConstants{1.0, infinity, 10.0},
                                            KnownConstants{1.0, 100.0, 0.0}}) {
      CAPTURE(method.name);
      const Estimate e = method.run(pairs(table_1), constants);
      CHECK(e.method == method.name);
      CHECK_FALSE(e.outcome.ok());
      CHECK(e.reason.find("must be") != std::string::npos);
    }
}

TEST_CASE("A method leaves out a history for the fault that the checks of a record name") {
  CHECK(fault_of(with_lengths(20, 20)).empty());
  History bad = with_lengths(20, 20);
  bad.y[3] = infinity;
  for (const History& history : {with_lengths(400, 100), bad}) {
    const auto faults = faults_of(Record{{}, {}, {history}});
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].message == "history 1: " + fault_of(history));
  }
}

TEST_CASE("A history whose signals do not belong together gives no motion, pair or decay") {
  const History bad = with_lengths(400, 100);
  CHECK_THROWS_AS(static_cast<void>(prepared_history(bad, 0.0)), core::InputError);
  CHECK(pairs_of({bad}, 10.0).record.pairs.empty());
  CHECK(decay_of(bad).record.extremes.empty());
  CHECK_THROWS_AS(ZeroPhaseFilter(60.0, 100.0), core::InputError);
  CHECK(ZeroPhaseFilter(10.0, 100.0)(std::vector<double>{}).empty());
}
