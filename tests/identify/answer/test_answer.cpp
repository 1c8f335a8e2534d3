#include "identify/answer/answer.hpp"

#include <catch2/catch.hpp>
#include <memory>

#include "identify/methods/any_law/law_intervals.hpp"
#include "tests/identify/ledger/findings.hpp"
#include "tests/identify/methods/histories/bearing.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

const std::string& answering(const Identification& found) {
  REQUIRE(found.answer);
  return found.estimates[*found.answer].method;
}

}  // namespace

TEST_CASE("The narrowest interval answers, whatever the order of the list") {
  const Estimate wide = estimate("den_hartog_fit", 0.1, 4.0, 0.02);
  const Estimate narrow = estimate("resonance_least_squares", 0.101, 4.0, 0.01);
  CHECK(answering(concluded({wide, narrow}, ledger({}))) == "resonance_least_squares");
  const Identification found = concluded({narrow, wide}, ledger({}));
  CHECK(answering(found) == "resonance_least_squares");
  CHECK(mentions(found.verdict, "zeta = 0.101 (95 %: 0.09999 to 0.102), F0 = 4 N (95 %: 3.96 to 4.04 N)"));
  CHECK(mentions(found.verdict, "do not contradict any assumption"));
}

TEST_CASE("Of intervals that are equal but for rounding those of the first method by name answer") {
  const Estimate one = estimate("resonance_deming", 0.1, 4.0, 0.02);
  Estimate same = one;
  same.method = "resonance_least_squares";
  for (const double factor : {1.0 - 1e-12, 1.0, 1.0 + 1e-12}) {
    same.interval95->c[1] = factor * one.interval95->c[1];
    CHECK(answering(concluded({one, same}, ledger({}))) == "resonance_deming");
    CHECK(answering(concluded({same, one}, ledger({}))) == "resonance_deming");
  }
}

TEST_CASE("Of few readings that nothing tests the widest interval that agrees answers") {
  // Three pairs with phases: the narrowest of four intervals with one degree of freedom each missed zeta or F0 in
  // 19 of 150 records, the widest in 5.
  const Estimate wide = estimate("energy_balance", 0.1, 4.0, 0.02);
  const Estimate narrow = estimate("resonance_least_squares", 0.101, 4.0, 0.01);
  const Estimate apart = estimate("harmonic_balance", 0.2, 4.0, 0.1);
  Ledger few = ledger({});
  few.data.clear();
  CHECK(answering(concluded({wide, narrow}, few)) == "energy_balance");
  CHECK(answering(concluded({narrow, wide}, few)) == "energy_balance");
  CHECK(mentions(concluded({narrow, wide}, few).reason, "the widest intervals that agree"));
  CHECK(answering(concluded({narrow, wide, apart}, few)) == "energy_balance");
  few.recorded.histories = true;
  CHECK(answering(concluded({wide, narrow}, few)) == "resonance_least_squares");
}

TEST_CASE("Where too few readings leave nothing to test this is the reason that there is no answer") {
  Estimate unsound = estimate("energy_balance", 0.06, 2.0, 0.01);
  unsound.sound = unsound.usable = false;
  unsound.reason = "the dissipation does not grow with the speed";
  Estimate refused = estimate("den_hartog_fit", 0.06, 2.0, 0.01);
  refused.outcome = {dualdamp::core::OutcomeKind::not_identifiable, "2 pairs are needed, and 0 are left"};
  refused.sound = refused.usable = false;
  Ledger few = ledger({});
  few.data.clear();
  for (LedgerEntry& entry : few.entries) entry.reason = "fewer than four steady states do not stick";
  CHECK(concluded({refused, unsound}, few).reason == "fewer than four steady states do not stick");
  CHECK(mentions(concluded({unsound}, few).reason, "the dissipation does not grow"));
  few.recorded.histories = true;
  CHECK(mentions(concluded({refused, unsound}, few).reason, "the dissipation does not grow"));
}

