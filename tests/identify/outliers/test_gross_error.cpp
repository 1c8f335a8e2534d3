#include "identify/outliers/gross_error.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "identify/outliers/outliers.hpp"
#include "tests/identify/ledger/laboratory.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr std::uint64_t first_seed = 700;

/// Five readings at resonance, as typed from a notebook [mm].
Record five_pairs() {
  constexpr double milli = 1e-3;
  Record record;
  record.pairs.emplace();
  const double Y[] = {4.5, 5.0, 5.5, 6.0, 6.5};
  const double x[] = {4.70, 7.21, 9.76, 12.25, 14.82};
  for (int i = 0; i < 5; ++i)
    record.pairs->pairs.push_back({.Y = milli * Y[i], .x = milli * x[i], .number = i + 1});
  return record;
}

constexpr KnownConstants rig = {1.042, 1568.0, 2.0 * M_PI * 6.17};

}  // namespace

TEST_CASE("A wrong digit in one of five readings is found, whichever it is, and bounded influence leaves it out") {
  CHECK_FALSE(gross_error(five_pairs(), rig));
  for (std::size_t few : {0, 1, 2, 3}) {
    Record record = five_pairs();
    record.pairs->pairs.resize(few);
    CHECK_FALSE(gross_error(record, rig));
    record = {};
    record.decay.emplace();
    record.decay->extremes.assign(few, 1e-3);
    CHECK_FALSE(gross_error(record, rig));
  }
  for (const double factor : {0.1, 10.0, 100.0, 1000.0})
    for (std::size_t i = 0; i < 5; ++i) {
      CAPTURE(factor, i);
      Record record = five_pairs();
      const double truth = record.pairs->pairs[i].x;
      record.pairs->pairs[i].x *= factor;
      const auto found = gross_error(record, rig);
      REQUIRE(found);
      CHECK(found->reading.number == static_cast<int>(i) + 1);
      CHECK(found->expected == Approx(truth).epsilon(0.02));
      const BoundedInfluence bounded = bounded_influence(record, rig);
      CHECK(bounded.record.pairs->pairs[i].x == Approx(truth).epsilon(0.02));
      CHECK(bounded.outliers.size() == 1);
    }
}

TEST_CASE("Readings of Coulomb and viscous friction, and of departures from it, have no gross error") {
  for (std::uint64_t seed = first_seed; seed < first_seed + 2; ++seed)
    for (const Kind kind : {Kind::xy, Kind::xy_phase, Kind::response, Kind::extremes}) {
      CAPTURE(name_of(kind), seed);
      for (void (*alter)(Rig&) : {+[](Rig&) {}, +[](Rig& r) { r.drag = 1.0; }, +[](Rig& r) { r.cubic = 0.06; }}) {
        const Measured m = measured(kind, seed, alter);
        CHECK_FALSE(bounded_influence(m.record, m.constants).gross);
      }
    }
}

TEST_CASE("A wrong digit among many readings is found beside the noise of the others") {
  for (const Kind kind : {Kind::xy, Kind::response, Kind::extremes}) {
    CAPTURE(name_of(kind));
    Measured m = measured(kind, first_seed);
    double& spoilt = m.record.pairs ? m.record.pairs->pairs[5].x : m.record.decay->extremes[3];
    const double truth = spoilt;
    spoilt *= kind == Kind::extremes ? 0.1 : 10.0;
    const auto found = bounded_influence(m.record, m.constants).gross;
    REQUIRE(found);
    CHECK(found->value == spoilt);
    CHECK(found->expected == Approx(truth).epsilon(0.1));
  }
}
