/// A mass that friction holds between the stops of a play: it creeps at speeds, and over distances, that no step
/// knows. Friction changes its sign within exp(-60) of the reference velocity.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "friction_models/laws/free_play.hpp"
#include "sim/motion/simulate.hpp"
#include "tests/support/make_law.hpp"

namespace {

using namespace dualdamp;
using test::law;

/// `rock`: normal force [N], mu0, a, b, slip distance [m], reference velocity [m/s]; `play`: kinetic and static
/// friction [N], play [m].
sim::Model play_beside_rock(double amplitude, double frequency, const std::array<double, 6>& rock,
                            const std::array<double, 3>& play) {
  sim::Model model;
  model.oscillator = {.mass = 0.284, .stiffness = 7707.0, .damping = 18.7};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = amplitude, .frequency = frequency};
  model.friction = {law("rate_state", {{"normal_force", rock[0]},
                                       {"mu0", rock[1]},
                                       {"a", rock[2]},
                                       {"b", rock[3]},
                                       {"slip_distance", rock[4]},
                                       {"reference_velocity", rock[5]}}),
                    law("free_play", {{"kinetic", play[0]}, {"static", play[1]}, {"play", play[2]}})};
  return model;
}

sim::Model released_at_balance() {
  return play_beside_rock(0.006426001013864933, 19.058057069630706,
                          {15.415313854822374, 1.0245026313708423, 0.017075043856180704, 0.01341863402542959,
                           5.889927012742264e-05, 0.005844370791008396},
                          {4.3388973742755805, 4.3388973742755805, 7.915733740739436e-05});
}

sim::Model turned_steeply() {
  return play_beside_rock(0.00546345012458855, 31.219020565985,
                          {15.678763939707327, 0.8346484941489366, 0.01391080823581561, 0.02050896625899154,
                           0.0004041173784984019, 0.001026657017093031},
                          {0.7336038493267623, 0.7336038493267623, 0.000108528450986457});
}

sim::Model creeps_off_a_stop() {
  return play_beside_rock(0.004994729698313592, 74.98840236572123,
                          {24.841172958929896, 0.4341347251802003, 0.007235578753003338, 0.011998015955672865,
                           0.00010143116052552237, 0.004360831525362576},
                          {6.235208710847468, 8.105771324101708, 0.0005159982968578627});
}

/// All events but grazings; the last one is before `end` [s].
std::vector<sim::Event> listed_events(sim::Model model, double tolerance, sim::SolverKind kind, double end) {
  model.solver = {kind, tolerance};
  sim::History history = sim::simulate(model, {.duration = end});
  INFO(history.outcome.reason);
  REQUIRE(history.outcome.ok());
  std::erase_if(history.events, [](const sim::Event& event) { return event.kind == sim::EventKind::grazing; });
  return history.events;
}

void check_same_events(const sim::Model& model, double end) {
  const std::vector<sim::Event> some = listed_events(model, 1e-11, sim::SolverKind::automatic, end);
  const std::vector<sim::Event> others = listed_events(model, 1e-13, sim::SolverKind::implicit_steps, end);
  REQUIRE(some.size() == others.size());
  for (std::size_t i = 0; i < some.size(); ++i) {
    CAPTURE(i, some[i].t, others[i].t);
    CHECK(some[i].kind == others[i].kind);
    CHECK(std::abs(some[i].x - others[i].x) < 1e-10);
  }
}

}  // namespace

TEST_CASE("creep in a play: a mass that is released where its forces balance does not turn", "[sim][smooth]") {
  // k (A cos wt - x) = 0 at the release. Explicit steps took the mass into rounding at 7e-11 m/s, and two
  // reversals.
  const sim::Model model = released_at_balance();
  const std::vector<sim::Event> events = listed_events(model, 1e-11, sim::SolverKind::automatic, 0.06);
  REQUIRE(events.size() == 4);
  CHECK(events[1].kind == sim::EventKind::stop);
  CHECK(events[2].kind == sim::EventKind::release);
  CHECK(events[2].t == Approx(std::acos(events[2].x / 0.006426001013864933) / 19.058057069630706).epsilon(1e-11));
  CHECK(events[3].kind == sim::EventKind::switching);
  check_same_events(model, 0.06);
}

TEST_CASE("creep in a play: a mass turns although its rounding hides it", "[sim][smooth]") {
  // SciPy's DOP853: the turn is 0.01737260148 s after the play closes. At a tolerance of 1e-13 of the few
  // micrometres with which the slip began, its end was found 1.27 ms late.
  for (const double tolerance : {1e-11, 1e-13}) {
    const std::vector<sim::Event> events =
        listed_events(turned_steeply(), tolerance, sim::SolverKind::implicit_steps, 0.02);
    CAPTURE(tolerance);
    REQUIRE(events.size() == 2);
    CHECK(events[1].kind == sim::EventKind::reversal);
    CHECK(std::abs(events[1].t - events[0].t - 0.01737260148) < 1e-9);
  }
}

TEST_CASE("creep in a play: a mass that creeps off a stop does not meet it again", "[sim][smooth]") {
  // The play closed in the wrong direction, and its element drove the mass: it gave 0.7 % of the speed half a
  // period later.
  check_same_events(creeps_off_a_stop(), 0.14);
}

TEST_CASE("creep in a play: a stop refuses a slip that moves away from it", "[friction][free_play]") {
  const friction::FreePlay play(2.0, 3.0, 0.01);
  for (const int side : {1, -1}) {
    const friction::Trigger stop{side == 1 ? 0 : 1};
    const friction::Instant at_stop{.x = 1.0 + side * 0.005};
    friction::Memory away{.state = {1.0}};
    play.jump(away, stop, at_stop, side == 1 ? friction::Direction::backward : friction::Direction::forward);
    CHECK(away.mode == 0);
    CHECK(away.state.at(0) == Approx(1.0).epsilon(1e-15));
    friction::Memory against{.state = {1.0}};
    play.jump(against, stop, at_stop, side == 1 ? friction::Direction::forward : friction::Direction::backward);
    CHECK(against.mode == side);
    CHECK(against.state.empty());
  }
}