TEST_CASE("Of estimates without intervals that agree the one in the middle answers") {
  const auto bare = [](const std::string& method, double zeta) {
    Estimate e = estimate(method, zeta, 4.0, 0.0);
    e.interval95.reset();
    return e;
  };
  const Estimate low = bare("den_hartog_fit", 0.1);
  const Estimate middle = bare("resonance_two_point", 0.1001);
  const Estimate high = bare("resonance_deming", 0.1002);
  CHECK(answering(concluded({high, low, middle}, ledger({}))) == "resonance_two_point");
  CHECK(answering(concluded({middle, high, low}, ledger({}))) == "resonance_two_point");
  const Identification apart = concluded({low, bare("resonance_two_point", 0.11)}, ledger({}));
  CHECK_FALSE(apart.answer);
  CHECK(mentions(apart.reason, "do not agree"));
}

TEST_CASE("An estimate cannot be used when an assumption that it rests on is violated") {
  const Estimate balance = estimate("energy_balance", 0.1, 4.0, 0.05);
  const Estimate fit = estimate("den_hartog_fit", 0.12, 4.0, 0.01);
  const Identification found = concluded({fit, balance}, ledger({Assumption::spring}));
  CHECK(answering(found) == "energy_balance");
  CHECK_FALSE(found.estimates[0].usable);
  CHECK(mentions(found.estimates[0].reason, "the spring is linear"));
  CHECK(mentions(found.verdict, "These data contradict that the spring is linear"));
  // The work of the base is proportional to k: a wrong stiffness makes F0 and c wrong.
  CHECK_FALSE(concluded({fit, balance}, ledger({Assumption::constants})).answer);
}

TEST_CASE("A departure of friction leaves no answer, and the verdict says what would help") {
  const Identification found =
      concluded({estimate("energy_balance", 0.1, 4.0, 0.05)},
                ledger({Assumption::friction_velocity, Assumption::friction_displacement}));
  CHECK_FALSE(found.answer);
  CHECK(mentions(found.verdict, "or that friction does not depend on the position"));
  CHECK(mentions(found.reason, "what would help: record the phase at several frequencies"));
}

TEST_CASE("A range over laws that answers beside a departure of friction says what would narrow it") {
  Estimate ranges = estimate("any_law", 0.1, 4.0, 0.5);
  LawIntervals laws;
  laws.zeta_hull = ranges.interval95->zeta;
  laws.F0_hull = ranges.interval95->F0;
  ranges.laws = std::make_shared<const LawIntervals>(laws);
  const std::vector<Estimate> both = {estimate("energy_balance", 0.1, 4.0, 0.05), ranges};
  const Identification found = concluded(both, ledger({Assumption::friction_velocity}));
  CHECK(answering(found) == "any_law");
  CHECK(mentions(found.reason, "what would narrow it: record the phase at several frequencies"));
  // Without a departure the reason does not say what would narrow the range.
  CHECK_FALSE(mentions(concluded({ranges}, ledger({})).reason, "what would narrow it"));
}

TEST_CASE("A range over laws holds the estimate with the departure of friction relaxed") {
  Estimate ranges = estimate("any_law", 0.06, 0.7, 0.3);
  ranges.laws = std::make_shared<const LawIntervals>();
  Ledger drag = ledger({Assumption::friction_velocity});
  drag.plain = {0.062, 6.2, 0.0007, 0.7};
  LedgerEntry& entry = drag.entry(Assumption::friction_velocity);
  entry.zeta_change = -0.5;
  entry.F0_change = 0.1;
  entry.p_value = 0.0026997960632601866;  // three standard errors
  const Identification found = concluded({ranges}, drag);
  const ParameterIntervals& at = *found.estimates[*found.answer].interval95;
  CHECK(at.zeta[0] == Approx(0.031 - 0.031 * 1.959964 / 3.0).epsilon(1e-6));
  CHECK(at.c[0] == Approx(3.1 - 3.1 * 1.959964 / 3.0).epsilon(1e-6));
  CHECK(at.zeta[1] == ranges.interval95->zeta[1]);
  CHECK(at.F0 == ranges.interval95->F0);
  CHECK(mentions(found.verdict, "also holds the estimate with something free, which lies outside"));

  // A relaxation that the range holds changes nothing; friction is not below zero.
  entry.zeta_change = 0.05;
  CHECK(concluded({ranges}, drag).estimates.front().interval95->zeta == ranges.interval95->zeta);
  entry.zeta_change = -1.5;
  CHECK(concluded({ranges}, drag).estimates.front().interval95->zeta[0] == 0.0);
}

