#include "identify/outliers/outliers.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "identify/methods/amplitudes/resonance_least_squares.hpp"
#include "identify/methods/decays/free_decay.hpp"
#include "tests/identify/ledger/laboratory.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr std::uint64_t outlier_seed = 300;

/// Root mean square of the relative errors of F0 over some records.
double error_of_F0(bool spoilt, bool robust) {
  constexpr int records = 20;
  double squares = 0.0;
  for (int i = 0; i < records; ++i) {
    Measured m = measured(Kind::extremes, outlier_seed + static_cast<std::uint64_t>(i));
    if (spoilt) m.record.decay->extremes[2] *= 1.2;
    const Record record = robust ? bounded_influence(m.record, m.constants).record : m.record;
    const Estimate estimate = free_decay(record, m.constants, {});
    REQUIRE(estimate.outcome.ok());
    squares += std::pow(estimate.value.F0 / m.rig.F0 - 1.0, 2);
  }
  return std::sqrt(squares / records);
}

}  // namespace

TEST_CASE("A reading that does not belong to the others is named and hardly counts") {
  for (const Kind kind : {Kind::xy, Kind::xy_phase, Kind::response}) {
    CAPTURE(name_of(kind));
    Measured m = measured(kind, outlier_seed);
    Pair& spoilt = m.record.pairs->pairs[5];
    spoilt.x *= 1.2;
    const BoundedInfluence bounded = bounded_influence(m.record, m.constants);
    REQUIRE_FALSE(bounded.outliers.empty());
    const std::string name = "x of pair " + std::to_string(spoilt.number);
    const auto named = std::ranges::find(bounded.outliers, name, &Outlier::reading);
    REQUIRE(named != bounded.outliers.end());
    CHECK(named->deviations > 4.0);
    CHECK(named->weight == Approx(2.0 / named->deviations));
    CHECK(bounded.record.pairs->pairs[5].x < 1.1 * spoilt.x / 1.2);
    CHECK(bounded.within < 1.0);
  }
}

TEST_CASE("Readings that belong to each other are no outliers but by chance") {
  int outliers = 0;
  for (std::uint64_t seed = outlier_seed; seed < outlier_seed + 10; ++seed)
    for (const Kind kind : {Kind::xy, Kind::response, Kind::extremes}) {
      const Measured m = measured(kind, seed);
      outliers += static_cast<int>(bounded_influence(m.record, m.constants).outliers.size());
    }
  // One normal reading in 16,000 lies beyond four deviations; the median of few readings adds some.
  CHECK(outliers <= 6);
}

TEST_CASE("Bounded influence keeps the estimate of a spoilt decay near that of a sound one") {
  const double sound = error_of_F0(false, false);
  const double sound_robust = error_of_F0(false, true);
  const double spoilt = error_of_F0(true, false);
  const double spoilt_robust = error_of_F0(true, true);
  CAPTURE(sound, sound_robust, spoilt, spoilt_robust);
  CHECK(sound_robust < 1.5 * sound);
  CHECK(spoilt > 5.0 * sound);
  CHECK(spoilt_robust < 3.0 * sound);
}
