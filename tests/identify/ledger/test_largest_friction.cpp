#include "identify/ledger/estimate/largest_friction.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "identify/answer/answer.hpp"
#include "tests/identify/ledger/findings.hpp"
#include "tests/identify/ledger/laboratory.hpp"
#include "tests/identify/readers/refusals.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

TEST_CASE("No record of exact friction moves less than its largest friction allows, nor hundreds of times more") {
  constexpr std::uint64_t first_seed = 8'800'000;
  for (const Kind kind :
       {Kind::xy, Kind::response, Kind::extremes, Kind::decay, Kind::forced, Kind::beat, Kind::ramp, Kind::random})
    for (std::uint64_t seed = first_seed; seed < first_seed + 3; ++seed) {
      const Measured m = measured(kind, seed);
      CAPTURE(name_of(kind), seed, m.rig.zeta, m.rig.F0);
      const LargestFriction largest = largest_friction(m.record, m.constants);
      const double c = m.rig.zeta * m.constants.critical_damping();
      CHECK(largest.F0 > m.rig.F0);
      CHECK(largest.c > c);
      CHECK(largest.F0 < 200.0 * m.rig.F0);
      CHECK(largest.c < 4.0 * m.constants.critical_damping());
    }
}

TEST_CASE("A mass that a blow has set moving may stop within less than its x_f") {
  // m x'' = -k x - F0 from x = 0 with v = V: it stops at x = (sqrt(F0^2 + k m V^2) - F0)/k, below F0/k.
  constexpr double m = 2.0;
  constexpr double k = 100.0;
  constexpr double F0 = 50.0;
  constexpr double V = 0.5;
  History history{.sample_rate = 1000.0};
  const double w = std::sqrt(k / m);
  for (double t = 0.0, x = 0.0, v = V; v > 0.0; t += 0.001) {
    history.x.push_back(x);
    x = (std::cos(w * t) - 1.0) * F0 / k + V / w * std::sin(w * t);
    v = -std::sin(w * t) * w * F0 / k + V * std::cos(w * t);
  }
  Record record;
  record.histories.push_back(history);
  CHECK(largest_friction(record, {m, k}).F0 > F0);
  CHECK(std::isinf(largest_friction(record, {unknown, k}).F0));
}

TEST_CASE("An estimate or a joint fit of any record that reaches above the largest friction is no answer") {
  for (const bool histories : {false, true}) {
    Ledger limited = ledger({});
    limited.tests_histories = limited.recorded.histories = histories;
    limited.largest = {.c = 50.0, .F0 = 80.0};
    const Estimate narrow = estimate("output_error", 0.1, 4.0, 0.05);
    const Estimate wide = estimate("friction_force", 0.1, 4.0, 30.0);  // to 124 N
    CHECK(concluded({narrow}, limited).answer);
    const Identification alone = concluded({wide}, limited);
    CHECK_FALSE(alone.answer);
    CHECK(mentions(alone.estimates[0].reason, "F0 reaches to 1.2e+02 N"));
    // A joint fit that failed leaves nothing tested, and no other method is better than it.
    limited.joint = estimate("joint_fit", 0.1, 3e10, 1.0);
    const Identification beside = concluded({narrow}, limited);
    CHECK_FALSE(beside.answer);
    CHECK(mentions(beside.reason, "the mass could not move as recorded"));
  }
}