TEST_CASE("What may depart in place of friction leaves the answer to the range over laws, which then holds it") {
  Estimate ranges = estimate("any_law", 0.06, 0.7, 0.1);
  ranges.laws = std::make_shared<const LawIntervals>();
  for (const Assumption friction : {Assumption::friction_velocity, Assumption::friction_displacement})
    for (const Assumption other : {Assumption::sensors, Assumption::one_mode, Assumption::stationarity}) {
      Ledger either = ledger({other, friction});
      either.plain = {0.06, 6.0, 0.0007, 0.7};
      LedgerEntry& entry = either.entry(other);
      entry.zeta_change = 0.3;
      entry.F0_change = -1.6;
      const Identification found = concluded({ranges}, either);
      CHECK(answering(found) == "any_law");
      CHECK(mentions(found.reason, "its interval also holds what explains the departure as well as friction does"));
      CHECK_FALSE(mentions(found.reason, "none of the assumptions it rests on is violated"));
      CHECK(found.estimates.front().interval95->zeta[1] > 1.3 * 0.06);
      CHECK(found.estimates.front().interval95->F0[0] == 0.0);
      CHECK(mentions(found.verdict, "also holds the estimate with something free, which lies outside"));
      // Where it departs by itself as well, no law of friction can stand for it.
      either.departures.push_back({other});
      CHECK_FALSE(concluded({ranges}, either).answer);
    }
}

TEST_CASE("A drift that may be friction over speed leaves the answer to the range over laws, which then holds it") {
  Estimate ranges = estimate("any_law", 0.06, 0.7, 0.1);
  ranges.laws = std::make_shared<const LawIntervals>();
  Ledger either = ledger({Assumption::stationarity, Assumption::friction_velocity});
  either.recorded = {.histories = true, .free = true};
  either.plain = {0.06, 6.0, 0.0007, 0.7};
  LedgerEntry& drift = either.entry(Assumption::stationarity);
  drift.zeta_change = -0.3;
  drift.F0_change = 0.05;
  drift.is_like_speed = true;
  const Identification found = concluded({ranges}, either);
  CHECK(answering(found) == "any_law");
  CHECK(found.estimates.front().interval95->zeta[0] < 0.7 * 0.06);
  CHECK(mentions(found.reason, "measure a decay from another amplitude"));
}

TEST_CASE("Findings of a method decide only where the ledger could test nothing") {
  Estimate contradicted = estimate("acceleration_velocity_displacement", 0.1, 4.0, 0.01);
  contradicted.usable = false;
  contradicted.findings = {"friction over speed is not a straight line"};
  contradicted.reason = contradicted.findings.front();
  Ledger of_histories = ledger({});
  of_histories.tests_histories = true;
  CHECK(concluded({contradicted}, of_histories).answer);
  Ledger nothing = ledger({});
  nothing.data.clear();
  const Identification found = concluded({contradicted}, nothing);
  CHECK_FALSE(found.answer);
  CHECK(mentions(found.reason, "friction over speed is not a straight line"));
}

TEST_CASE("Where the ledger tested nothing a departure that one method finds leaves no answer by another") {
  Estimate finder = estimate("acceleration_velocity_displacement", 0.1, 4.0, 0.05);
  finder.usable = false;
  finder.findings = {"friction over speed is not a straight line"};
  const Estimate blind = estimate("recursive_least_squares", 0.12, 4.0, 0.01);
  Ledger nothing = ledger({});
  nothing.data.clear();
  CHECK_FALSE(concluded({blind, finder}, nothing).answer);
  const Identification found = concluded({finder, blind}, nothing);
  CHECK_FALSE(found.answer);
  CHECK(mentions(found.estimates[1].reason, "acceleration_velocity_displacement finds a departure"));
  // Ranges over laws allow for departures. A method without an interval has found nothing against the law.
  Estimate ranges = estimate("any_law", 0.1, 4.0, 0.5);
  ranges.laws = std::make_shared<const LawIntervals>();
  CHECK(answering(concluded({finder, blind, ranges}, nothing)) == "any_law");
  finder.interval95.reset();
  finder.findings = {"no interval is claimed"};
  CHECK(answering(concluded({finder, blind}, nothing)) == "recursive_least_squares");
}

