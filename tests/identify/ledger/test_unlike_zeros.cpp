#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/random.hpp"
#include "identify/answer/answer.hpp"
#include "identify/ledger/ledger.hpp"
#include "identify/methods/histories/friction_force.hpp"
#include "tests/identify/ledger/laboratory.hpp"
#include "tests/identify/ledger/rig.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

const Rig true_rig{.m = 2.4, .k = 2661.477, .zeta = 0.04, .F0 = 1.916};
const KnownConstants as_built{true_rig.m, true_rig.k, unknown};
constexpr double noise_of_x = 2e-5;
constexpr double samples_a_second = 500.0;

/// Samples of a motion, read about this zero.
History read_about(const Motion& motion, double zero, std::uint64_t seed) {
  const dualdamp::core::RandomStream stream{seed, 1};
  History history{.sample_rate = samples_a_second};
  for (std::size_t i = 0; i < motion.x.size(); ++i)
    history.x.push_back(motion.x[i] + zero + noise_of_x * stream.normal(static_cast<std::uint64_t>(i)));
  return history;
}

Record decays(double first, double second) {
  const auto released = [](double x0) {
    return motion_of(true_rig, [](double) { return 0.0; }, 1.0, samples_a_second, x0);
  };
  Record record;
  record.histories =
      std::vector<History>{read_about(released(0.012), first, 31), read_about(released(-0.0084), second, 32)};
  return record;
}

Record forced(double first, double second) {
  Record record;
  for (const double zero : {first, second}) {
    const double force = record.histories.empty() ? 6.0 : 9.0;
    const auto motion = motion_of(
        true_rig, [&](double t) { return force * std::sin(0.9 * true_rig.omega() * t); }, 1.5, samples_a_second);
    record.histories.push_back(read_about(motion, zero, record.histories.empty() ? 33 : 34));
    record.histories.back().force = motion.drive;
  }
  return record;
}

void check_true_rig(const Ledger& ledger) {
  for (const LedgerEntry& entry : ledger.entries) {
    CAPTURE(name_of(entry.assumption), entry.test);
    CHECK(entry.standing != Standing::violated);
  }
  REQUIRE(ledger.joint);
  REQUIRE(ledger.joint->interval95);
  const Interval zeta = ledger.joint->interval95->zeta;
  const Interval F0 = ledger.joint->interval95->F0;
  CHECK(zeta[0] < true_rig.zeta);
  CHECK(true_rig.zeta < zeta[1]);
  CHECK(F0[0] < true_rig.F0);
  CHECK(true_rig.F0 < F0[1]);
  CHECK(zeta[1] - zeta[0] < 0.2 * true_rig.zeta);
}

}  // namespace

TEST_CASE("Histories whose zeros of x differ charge nothing, and the joint fit holds the truth") {
  for (const double second : {4.3e-4, -2e-4}) {
    CAPTURE(second);
    const Ledger ledger = ledger_of(decays(0.0, second), as_built);
    CHECK_FALSE(ledger.unlike_zeros.empty());
    check_true_rig(ledger);
  }
  const Ledger ledger = ledger_of(forced(3e-4, -5e-4), as_built);
  CHECK_FALSE(ledger.unlike_zeros.empty());
  check_true_rig(ledger);
}

TEST_CASE("Methods that take one zero of x for all histories are not used where the zeros differ") {
  const Record record = decays(0.0, 4.3e-4);
  const Identification found = concluded({friction_force(record, as_built, {})}, ledger_of(record, as_built));
  CHECK_FALSE(found.estimates[0].usable);
  CHECK_THAT(found.estimates[0].reason, Catch::Contains("the zero of x differs from history to history"));
}

TEST_CASE("A zero of x that all histories share is tested as that of one history is") {
  check_true_rig(ledger_of(decays(0.0, 0.0), as_built));
  const Ledger ledger = ledger_of(decays(4.3e-4, 4.3e-4), as_built);
  CHECK(ledger.unlike_zeros.empty());
  CHECK(ledger.is_violated(Assumption::sensors));
}
