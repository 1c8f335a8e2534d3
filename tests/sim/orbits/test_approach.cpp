// A motion approaches an orbit: when it counts as having come back, and that it goes to the orbit that is reported.

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "friction_models/laws/free_play.hpp"
#include "friction_models/laws/iwan.hpp"
#include "sim/orbits/period_map.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/sim/orbits/range_of_motion.hpp"
#include "tests/support/make_law.hpp"

using namespace dualdamp;
using sim::testing::after;
using sim::testing::Range;

TEST_CASE("a motion far smaller than the terms whose sum it is, is periodic within their rounding") {
  // A mass in a play of 1.5 um. The friction of the play would stretch the spring by 17 m, so positions are sums of
  // terms of 17 m, rounded to 4e-15 m, and slides of 1e-10 m differ by that from period to period.
  struct Case {
    sim::Oscillator oscillator;
    double amplitude, frequency;
    friction::FreePlay play;
  };
  const std::vector<Case> cases = {
      {{.mass = 0.137, .stiffness = 0.00353, .damping = 1.15e-5},
       0.083,
       0.0381,
       friction::FreePlay(0.0587, 0.0587, 1.516e-6)},
      {{.mass = 0.2067, .stiffness = 1432.9}, 0.012, 22.866, friction::FreePlay(3984.0, 3984.0, 3.139e-6)},
  };
  for (const Case& c : cases) {
    CAPTURE(c.oscillator.mass);
    sim::Model model;
    model.oscillator = c.oscillator;
    model.excitation = {
        .type = sim::ExcitationType::base_harmonic, .amplitude = c.amplitude, .frequency = c.frequency};
    model.friction.emplace_back(c.play);
    const sim::SteadyState state = sim::steady_state(model);
    INFO(state.outcome.reason);
    REQUIRE(state.outcome.ok());
    CHECK(state.transient_periods < 100);
    const Range seen = after(model, 20, 2);
    CHECK(state.peak == Approx(seen.peak).epsilon(1e-7));
    CHECK(state.trough == Approx(seen.trough).epsilon(1e-7));
  }
}

TEST_CASE("a slider that would slip on the way to an orbit leads to another orbit") {
  // From afar the motion winds about an orbit of its own sliders, and would reach it if none of them slipped.
  sim::Model model;
  model.oscillator = {.mass = 0.13888836, .stiffness = 104906.43, .damping = 19.838018};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 0.13451059,
                      .frequency = 9861.6816,
                      .phase = 2.6449537};
  model.initial = {0.5222969, 81.919972};
  model.friction.emplace_back(friction::ContactCompliance(856.71958, 1579.1682, 22491878.0, 0.0));
  model.friction.emplace_back(friction::Iwan(friction::Iwan::uniform(76062.435, 4346.2737, 17)));
  model.friction.emplace_back(friction::Coulomb(537.45888, 537.45888));
  const sim::SteadyState state = sim::steady_state(model);
  REQUIRE(state.outcome.ok());
  const Range seen = after(model, 300, 2);
  CHECK(state.peak == Approx(seen.peak).epsilon(1e-8));
  CHECK(state.trough == Approx(seen.trough).epsilon(1e-8));
}

TEST_CASE("a motion that ends close beside an orbit that attracts is followed to its end") {
  // Slow drive, static friction four times the kinetic: ringing after each reversal leads to one of several orbits,
  // a millionth of the motion apart. The symmetric one attracts too.
  sim::Model model;
  model.oscillator = {.mass = 1.181074350322255,
                      .stiffness = 68.17782471923137,
                      .damping = 0.001561186769861896,
                      .damper_to = sim::DamperTo::base};
  model.excitation = {.type = sim::ExcitationType::force_harmonic,
                      .amplitude = 1.1206955887174963,
                      .frequency = 0.015640056622079044,
                      .phase = 1.5679197650758723};
  model.friction.emplace_back(friction::Coulomb(1.132149488168754e-06, 4.417217562904935e-06));
  const sim::SteadyState state = sim::steady_state(model);
  REQUIRE(state.outcome.ok());
  const Range seen = after(model, 60, 2);
  CHECK(state.peak == Approx(seen.peak).epsilon(1e-10));
  CHECK(state.trough == Approx(seen.trough).epsilon(1e-10));
  CHECK(state.peak + state.trough > 1e-6 * state.peak);
}

