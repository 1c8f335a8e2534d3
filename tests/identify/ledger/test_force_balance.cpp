#include "identify/ledger/force_balance.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "identify/answer/answer.hpp"
#include "identify/methods/amplitudes/den_hartog_fit.hpp"
#include "tests/identify/readers/refusals.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

constexpr double omega = 38.767;  // 6.17 Hz, where m w^2 = 1566 N/m
constexpr KnownConstants rig{1.042, 1568.0, omega};

/// Readings at resonance, of the rig as it is.
Record readings() {
  return pairs({{4.5e-3, 4.70e-3}, {5e-3, 7.21e-3}, {5.5e-3, 9.76e-3}, {6e-3, 12.25e-3}, {6.5e-3, 14.82e-3}});
}

KnownConstants stiffness_of(double k) { return {rig.mass, k, omega}; }

}  // namespace

TEST_CASE("States that need more force than the base gives charge the constants and leave no answer") {
  // x/Y reaches 2.28. Far below resonance the spring alone then needs 2.28 times k Y: the usual slip of a unit gave
  // zeta = 0.08 (0 to 29936), usable.
  for (const double k : {1.568e6, 15680.0}) {
    CAPTURE(k);
    const Ledger ledger = ledger_of(readings(), stiffness_of(k));
    REQUIRE(ledger.is_violated(Assumption::constants));
    CHECK_FALSE(ledger.is_violated(Assumption::friction_displacement));
    // 1566.0/(1 +- 6.5/14.82) = 1088.6 and 2789.5
    CHECK(
        mentions(ledger.entry(Assumption::constants).wanted, "a stiffness from 1089 to 2789 N/m, not the stated"));
    CHECK(mentions(ledger.force_excess, "in 4 of 5 states"));
    const Identification found = concluded({den_hartog_fit(readings(), stiffness_of(k), {})}, ledger);
    CHECK_FALSE(found.answer);
    CHECK(mentions(found.verdict, "mass, stiffness and frequency are as stated (spring and inertia need up to 2."));
  }
}

TEST_CASE("States that their drive can move charge nothing by the balance of forces") {
  CHECK(ledger_of(readings(), rig).force_excess.empty());
  // Errors of 2.6 times the stated uncertainty cover it.
  CHECK_FALSE(ledger_of(readings(), {0.2, 1568.0, omega}).force_excess.empty());
  CHECK(ledger_of(readings(), {0.2, 1568.0, omega}, {.uncertainties = {.mass = 0.3}}).force_excess.empty());
}

TEST_CASE("Above resonance a contact that yields may give the force, and is named with the constants") {
  const Ledger ledger = ledger_of(readings(), stiffness_of(500.0));
  CHECK(ledger.is_violated(Assumption::constants));
  CHECK(ledger.is_violated(Assumption::friction_displacement));
}
