#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "identify/answer/answer.hpp"
#include "identify/ledger/estimate/joint_estimate.hpp"
#include "identify/ledger/estimate/unstated_constants.hpp"
#include "tests/identify/ledger/laboratory.hpp"

using namespace dualdamp::identify;
using dualdamp::identify::testing::Kind;
using dualdamp::identify::testing::measured;
using dualdamp::identify::testing::Measured;
using dualdamp::identify::testing::Off;
using dualdamp::identify::testing::Rig;

namespace {

bool holds(const Interval& interval, double value) { return interval[0] <= value && value <= interval[1]; }

struct Misled {
  int estimates = 0, by_interval = 0, by_range = 0;
};

/// Joint estimates that are off by more than 5 % with zeta outside.
Misled misled(Kind kind, std::uint64_t first, int records, void (*alter)(Rig&), const Off& off) {
  Misled counts;
  for (int i = 0; i < records; ++i) {
    const Measured m = measured(kind, first + static_cast<std::uint64_t>(i), alter, off);
    Ledger ledger = ledger_of(m.record, m.constants);
    if (!ledger.joint || !ledger.joint->interval95 || !ledger.joint->usable) continue;
    reach_over_unstated(m.record, m.constants, {}, ledger);
    REQUIRE(ledger.unseen);
    ++counts.estimates;
    if (std::abs(ledger.joint->value.zeta / m.rig.zeta - 1.0) <= 0.05) continue;
    counts.by_interval += holds(ledger.joint->interval95->zeta, m.rig.zeta) ? 0 : 1;
    counts.by_range += holds(ledger.unseen->ends.zeta, m.rig.zeta) ? 0 : 1;
  }
  return counts;
}

/// x = 1, u over u in [-1, 1], and u^2 as the term of friction. The data have `bend` u^2 and alternating noise.
JointModel parabola(double bend, int sign) {
  constexpr Eigen::Index count = 40;
  JointModel model;
  const Eigen::ArrayXd u = Eigen::ArrayXd::LinSpaced(count, -1.0, 1.0);
  model.base.resize(count, 2);
  model.base << Eigen::VectorXd::Ones(count), u.matrix();
  model.relaxed = u.square().matrix();
  model.relaxations = {{Assumption::friction_velocity, "bend", sign}};
  model.residuals = bend * u.square();
  for (Eigen::Index i = 0; i < count; ++i) model.residuals[i] += (i / 2) % 2 == 0 ? 1.0 : -1.0;
  model.value = {10.0, 0.0, 0.0, 100.0};
  model.constants = {1.0, 1.0, unknown};
  model.scale_freedom = 38.0;
  return model;
}

UnseenRange range_of(const JointModel& model) {
  const RelaxationTests tests = test_relaxations(model);
  const auto range = unseen_friction(model, tests, relaxed_estimate(model, tests));
  REQUIRE(range);
  return *range;
}

}  // namespace

TEST_CASE("The range holds the interval of the estimate with an unseen term of friction free") {
  const JointModel model = parabola(0.3, 0);
  const UnseenRange range = range_of(model);
  const Estimate freed = joint_estimate(model, {0}, {}, {});
  CHECK(range.ends.zeta[0] == Approx(freed.interval95->zeta[0]).epsilon(0.002));
  CHECK(range.zeta_by[0] == "bend");
  CHECK(range.ends.zeta[1] ==
        Approx(std::max(freed.interval95->zeta[1], joint_estimate(model, {}, {}, {}).interval95->zeta[1]))
            .epsilon(0.002));
}

TEST_CASE("A term that can have one sign only extends the range on one side") {
  // u^2 above the line means that zeta, the constant, is lower with it free.
  const UnseenRange above = range_of(parabola(0.0, 1));
  const UnseenRange below = range_of(parabola(0.0, -1));
  const double low = 10.0 - above.ends.zeta[0];
  const double high = below.ends.zeta[1] - 10.0;
  const JointModel model = parabola(0.0, 0);
  const Interval plain = joint_estimate(model, {}, {}, {}).interval95->zeta;
  CHECK(low > 1.3 * (10.0 - plain[0]));
  CHECK(above.ends.zeta[1] == Approx(plain[1]).epsilon(0.01));
  CHECK(high > 1.3 * (plain[1] - 10.0));
  CHECK(below.ends.zeta[0] == Approx(plain[0]).epsilon(0.01));
  // The noise is odd in u, and tells neither sign from the other.
  CHECK(low == Approx(high).epsilon(1e-6));
  CHECK(above.ends.zeta[1] - 10.0 == Approx(10.0 - below.ends.zeta[0]).epsilon(1e-6));
}

TEST_CASE("Where drag is hard to see the range holds the damping that the interval misses") {
  const Misled counts = misled(Kind::response, 6'300'000, 25, [](Rig& rig) { rig.drag = 0.5; }, {});
  CHECK(counts.by_interval >= 4);
  CHECK(2 * counts.by_range <= counts.by_interval);
}

TEST_CASE("At a frequency 2 % off the range of amplitudes alone holds the damping that the interval misses") {
  const Misled counts = misled(Kind::xy, 6'300'000, 16, nullptr, {.frequency = 0.02});
  CHECK(counts.by_interval >= 4);
  CHECK(counts.by_range <= 1);
}

TEST_CASE("Constants and gains that a record tests sharply, or of stated uncertainty, do not extend the range") {
  const Measured forced = measured(Kind::forced, 6'300'001);
  const Measured levels = measured(Kind::xy, 6'300'001);
  const KnownConstants& k = levels.constants;
  const LedgerOptions sure{.uncertainties = {.mass = 1e-6 * k.mass,
                                             .stiffness = 1e-6 * k.stiffness,
                                             .frequency = 1e-6 * k.frequency,
                                             .gain_y = 1e-6,
                                             .gain_x = 1e-6,
                                             .gain_v = 1e-6,
                                             .gain_a = 1e-6,
                                             .gain_force = 1e-6}};
  for (const auto& [m, options, same] :
       {std::tuple{&forced, LedgerOptions{}, true}, {&levels, sure, true}, {&levels, LedgerOptions{}, false}}) {
    Ledger ledger = ledger_of(m->record, m->constants, options);
    REQUIRE(ledger.unseen);
    const UnseenRange before = *ledger.unseen;
    reach_over_unstated(m->record, m->constants, options, ledger);
    CHECK((ledger.unseen->ends.zeta == before.ends.zeta) == same);
    CHECK((ledger.unseen->ends.F0 == before.ends.F0) == same);
  }
}

TEST_CASE("States that determine neither zeta nor F0 leave no answer where the fit is negative") {
  // The range of zeta was 0 to 7.3, that of F0 0 to 800 N, and the verdict spoke of no contradiction.
  for (const std::uint64_t seed : {77'005U, 77'010U}) {
    CAPTURE(seed);
    const Measured m = measured(Kind::response, seed, nullptr, {.stiffness = 0.05, .states = 4});
    Ledger ledger = ledger_of(m.record, m.constants);
    REQUIRE(ledger.joint);
    REQUIRE(std::min(ledger.joint->value.zeta, ledger.joint->value.F0) < 0.0);
    const Estimate joint = *ledger.joint;
    const Identification found = concluded({joint, joint}, std::move(ledger));
    CHECK_FALSE(found.answer);
    CHECK(found.reason.find("they determine neither zeta nor F0") != std::string::npos);
  }
}