TEST_CASE("A method that does not trust itself does not accuse the others") {
  // Short decays of plain friction were left without an answer by a filter that misses its own law as well, and by
  // a line of forces that depends on its cut-off.
  Estimate finder = estimate("extended_kalman", 0.1, 4.0, 0.05);
  finder.usable = false;
  finder.findings = {"the filter misses the motion by 8 times what it expects"};
  const Estimate good = estimate("output_error", 0.12, 4.0, 0.01);
  Ledger nothing = ledger({});
  nothing.data.clear();
  nothing.recorded.histories = true;
  CHECK_FALSE(concluded({finder, good}, nothing).answer);
  SECTION("with a fault of its own") { finder.sound = false; }
  SECTION("that finds as much in motions of its law") { finder.misreads_its_law = true; }
  CHECK(answering(concluded({finder, good}, nothing)) == "output_error");
}

TEST_CASE("Where the ledger tested nothing and no law fits a few states, nothing answers") {
  auto of_laws = std::make_shared<LawIntervals>();
  of_laws->inflation = 240.0;
  Estimate ranges = estimate("any_law", 0.1, 4.0, 0.5);
  ranges.laws = of_laws;
  Ledger few = ledger({});
  few.data.clear();
  const Identification found = concluded({estimate("harmonic_balance", 0.1, 4.0, 0.9), ranges}, few);
  CHECK_FALSE(found.answer);
  CHECK(mentions(found.reason, "no law of the library fits"));
}

TEST_CASE("A further parameter lies within its interval, as the others do") {
  Estimate shifted = estimate("acceleration_velocity_displacement", 0.1, 4.0, 0.05);
  shifted.others.push_back({"offset", "N", 0.0577, 0.01, Interval{-0.228, -0.190}});
  const Identification found = concluded({shifted}, ledger({}));
  CHECK(found.estimates.front().others.front().value == Approx(-0.209));
}

TEST_CASE("No interval and no range ends below zero, and no interval is reversed") {
  Estimate best = estimate("joint_fit", 0.001, 0.01, 0.1);
  best.value.zeta = -1e-12;
  best.interval95->zeta = {-2e-12, -5e-13};
  Ledger few = ledger({});
  few.unseen = UnseenRange{.ends = {{-0.17, 0.38}, {-17.0, 38.0}, {-0.005, 0.01}, {-4.8, 6.0}}};
  const Identification found = concluded({best}, few);
  REQUIRE(found.answer);
  const Interval& zeta = found.estimates[*found.answer].interval95->zeta;
  CHECK(zeta[0] == 0.0);
  CHECK(zeta[1] >= zeta[0]);
  REQUIRE(found.range);
  for (const ReportedParameter& parameter : reported_parameters)
    CHECK((found.range->ends.*parameter.interval)[0] == 0.0);
}

TEST_CASE("A ledger of extremes does not clear what a method found in the history") {
  Estimate contradicted = estimate("output_error", 1.1, 4.0, 0.01);
  contradicted.usable = false;
  contradicted.findings = {"what the fit leaves is not noise alone"};
  contradicted.reason = contradicted.findings.front();
  Ledger tested = ledger({});
  const Identification found = concluded({contradicted}, tested);
  CHECK_FALSE(found.answer);
  CHECK(mentions(found.reason, "what the fit leaves is not noise alone"));
  tested.tests_histories = true;
  CHECK(answering(concluded({contradicted}, tested)) == "output_error");
}

