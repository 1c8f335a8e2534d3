#include <catch2/catch.hpp>
#include <memory>

#include "identify/answer/answer.hpp"
#include "identify/methods/any_law/law_intervals.hpp"
#include "tests/identify/ledger/findings.hpp"
#include "tests/identify/methods/histories/bearing.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

TEST_CASE("Each estimate that the record as a whole excludes says so itself") {
  const Estimate narrow = estimate("den_hartog_fit", 0.06, 2.0, 0.01);
  Ledger missed = ledger({});
  missed.misfit = Misfit{1e-5, 12.0};
  CHECK(concluded({narrow}, missed).estimates[0].reason ==
        "the joint model misses these data by 12 times their noise (p = 1e-05)");

  LawIntervals laws;
  laws.inflation = 240.0;
  Estimate ranges = estimate("any_law", 0.06, 2.0, 0.5);
  ranges.laws = std::make_shared<const LawIntervals>(laws);
  Ledger few = ledger({});
  few.data.clear();
  CHECK(mentions(concluded({narrow, ranges}, few).estimates[0].reason, "no law of the library fits"));
}

TEST_CASE("The reason of an answer says what it rests on, and counts its rivals") {
  const std::string basis = "none of the assumptions it rests on is violated";
  const Estimate wide = estimate("den_hartog_fit", 0.1, 4.0, 0.02);
  const Estimate narrow = estimate("resonance_least_squares", 0.1, 4.0, 0.01);
  CHECK(concluded({wide}, ledger({})).reason == basis);
  CHECK(concluded({wide, narrow}, ledger({})).reason ==
        basis + ", and of 2 such estimates its intervals are the narrowest");

  Estimate one = wide;
  one.interval95.reset();
  CHECK(concluded({one}, ledger({})).reason == basis);
  Estimate other = one;
  other.method = "resonance_two_point";
  CHECK(concluded({one, other}, ledger({})).reason ==
        basis + ", and 2 methods agree; the record has no more readings than parameters, so there is no interval");
}

TEST_CASE("A range over laws names each departure whose estimate it was extended to") {
  Estimate ranges = estimate("any_law", 0.06, 0.7, 0.1);
  ranges.laws = std::make_shared<const LawIntervals>();
  Ledger departs = ledger({Assumption::friction_velocity, Assumption::friction_displacement});
  departs.plain = {0.06, 6.0, 0.0007, 0.7};
  LedgerEntry& speed = departs.entry(Assumption::friction_velocity);
  speed.test = "quadratic term over speed";
  speed.zeta_change = 0.5;
  speed.F0_change = 0.0;
  LedgerEntry& distance = departs.entry(Assumption::friction_displacement);
  distance.test = "stiffness of the contact free";
  distance.zeta_change = 0.0;
  distance.F0_change = 0.5;
  CHECK(mentions(concluded({ranges}, departs).verdict,
                 " The interval of any_law also holds the estimates with quadratic term over speed free and with "
                 "stiffness of the contact free, which lie outside this range."));
  distance.F0_change = 0.0;
  CHECK(mentions(concluded({ranges}, departs).verdict,
                 " The interval of any_law also holds the estimate with quadratic term over speed free, which lies "
                 "outside this range."));
}
