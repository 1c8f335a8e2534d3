#include "identify/ledger/advice.hpp"

#include <catch2/catch.hpp>

#include "identify/answer/answer.hpp"
#include "tests/identify/ledger/findings.hpp"
#include "tests/identify/methods/histories/bearing.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

TEST_CASE("Advice names nothing that the record has already") {
  using enum Assumption;
  const auto advice = [](Assumption violated, const Recorded& recorded) {
    Ledger tested = ledger({violated});
    tested.recorded = recorded;
    return concluded({estimate("energy_balance", 0.1, 4.0, 0.05)}, tested).reason;
  };
  const Recorded response{.states = true, .phases = true, .frequencies = true, .sweeps = true};
  for (const Assumption assumption : assumptions()) {
    CAPTURE(name_of(assumption));
    for (const std::string& text : {advice(assumption, response), would_show(assumption, response)}) {
      CHECK_FALSE(mentions(text, "phase"));
      CHECK_FALSE(mentions(text, "labels"));
      CHECK_FALSE(mentions(text, "several frequencies"));
    }
    const Recorded decay{.histories = true, .free = true, .times = true};
    for (const std::string& text : {advice(assumption, decay), would_show(assumption, decay)}) {
      CHECK_FALSE(mentions(text, "a history"));
      CHECK_FALSE(mentions(text, "times of the extremes"));
    }
  }
  CHECK(mentions(advice(friction_velocity, response), "fit a law that has such a term, or record a history"));
  CHECK(mentions(advice(friction_velocity, {.states = true, .phases = true}), "record the phase at several"));
  CHECK(mentions(advice(sensors, {.states = true, .phases = true}), "record the phase at several frequencies"));
  CHECK_FALSE(mentions(advice(drive, {.drive = true}), "record the drive"));
  CHECK_FALSE(mentions(advice(one_mode, response), "smaller amplitudes"));
  CHECK(would_show(symmetry, {.states = true}) == "; a history or signed extremes would show it");
}

TEST_CASE("Where the range of speeds does not show friction over speed, another size of motion is advised") {
  using enum Assumption;
  const Recorded struck{.histories = true, .free = true, .times = true};
  CHECK(mentions(would_show(friction_velocity, struck), "free vibrations of several sizes"));
  CHECK(mentions(would_show(friction_velocity, {.free = true}), "free vibrations of several sizes"));
  CHECK(mentions(would_show(friction_velocity, {.histories = true, .drive = true}), "drives of several sizes"));
  CHECK(mentions(would_show(friction_velocity, {.states = true}), "more levels, further apart"));
  // The answer that rests on it says so.
  Ledger tested = ledger({});
  tested.recorded = struck;
  tested.joint = estimate("joint_fit", 0.1, 4.0, 0.1);
  const auto reason = [&] { return concluded({*tested.joint}, tested).reason; };
  CHECK_FALSE(mentions(reason(), "what would test"));
  tested.entry(friction_velocity).standing = Standing::untested;
  CHECK(mentions(reason(), "what would test friction_velocity: free vibrations of several sizes"));
}

TEST_CASE("Advice names a remedy for everything that explains a departure as well, harmful or not") {
  using enum Assumption;
  const auto advice = [](const Ledger& tested) {
    return concluded({estimate("energy_balance", 0.1, 4.0, 0.05)}, tested).reason;
  };
  const std::string measure =
      "; or, for constants: leave out the stated stiffness or mass where the record determines "
      "it, or measure them anew";
  Ledger both = ledger({friction_velocity, constants});
  CHECK(mentions(advice(both), "fit a law that has such a term" + measure));
  // One remedy for two assumptions is named once.
  CHECK_FALSE(mentions(advice(ledger({friction_velocity, friction_displacement})), "; or, for"));

  Ledger harmless = ledger({friction_velocity});
  CHECK_FALSE(mentions(advice(harmless), "; or, for"));
  harmless.entry(constants).p_value = harmless.entry(friction_velocity).p_value;
  CHECK(mentions(advice(harmless), "fit a law that has such a term" + measure));
  harmless.entry(constants).p_value = 0.5;
  CHECK_FALSE(mentions(advice(harmless), "; or, for"));
}

TEST_CASE(
    "Advice for a clipped record begins with the part to leave out, where clipping can pretend the departure") {
  using enum Assumption;
  const auto advice = [](Assumption violated, bool is_clipped) {
    Ledger tested = ledger({violated});
    tested.recorded = {.histories = true, .free = true, .times = true, .clipped = is_clipped};
    return concluded({estimate("den_hartog_fit", 0.1, 4.0, 0.05)}, tested).reason;
  };
  for (const Assumption assumption : {friction_velocity, friction_displacement, stationarity, symmetry, spring}) {
    CAPTURE(name_of(assumption));
    CHECK(mentions(advice(assumption, true),
                   "what would help: first leave out the part of the record that is clipped"));
    CHECK_FALSE(mentions(advice(assumption, false), "clipped"));
  }
  CHECK_FALSE(mentions(advice(one_mode, true), "clipped"));
}

TEST_CASE("What a method found stands where a departure was seen that the stated uncertainties allow") {
  Estimate contradicted = estimate("extended_kalman", 0.1, 4.0, 0.2);
  contradicted.usable = false;
  contradicted.findings = {"the filter misses the motion by 15 times what it expects"};
  contradicted.reason = contradicted.findings.front();
  Ledger tested = ledger({});
  tested.tests_histories = true;
  tested.joint = estimate("joint_fit", 0.1, 4.0, 0.1);
  CHECK(concluded({contradicted}, tested).estimates[0].usable);
  LedgerEntry& constants = tested.entry(Assumption::constants);
  constants.p_value = 1e-9;
  constants.zeta_change = -0.01;
  CHECK(concluded({contradicted}, tested).estimates[0].usable);
  constants.zeta_change = -0.2;
  const Identification found = concluded({contradicted, estimate("free_decay", 0.1, 4.0, 0.1)}, tested);
  CHECK_FALSE(found.estimates[0].usable);
  CHECK(mentions(found.estimates[0].reason, "the filter misses the motion"));
  CHECK(found.estimates[1].usable);
  // The only method that was asked for leaves the answer to the fit with the constant free.
  const Identification alone = concluded({contradicted}, tested);
  REQUIRE(alone.answer);
  CHECK(alone.estimates[*alone.answer].method == "joint_fit");
}

TEST_CASE("An answer with a constant free says which constant it refers to") {
  Ledger tested = ledger({Assumption::constants});
  tested.entry(Assumption::constants).fitted = "a mass of 0.8091 kg";
  tested.joint = estimate("joint_fit", 0.1, 4.0, 0.1);
  const Identification found = concluded({estimate("receptance", 0.2, 4.0, 0.1), *tested.joint}, tested);
  CHECK(mentions(found.verdict, "zeta and F0 are those of a mass of 0.8091 kg."));
}