TEST_CASE("Advice fits the kind of record") {
  using enum Assumption;
  const auto advice = [](const std::vector<Assumption>& violated, const Recorded& recorded) {
    Ledger tested = ledger(violated);
    tested.recorded = recorded;
    return concluded({estimate("energy_balance", 0.1, 4.0, 0.05)}, tested).reason;
  };
  const Recorded decay{.histories = true, .free = true, .one_sensor = true};
  CHECK_FALSE(mentions(advice({friction_velocity}, decay), "record the phase"));
  CHECK_FALSE(mentions(advice({friction_velocity}, decay), "a history"));
  CHECK(mentions(advice({friction_velocity}, decay), "fit a law that has such a term"));
  CHECK_FALSE(mentions(advice({sensors}, decay), "against each other"));
  CHECK(mentions(advice({sensors}, decay), "record a second sensor"));
  CHECK_FALSE(mentions(advice({stationarity}, decay), "labels"));
  CHECK(mentions(advice({friction_velocity}, {.free = true, .one_sensor = true}), "record the whole history"));
  CHECK(mentions(advice({sensors}, {.histories = true}), "against each other"));
  CHECK(mentions(advice({stationarity}, {}), "labels"));
}

TEST_CASE("An estimate that the joint fit of all data excludes cannot be used, and the joint fit answers") {
  Ledger with_joint = ledger({});
  with_joint.joint = estimate("joint_fit", 0.1, 4.0, 0.01);
  const Identification alone = concluded({estimate("energy_balance", 0.14, 4.0, 0.02)}, with_joint);
  REQUIRE(alone.estimates.size() == 2);
  CHECK_FALSE(alone.estimates[0].usable);
  CHECK(mentions(alone.estimates[0].reason, "joint_fit, which has all data, excludes it: zeta = 0.1, F0 = 4"));
  CHECK(answering(alone) == "joint_fit");
  // A single method that was asked for, and agrees with the joint fit, answers alone.
  const Identification agrees = concluded({estimate("energy_balance", 0.102, 4.0, 0.02)}, with_joint);
  CHECK(agrees.estimates.size() == 1);
  CHECK(answering(agrees) == "energy_balance");
  // A joint fit that cannot be used excludes nothing.
  with_joint.joint->usable = false;
  CHECK(concluded({estimate("energy_balance", 0.14, 4.0, 0.02)}, with_joint).estimates[0].usable);
}

TEST_CASE("A joint fit more uncertain than its value leaves the answer to a range over laws that says more") {
  Estimate ranges = estimate("any_law", 0.06, 2.0, 0.3);
  ranges.laws = std::make_shared<const LawIntervals>();
  Ledger with_joint = ledger({});
  with_joint.joint = estimate("joint_fit", 0.06, 2.0, 1.5);
  const Estimate narrow = estimate("energy_balance", 0.06, 2.0, 0.1);
  CHECK(answering(concluded({ranges, *with_joint.joint}, ledger({}))) == "any_law");
  CHECK(answering(concluded({ranges, narrow, *with_joint.joint}, ledger({}))) == "any_law");
  CHECK(answering(concluded({narrow, *with_joint.joint}, ledger({}))) == "joint_fit");
  // A joint fit that says something answers, however wide the others are.
  with_joint.joint = estimate("joint_fit", 0.06, 2.0, 0.5);
  CHECK(answering(concluded({ranges, *with_joint.joint}, ledger({}))) == "joint_fit");
}

TEST_CASE("No answer has negative friction") {
  Estimate ranges = estimate("any_law", 0.06, 2.0, 0.3);
  ranges.laws = std::make_shared<const LawIntervals>();
  Estimate joint = estimate("joint_fit", 0.06, 2.0, 0.5);
  joint.value = {-0.01, -1.0, 2e-3, 2.0};
  joint.interval95->zeta = {-0.03, 0.01};
  joint.interval95->c = {-3.0, 1.0};
  CHECK(answering(concluded({ranges, joint}, ledger({}))) == "any_law");
  // Where nothing else can answer it is zero, which the interval holds.
  const Identification alone = concluded({joint, joint}, ledger({}));
  REQUIRE(alone.answer);
  const Estimate& answer = alone.estimates[*alone.answer];
  CHECK(answer.value.zeta == 0.0);
  CHECK(answer.value.c == 0.0);
  CHECK(answer.interval95->zeta == Interval{0.0, 0.01});
  REQUIRE(answer.warnings.size() == 1);
  CHECK(mentions(answer.warnings.front(), "zeta is fitted best by a negative value"));
  CHECK(answer.value.F0 == 2.0);
  // Nor does an interval reach below zero, whatever its middle is.
  Estimate vague = estimate("joint_fit", 0.06, 2.0, 1.5);
  const Identification positive = concluded({vague, vague}, ledger({}));
  REQUIRE(positive.answer);
  const Estimate& of_positive = positive.estimates[*positive.answer];
  CHECK(of_positive.value.zeta == 0.06);
  CHECK(of_positive.interval95->zeta == std::array<double, 2>{0.0, vague.interval95->zeta[1]});
  CHECK(of_positive.interval95->F0[0] == 0.0);
}

