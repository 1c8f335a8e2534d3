#include <catch2/catch.hpp>
#include <memory>

#include "identify/answer/answer.hpp"
#include "identify/answer/preferred.hpp"
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
  // What is found beside it comes first.
  missed.force_excess = "the states need more force than the drive gives";
  CHECK(concluded({narrow}, missed).estimates[0].reason == missed.force_excess);
  missed.other_geometry = "the mass rides on the base";
  CHECK(concluded({narrow}, missed).estimates[0].reason == missed.other_geometry);
  missed.gross_error = "x of pair 3 is off";
  CHECK(concluded({narrow}, missed).estimates[0].reason == missed.gross_error);

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

TEST_CASE("The reason of a joint fit says why it answers before narrower rivals") {
  const std::string basis = "none of the assumptions it rests on is violated";
  const Estimate joint = estimate("joint_fit", 0.1, 4.0, 0.02);
  CHECK(concluded({joint}, ledger({})).reason == basis);
  CHECK(concluded({estimate("energy_balance", 0.1, 4.0, 0.01), joint}, ledger({})).reason ==
        basis + ", and it uses all data: another estimate with a narrower interval has it by chance");
}

TEST_CASE("A joint fit whose value its interval excludes is reported as the middle of the interval") {
  const Estimate balance = estimate("energy_balance", 0.1, 4.0, 0.01);
  Ledger shifted = ledger({});
  shifted.joint = estimate("joint_fit", 0.1, 4.0, 0.02);
  shifted.joint->value.zeta = 0.11;
  const Identification found = concluded({balance, balance}, shifted);
  REQUIRE(found.answer);
  CHECK(found.estimates[*found.answer].method == "joint_fit");
  CHECK(found.estimates[*found.answer].value.zeta == Approx(0.1).epsilon(1e-12));
}

TEST_CASE("A joint fit says something where its half width is less than its value") {
  Estimate ranges = estimate("any_law", 0.06, 2.0, 0.3);
  ranges.laws = std::make_shared<const LawIntervals>();
  const auto answering = [&](double half_width) {
    const Identification found = concluded({ranges, estimate("joint_fit", 0.06, 2.0, half_width)}, ledger({}));
    REQUIRE(found.answer);
    return found.estimates[*found.answer].method;
  };
  CHECK(answering(0.95) == "joint_fit");
  CHECK(answering(1.05) == "any_law");
}

TEST_CASE("Intervals that touch agree") {
  Estimate low = estimate("den_hartog_fit", 0.1, 4.0, 0.02);
  Estimate high = low;
  low.interval95->c = {9.0, 10.0};
  high.interval95->c = {10.0, 11.0};
  CHECK_FALSE(disagree(low, high));
  CHECK_FALSE(disagree(high, low));
  high.interval95->c[0] = 10.001;
  CHECK(disagree(low, high));
  CHECK(disagree(high, low));
}

TEST_CASE("A range whose ends are those of one term names it once, and of two each at its end") {
  Ledger tested = ledger({});
  tested.joint = estimate("joint_fit", 0.1, 4.0, 0.01);
  tested.unseen = UnseenRange{.ends = *tested.joint->interval95, .zeta_by = {"drag", "drag"}, .F0_by = {}};
  tested.unseen->ends.zeta = {0.08, 0.13};
  const std::vector<Estimate> both = {*tested.joint, *tested.joint};
  CHECK(mentions(concluded(both, tested).verdict,
                 "The tests of these data do not exclude zeta from 0.08 to 0.13 (drag)."));
  tested.unseen->zeta_by[1] = "a contact that yields";
  CHECK(mentions(concluded(both, tested).verdict,
                 "do not exclude zeta from 0.08 (drag) to 0.13 (a contact that yields)."));
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

TEST_CASE("Where the simulated motion misses the measured one, nothing that reads the histories answers") {
  const Estimate fit = estimate("output_error", 0.01, 2.0, 0.01);
  Estimate balance = estimate("energy_balance", 0.01, 2.0, 0.5);
  const Estimate extremes = estimate("free_decay", 0.01, 2.0, 0.9);
  Ledger missed = ledger({});
  missed.missed_motion = "the simulated motion misses 74 % of the measured one";
  const Identification of_states = concluded({fit, balance}, missed);
  REQUIRE(of_states.answer);
  CHECK(*of_states.answer == 1);
  balance.is_of_histories = true;
  const Identification of_extremes = concluded({fit, balance, extremes}, missed);
  REQUIRE(of_extremes.answer);
  CHECK(*of_extremes.answer == 2);
  missed.data.clear();
  const Identification found = concluded({fit, balance}, missed);
  CHECK_FALSE(found.answer);
  CHECK(mentions(found.reason, "the simulated motion misses 74 % of the measured one"));
}