TEST_CASE(
    "a mass that comes to rest is reported where it does, not at the end of the positions that friction holds") {
  // The drive pulls a little more than friction holds forward: below Y - F/k = 3.8 mm the mass slips. From 0 it
  // approaches this end by ever smaller slips.
  for (const double start : {-0.0444, 0.0, 0.04}) {
    CAPTURE(start);
    sim::Model model;
    model.oscillator = {.mass = 1.686, .stiffness = 457.0, .damping = 0.986};
    model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.0361, .frequency = 5.94};
    model.initial = {.position = start};
    model.friction = {test::law("asymmetric_coulomb", {{"kinetic_forward", 14.75}, {"kinetic_backward", 20.45}})};
    const sim::SteadyState state = sim::steady_state(model);
    REQUIRE(state.outcome.ok());
    CHECK(state.never_moves());
    const sim::History history = sim::simulate(model, {.duration = 20.0 * sim::testing::forcing_period(model)});
    const double end = 0.0361 - 14.75 / 457.0;
    CHECK(state.peak == Approx(start == 0.0 ? end : history.final.x).epsilon(1e-6));
    CHECK((history.final.x < end) == (start == 0.0));
  }
}

TEST_CASE("an orbit of slips within rounding, one period of which ends in another mode, is no candidate") {
  using friction::ParameterValues;
  const ParameterValues warming{{"power", 11.924297821804675}, {"time_constant", 6.205092480011393}};
  sim::Model model;
  model.oscillator = {.mass = 53.78239364313715, .stiffness = 4989.326568063972, .damping = 478.65923105568385};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 0.007985414876846125,
                      .frequency = 10.861171358890656};
  model.initial = {.position = 0.047790209666205126};
  model.friction = {
      test::law("contact_compliance", {{"kinetic", 0.5340922401530578},
                                       {"contact_stiffness", 9879924.736839242},
                                       {"position_slope", 256.21351589968447}}),
      test::law("coulomb", {{"kinetic", 46.11711514256353}, {"warming", std::vector<ParameterValues>{warming}}})};
  const sim::SteadyState state = sim::steady_state(model);
  INFO(state.outcome.reason);
  REQUIRE(state.outcome.ok());
  CHECK(state.never_moves());
}

TEST_CASE("a motion that repeats itself after 102 forcing periods has that in the reason") {
  // By a history of 6,000 forcing periods, its last 400 repeat those 102 before to 5e-11 of their range.
  sim::Model model;
  model.oscillator = {.mass = 0.5339988607947619, .stiffness = 242.1482813940255, .damping = 0.629};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 0.027266393153811838,
                      .frequency = 1.1762648472879838};
  model.friction = {
      test::law("coulomb", {{"kinetic", 0.782}, {"static", 2.231}, {"position_slope", -70.5696200443791}})};
  const sim::SteadyState state = sim::steady_state(model);
  CHECK(state.outcome.reason ==
        "no steady state of at most 64 forcing periods: the motion repeats itself after 102 of them");
}

TEST_CASE("a panel of many guards under many harmonics counts as several units of work, one of few as one") {
  // So a limit of work is one of processor time: measured 0.3 us a panel of the first model, 6 us of the second.
  sim::Model plain;
  plain.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 4.0};
  plain.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 7.0};
  plain.friction.emplace_back(friction::Coulomb(2.0, 2.0));
  sim::Model rich = plain;
  rich.friction.assign(3, friction::Law(friction::ContactCompliance(1.0, 1.0, 300.0, 4.0)));
  for (int order = 2; order < 9; ++order)
    rich.excitation.harmonics.push_back({.order = order, .amplitude = 0.01, .phase = 0.0});
  const auto units_of_a_count = [](const sim::Model& model) {
    sim::PeriodMap map(model);
    for (int i = 0; i < 10; ++i) REQUIRE(map.next(sim::Monodromy::without).size > 0.0);
    return static_cast<double>(map.engine().work()) / static_cast<double>(map.engine().count().work());
  };
  CHECK(units_of_a_count(plain) == 1.0);
  CHECK(units_of_a_count(rich) > 3.0);
}

TEST_CASE("a pendulum that turns over and over is said to rotate") {
  sim::Model model;
  model.oscillator = {.mass = 0.3, .stiffness = 3.0, .damping = 0.02};
  model.oscillator.gravity_stiffness = 3.0;
  model.friction = {test::law("coulomb", {{"kinetic", 0.05}})};
  // An independent integration advances by exactly two turns in two forcing periods.
  model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 2.0, .frequency = 2.0};
  const std::string reason = sim::steady_state(model).outcome.reason;
  CAPTURE(reason);
  CHECK(reason.find("the pendulum rotates, by 64 turns in 64 forcing periods") != std::string::npos);
  // Below, it swings.
  model.excitation.amplitude = 0.5;
  CHECK(sim::steady_state(model).outcome.ok());
}
