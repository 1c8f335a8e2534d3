#include "identify/answer/verdict.hpp"

#include <catch2/catch.hpp>
#include <memory>
#include <string>

#include "identify/answer/answer.hpp"
#include "identify/methods/any_law/law_intervals.hpp"
#include "tests/identify/ledger/findings.hpp"
#include "tests/identify/methods/histories/bearing.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

std::string answer_of(const Identification& found) {
  return found.answer ? found.estimates[*found.answer].method : "";
}

}  // namespace

TEST_CASE("A verdict names what explains a departure as well without moving anything") {
  Ledger drifts = ledger({Assumption::stationarity});
  LedgerEntry& constants = drifts.entry(Assumption::constants);
  constants.test = "mass free";
  constants.p_value = drifts.entry(Assumption::stationarity).p_value;
  const Identification found = concluded({estimate("joint_fit", 0.06, 0.7, 0.1)}, drifts);
  CHECK(mentions(found.verdict,
                 "p = 0.003, explained as well by mass free, which would hardly change zeta and F0)."));
}

TEST_CASE("Who disagrees with the answer is named, and without estimates nothing is said") {
  const Identification found = concluded(
      {estimate("den_hartog_fit", 0.12, 4.0, 0.01), estimate("resonance_deming", 0.1, 4.0, 0.02)}, ledger({}));
  CHECK(mentions(found.verdict, "resonance_deming disagrees: zeta = 0.1 "));
  Estimate none = estimate("free_decay", 0.1, 4.0, 0.01);
  none.outcome = {dualdamp::core::OutcomeKind::not_identifiable, "no data"};
  none.usable = none.sound = false;
  CHECK(concluded({none}, ledger({})).verdict.empty());
  CHECK(concluded({}, ledger({})).verdict.empty());
}

TEST_CASE("A departure that is seen and does no harm stands in the verdict") {
  Ledger seen = ledger({});
  for (const Assumption assumption : {Assumption::sensors, Assumption::symmetry}) {
    LedgerEntry& entry = seen.entry(assumption);
    entry.test = assumption == Assumption::sensors ? "zero of x free" : "friction force of its own";
    entry.p_value = 1e-20;
  }
  const Identification found = concluded({estimate("energy_balance", 0.1, 4.0, 0.02)}, seen);
  CHECK(mentions(
      found.verdict,
      "small departures that hardly change zeta and F0: friction force of its own or zero of x free (p = 1e-20)"));
  CHECK_FALSE(mentions(found.verdict, "do not contradict any"));
}

TEST_CASE("A departure that stated uncertainties allow is told as such, however much it changes zeta and F0") {
  Ledger seen = ledger({});
  LedgerEntry& entry = seen.entry(Assumption::constants);
  entry.test = "mass free";
  entry.p_value = 1e-20;
  entry.F0_change = 0.148;
  entry.is_as_stated = true;
  const Identification found = concluded({estimate("joint_fit", 0.1, 4.0, 0.02)}, seen);
  CHECK(mentions(found.verdict,
                 "that their stated uncertainties allow: mass free (p = 1e-20). joint_fit has it free."));
  CHECK_FALSE(mentions(found.verdict, "hardly change"));
}

TEST_CASE("The verdict states the range of the answer where it exceeds the interval") {
  Ledger tested = ledger({});
  tested.joint = estimate("joint_fit", 0.1, 4.0, 0.01);
  tested.unseen = UnseenRange{.ends = *tested.joint->interval95, .zeta_by = {"drag", ""}, .F0_by = {}};
  tested.unseen->ends.zeta[0] = 0.08;
  const Identification found = concluded({*tested.joint, *tested.joint}, tested);
  REQUIRE(found.range);
  CHECK(found.range->ends.zeta == Interval{0.08, 0.101});
  CHECK(mentions(found.verdict, "The tests of these data do not exclude zeta from 0.08 (drag) to 0.101."));
  tested.unseen->ends.zeta[0] = tested.joint->interval95->zeta[0] * (1.0 - 1e-9);
  CHECK_FALSE(mentions(concluded({*tested.joint, *tested.joint}, tested).verdict, "tests of these data"));
  // An interval that reaches as far by itself needs no such sentence.
  tested.unseen->ends.zeta[0] = 0.0995;
  CHECK_FALSE(mentions(concluded({*tested.joint, *tested.joint}, tested).verdict, "tests of these data"));
}

TEST_CASE("An answer of as many readings as unknowns says that they leave no freedom") {
  Estimate exact = estimate("free_decay", 0.06, 2.0, 0.01);
  exact.interval95.reset();
  exact.used = {1, 2, 3, 4};
  Ledger nothing = ledger({});
  nothing.data.clear();
  CHECK(mentions(concluded({exact}, nothing).verdict, "from 4 readings that leave no freedom for an interval"));
  exact.used = {1, 2, 3, 4, 5};
  CHECK_FALSE(mentions(concluded({exact}, nothing).verdict, "no freedom"));
}

TEST_CASE("A joint fit with a law of friction free answers where nothing else explains the departure") {
  Ledger departing = ledger({Assumption::friction_velocity});
  departing.joint = estimate("joint_fit", 0.06, 2.0, 0.01);
  departing.frees_law = true;
  departing.relaxed = {"quadratic term over speed"};
  const Identification alone = concluded({estimate("energy_balance", 0.1, 3.0, 0.02), *departing.joint}, departing);
  CHECK(answer_of(alone) == "joint_fit");
  CHECK_THAT(alone.verdict, Catch::Contains("beside what joint_fit has free: quadratic term over speed"));
  CHECK_THAT(alone.reason, Catch::Contains("has free what the data contradict"));
  Estimate ranges = estimate("any_law", 0.06, 2.0, 0.3);
  ranges.laws = std::make_shared<LawIntervals>();
  const Identification beside = concluded({ranges, *departing.joint}, departing);
  CHECK(answer_of(beside) == "joint_fit");
  CHECK_THAT(beside.verdict, Catch::Contains("laws that these data allow"));

  Ledger explained_twice = ledger({Assumption::friction_velocity, Assumption::stationarity});
  explained_twice.joint = departing.joint;
  explained_twice.frees_law = true;
  explained_twice.entry(Assumption::stationarity).is_like_speed = true;
  CHECK(answer_of(concluded({ranges, *departing.joint}, explained_twice)) == "any_law");
  Ledger vague = departing;
  vague.joint = estimate("joint_fit", 0.06, 2.0, 1.2);
  CHECK(answer_of(concluded({ranges, *vague.joint}, vague)) == "any_law");
}