TEST_CASE("Clearly negative friction is named as the cause, before what one method says of itself") {
  Ledger negative = ledger({});
  negative.tests_histories = true;
  negative.joint = estimate("joint_fit", 0.06, 2.0, 0.01);
  negative.joint->value.c = -6.0;
  negative.joint->interval95->c = {-6.1, -5.9};
  Estimate unsound = estimate("friction_force", 0.06, 2.0, 0.01);
  unsound.sound = unsound.usable = false;
  unsound.reason = "friction over speed is not a straight line";
  const Identification found = concluded({unsound}, negative);
  CHECK_FALSE(found.answer);
  CHECK(
      found.reason.starts_with("the joint model fits these histories only with friction that is clearly negative"));
  CHECK(mentions(found.verdict, "clearly negative"));
  CHECK(concluded({unsound}, ledger({})).reason == "friction_force: friction over speed is not a straight line");
}

TEST_CASE("Where the joint model misses the record no narrow estimate answers, and the verdict says so") {
  Ledger missed = ledger({});
  missed.misfit = Misfit{1e-5, 12.0};
  Estimate ranges = estimate("any_law", 0.06, 2.0, 0.3);
  LawIntervals laws;
  laws.zeta_hull = ranges.interval95->zeta;
  laws.F0_hull = ranges.interval95->F0;
  ranges.laws = std::make_shared<const LawIntervals>(laws);
  const Estimate narrow = estimate("den_hartog_fit", 0.06, 2.0, 0.01);
  const Identification none = concluded({narrow}, missed);
  CHECK_FALSE(none.answer);
  CHECK(mentions(none.reason, "misses these data by 12 times their noise"));
  CHECK(mentions(none.verdict, "no single assumption"));
  Estimate finder = narrow;  // what a method found does not make it usable
  finder.usable = false;
  finder.findings = {"the line is curved"};
  CHECK_FALSE(concluded({finder}, missed).answer);
  const Identification wide = concluded({narrow, ranges}, missed);
  CHECK(answering(wide) == "any_law");
  CHECK(mentions(wide.verdict, "no single assumption"));
  // A range of which no law fits the record does not answer either.
  laws.inflation = 3.5;
  ranges.laws = std::make_shared<const LawIntervals>(laws);
  CHECK_FALSE(concluded({narrow, ranges}, missed).answer);
  CHECK_FALSE(concluded({ranges}, ledger({})).answer);
}

TEST_CASE("A verdict cites a range over laws only where it is usable") {
  Estimate ranges = estimate("any_law", 0.06, 2.0, 0.3);
  LawIntervals laws;
  laws.zeta_hull = ranges.interval95->zeta;
  laws.F0_hull = ranges.interval95->F0;
  laws.laws.resize(7);
  ranges.laws = std::make_shared<const LawIntervals>(laws);
  const Estimate narrow = estimate("den_hartog_fit", 0.06, 2.0, 0.01);
  const std::string cited = "Over the 7 laws that these data allow";
  CHECK(mentions(concluded({narrow, ranges}, ledger({})).verdict, cited));
  laws.inflation = 4.6;
  ranges.laws = std::make_shared<const LawIntervals>(laws);
  const Identification found = concluded({narrow, ranges}, ledger({}));
  CHECK(answering(found) == "den_hartog_fit");
  CHECK_FALSE(mentions(found.verdict, cited));
  CHECK(mentions(found.verdict,
                 "The range over laws is not to be used: no law of the library fits: the best one misses"));
  const Identification none = concluded({ranges}, ledger({}));
  CHECK_FALSE(mentions(none.verdict, cited));
  CHECK(mentions(none.verdict, "no law of the library fits"));
}
