/// When the smooth engine changes the mode of a law: guards at the start of an interval.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/engine/engine.hpp"
#include "sim/motion/simulate.hpp"
#include "tests/support/make_law.hpp"

namespace {

using namespace dualdamp;
using test::law;

/// A rate of force that pulls a mass on two stiff contacts, 2e8 times as far from the origin as they yield.
sim::Model far_from_the_origin(double sign) {
  sim::Model model;
  model.oscillator = {.mass = 0.4604051369455579, .stiffness = 656.3990647806602, .damping = -6.95216605897345};
  model.excitation = {.type = sim::ExcitationType::force_ramp, .slope = sign * 71.91650109581133};
  model.friction = {law("normal_vibration", {{"mu", 0.25177030343458695},
                                             {"weight", 0.0006476562672013205},
                                             {"static_approach", 4.7519506462020065e-05},
                                             {"normal_mass", 0.00010649268853514345},
                                             {"normal_damping_ratio", 0.4286850890827293},
                                             {"lift_velocity", 1.8603742993975692},
                                             {"lift", 0.0001086298073847181}}),
                    law("iwan", {{"stiffness", 4291824297.705205}, {"limit", 2.7668776787519214}, {"count", 16.0}}),
                    law("contact_compliance", {{"kinetic", 0.14808344997588832},
                                               {"contact_stiffness", 619776325.0803677},
                                               {"contact_damping", 959.2650110258569}})};
  return model;
}

/// rate_state with mu0/a = 28: at the end of a slip the mass creeps on, at speeds that an explicit step does not
/// resolve.
sim::Model creeping_rock() {
  sim::Model model;
  model.oscillator = {.mass = 0.01652273347721008, .stiffness = 870.5875366082995, .damping = 0.14186497616955548};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 0.0034984464181995866,
                      .frequency = 2175.4498929126976};
  friction::ParameterValues values = {
      {"normal_force", 0.406324690465511}, {"mu0", 0.5618171780554464},
      {"a", 0.019776031819866667},         {"b", 0.018861725783272082},
      {"slip_distance", 0.00017359019315}, {"reference_velocity", 0.0017801741441657}};
  values.set("evolution", "slip");
  model.friction = test::laws_of("rate_state", std::move(values));
  model.initial = {.position = 0.00979809818240596};
  return model;
}

/// Coulomb friction of 60 N beside a state that follows the speed and changes no force. Its sign is the mode. While
/// the mass sticks, the state dies out, and only the rounding of steps longer than that takes it through zero.
class Fading {
 public:
  explicit Fading(double time) : time_(time) {}
  [[nodiscard]] friction::Memory start(const friction::Instant& now) const {
    return {.mode = now.v < 0.0 ? -1 : 1, .state = {now.v}};
  }
  [[nodiscard]] double respond(const friction::Memory& memory, const friction::Instant& now,
                               friction::Direction direction, std::span<double> rates) const {
    rates[0] = (now.v - memory.state[0]) / time_;
    return friction::sign(direction) * 60.0;
  }
  [[nodiscard]] double static_limit(const friction::Memory&, const friction::Instant&) const { return 60.0; }
  void scales(const friction::Memory&, std::span<double> scales) const { scales[0] = 0.01; }
  void guards(const friction::Memory& memory, const friction::Instant&, friction::Direction,
              std::vector<double>& values) const {
    values.push_back(memory.mode * memory.state[0]);
  }
  void jump(friction::Memory& memory, friction::Trigger trigger, const friction::Instant&,
            friction::Direction) const {
    if (trigger.cause == 0) memory.mode = -memory.mode;
  }

 private:
  double time_;
};

}  // namespace

TEST_CASE("smooth engine: a step to a zero that recedes does not pass over a release", "[sim][smooth]") {
  // Explicit steps of more than ten times the decay of the state. Newton's method, which found no zero of it, went
  // on until the pull was 8.73, 2.59 and 3.78 N beyond the limit.
  struct Case {
    double time;       // s
    double frequency;  // rad/s
    double amplitude;  // m
  };
  for (const auto& [time, frequency, amplitude] :
       {Case{0.0010019635280998059, 25.540649948376188, 0.0060147303947762631},
        Case{0.00097002646278163205, 23.054130802915612, 0.00661984457812955},
        Case{0.00057604644842892364, 32.912924303041407, 0.0058478985841786939}}) {
    sim::Model model;
    model.oscillator = {.mass = 5.7, .stiffness = 15400.0, .damping = 229.0};
    model.solver.kind = sim::SolverKind::explicit_steps;
    model.friction = {friction::Law(Fading(time))};
    model.excitation = {
        .type = sim::ExcitationType::base_harmonic, .amplitude = amplitude, .frequency = frequency, .phase = 1.16};
    int releases = 0;
    for (const sim::Event& event : sim::simulate(model, {.duration = 30.0 / frequency}).events) {
      if (event.kind != sim::EventKind::release) continue;
      ++releases;
      const double pull = 15400.0 * (amplitude * std::cos(frequency * event.t + 1.16) - event.x);
      CAPTURE(time, event.t, event.x);
      CHECK(std::abs(pull) == Approx(60.0).epsilon(1e-9));
    }
    CHECK(releases == 10);
  }
}

TEST_CASE("smooth engine: a slip does not end where the forces drive the mass on", "[sim][smooth]") {
  // It must not reverse there.
  sim::Model model = creeping_rock();
  const sim::History automatic = sim::simulate(model, {.duration = 0.2});
  model.solver.kind = sim::SolverKind::implicit_steps;
  const sim::History implicit = sim::simulate(model, {.duration = 0.2});
  REQUIRE(automatic.outcome.ok());
  REQUIRE(implicit.outcome.ok());
  REQUIRE(automatic.events.size() == implicit.events.size());
  CHECK(automatic.final.x == Approx(implicit.final.x).epsilon(1e-6));
  // Explicit steps, requested by name, follow the creep: without care they would have 7,382 events.
  model.solver.kind = sim::SolverKind::explicit_steps;
  const sim::History by_name = sim::simulate(model, {.duration = 0.2});
  REQUIRE(by_name.outcome.ok());
  CHECK(by_name.events.size() == implicit.events.size());
}

TEST_CASE("smooth engine: a creep below the level of a grazing grazes nothing", "[sim][smooth]") {
  // Explicit steps that are limited by stability leave ripples of 2e-10 m/s on the speed. None of the 15 ripples is
  // a grazing.
  sim::Model model = creeping_rock();
  model.solver = {sim::SolverKind::explicit_steps, 1e-12};
  const sim::History by_name = sim::simulate(model, {.duration = 0.2});
  REQUIRE(by_name.outcome.ok());
  CHECK(std::ranges::count(by_name.events, sim::EventKind::grazing, &sim::Event::kind) == 0);
  CHECK(std::ranges::count(by_name.events, sim::EventKind::reversal, &sim::Event::kind) == 39);
}

TEST_CASE("smooth engine: a creep far below what a step may err by is followed", "[sim][smooth]") {
  // rate_state with mu0/a = 61: friction changes its sign within exp(-61) of the reference velocity. If corrections
  // of the speed had to shrink however small they are, the motion would be given up after four reversals.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 0.566};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 0.364};
  friction::ParameterValues values = {
      {"normal_force", 2.76},         {"mu0", 0.304}, {"a", 0.005}, {"b", 0.00509}, {"slip_distance", 0.00333},
      {"reference_velocity", 7.55e-5}};
  values.set("evolution", "slip");
  model.friction = test::laws_of("rate_state", std::move(values));
  const sim::History automatic = sim::simulate(model, {.duration = 20.0});
  model.solver = {sim::SolverKind::implicit_steps, 1e-12};
  const sim::History implicit = sim::simulate(model, {.duration = 20.0});
  INFO(automatic.outcome.reason << implicit.outcome.reason);
  REQUIRE(automatic.outcome.ok());
  REQUIRE(implicit.outcome.ok());
  CHECK(automatic.events.size() == 7);
  CHECK(implicit.events.size() == 7);
  CHECK(automatic.final.x == Approx(implicit.final.x).epsilon(1e-9));
}

/// A mass of 4.49 kg that rate_state with mu0/a = 27 holds between slips of a tenth of a micrometre.
sim::Model creeping_mass() {
  sim::Model model;
  model.oscillator = {.mass = 4.49, .stiffness = 6560.0, .damping = 0.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 1.12e-3, .frequency = 25.4};
  model.friction = test::laws_of("rate_state", {{"normal_force", 15.25 / 0.27},
                                                {"mu0", 0.27},
                                                {"a", 0.01},
                                                {"b", 0.012},
                                                {"slip_distance", 1e-4},
                                                {"reference_velocity", 1e-3}});
  return model;
}

TEST_CASE("smooth engine: a creeping mass turns where the forces on it turn", "[sim][smooth]") {
  // The motion computed with asinh(v exp(psi ...)/2V0) in place of the speed, which is of order 1 in a creep, by
  // SciPy's Radau: tolerances of 1e-8 and 1e-10 agree to these digits. By the speed of the steps some reversals
  // would lie 5e-5 s later, and grazings beside them.
  constexpr std::array<double, 8> known = {0.061842375, 0.185527125, 0.309211875, 0.432896626,
                                           0.556581375, 0.680266126, 0.803950876, 0.927635626};
  sim::Model model = creeping_mass();
  for (const double tolerance : {1e-9, 1e-11, 1e-13}) {
    model.solver.tolerance = tolerance;
    const sim::History history = sim::simulate(model, {.duration = 0.98});
    REQUIRE(history.outcome.ok());
    REQUIRE(history.events.size() == known.size());
    for (std::size_t i = 0; i < known.size(); ++i) {
      CHECK(history.events[i].kind == sim::EventKind::reversal);
      CHECK(std::abs(history.events[i].t - known[i]) < 1e-9);
    }
  }
}

TEST_CASE("smooth engine: a creep between two stops of a play turns once", "[sim][smooth]") {
  // Behind its first reversal the mass creeps, and the spring is relaxed at 0.33895750 s: k (V t - x) = 0 with the
  // resting place x. By the speed of the steps the play closed 0.3 to 2.4 ms later in the wrong direction, and the
  // friction of its element drove the mass back by 0.2 mm.
  sim::Model model;
  model.oscillator = {.mass = 8.59512889098173, .stiffness = 290225.7678341528, .damping = 0.0};
  model.excitation = {.type = sim::ExcitationType::base_ramp, .slope = 0.007628571138297515};
  model.friction = {
      law("rate_state", {{"normal_force", 15.75821238311935},
                         {"mu0", 0.516348856975998},
                         {"a", 0.006389946138921375},
                         {"b", 0.008765895856397353},
                         {"slip_distance", 0.0011757420653908685},
                         {"reference_velocity", 0.0009707540587758088}}),
      law("free_play",
          {{"kinetic", 55.43649852242157}, {"static", 133.00824926420725}, {"play", 0.003899643857606881}})};
  for (const double tolerance : {1e-11, 1e-13}) {
    model.solver.tolerance = tolerance;
    const sim::History history = sim::simulate(model, {.duration = 0.4});
    REQUIRE(history.outcome.ok());
    const auto reversal = std::ranges::find_if(history.events, [](const sim::Event& event) {
      return event.t > 0.337 && event.kind == sim::EventKind::reversal;
    });
    REQUIRE(reversal != history.events.end());
    CHECK(reversal->t == Approx(reversal->x / 0.007628571138297515).epsilon(1e-9));
    const auto stop = std::ranges::find(reversal, history.events.end(), sim::EventKind::stop, &sim::Event::kind);
    REQUIRE(stop != history.events.end());
    CHECK(std::abs(stop->x - reversal->x) < 1e-12);
  }
}

TEST_CASE("smooth engine: a creep that no step leaves is given up soon, with the reason", "[sim][smooth]") {
  // mu0/a = 101. Without a remedy, 300,000 steps at one instant would take 2 to 8 s.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 1.70};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 1.51};
  friction::ParameterValues values = {
      {"normal_force", 4.76},         {"mu0", 0.507}, {"a", 0.005}, {"b", 0.00419}, {"slip_distance", 2.06e-4},
      {"reference_velocity", 2.89e-6}};
  values.set("evolution", "slip");
  model.friction = test::laws_of("rate_state", std::move(values));
  const sim::History history = sim::simulate(model, {.duration = 20.0});
  CHECK(history.outcome.kind == core::OutcomeKind::event_limit);
  CHECK(history.outcome.reason.find("steps at one instant") != std::string::npos);
}

TEST_CASE("smooth engine: a contact is asked to slip at its limit, not just before", "[sim][smooth]") {
  // A step ends 1.1e-6 s before the contact reaches its limit, at 4e-13 of the terms that cancel in its force. A
  // slider that is let go there has the wrong sign of speed, by the damper of 959 N.s/m, and stops at once.
  const sim::History forward = sim::simulate(far_from_the_origin(1.0), {.duration = 0.2});
  const sim::History backward = sim::simulate(far_from_the_origin(-1.0), {.duration = 0.2});
  INFO(forward.outcome.reason << backward.outcome.reason);
  REQUIRE(forward.outcome.ok());
  REQUIRE(backward.outcome.ok());
  CHECK(std::abs(forward.final.x + backward.final.x) < 1e-7 * std::abs(forward.final.x));
}

TEST_CASE("smooth engine: a step lands on a guard by the law's own forces, however large the motion was before",
          "[sim][smooth]") {
  // From 4 m to rest at 6 mm, beside a drive of random force. Relative to the contact's force at 4 m the guard has
  // an error of 4e-12 N. By the damper this is 6e-8 m/s, with which the slider would run backward and stop at once.
  sim::Model model;
  model.oscillator = {.mass = 0.00537, .stiffness = 0.0309, .damping = 0.00187};
  model.excitation.type = sim::ExcitationType::force_noise;
  model.friction = {law("contact_compliance",
                        {{"kinetic", 0.0023127}, {"contact_stiffness", 87.4758}, {"contact_damping", 6.651e-5}})};
  model.initial = {.position = 4.374};
  for (const std::uint64_t seed : {1U, 3U, 4U}) {
    CAPTURE(seed);
    model.excitation.noise = {.intensity = 8.7e-6, .bandwidth = 25.86, .seed = seed};
    model.solver = {};
    const sim::History exact = sim::simulate(model, {.duration = 26.0});
    model.solver = {sim::SolverKind::implicit_steps, 1e-11};
    const sim::History smooth = sim::simulate(model, {.duration = 26.0});
    INFO(smooth.outcome.reason);
    REQUIRE(smooth.outcome.ok());
    CHECK(smooth.events.size() == exact.events.size());
    CHECK(std::abs(smooth.final.x - exact.final.x) < 1e-8);
  }
}

TEST_CASE("smooth engine: a contact that lets go just before the mass turns goes on sliding until it turns",
          "[sim][smooth]") {
  // Some 1e-6 s before, at 2e-5 m/s. The rounding of its force of 4e4 N, with 1e10 N/m, is a larger number, but in
  // newtons. If it counted as a speed, the slider would stop at once and let go again, without end.
  sim::Model model;
  model.oscillator = {.mass = 15318.341108344996,
                      .stiffness = 707996.3913393652,
                      .damping = 0.5079181638754942,
                      .cubic_stiffness = 58194286.033616185};
  model.excitation = {.type = sim::ExcitationType::force_ramp, .slope = -17432.258445472067};
  friction::ParameterValues bristles = {{"kinetic", 892.6498974809784},
                                        {"stribeck_velocity", 0.018119193977265358},
                                        {"attraction", 58597.698390865466}};
  bristles.set("elements",
               std::vector<friction::ParameterValues>{{{"stiffness", 68137.18458974453}, {"share", 0.25}},
                                                      {{"stiffness", 269104.17431259615}, {"share", 0.25}},
                                                      {{"stiffness", 183849.7589389365}, {"share", 0.25}},
                                                      {{"stiffness", 70132.38702643501}, {"share", 0.25}}});
  friction::ParameterValues contact = {{"kinetic", 38451.11871517457}, {"contact_stiffness", 10177528422.52051}};
  contact.set("warming", std::vector<friction::ParameterValues>{
                             {{"power", 484.24577686550083}, {"time_constant", 0.22127943109922993}}});
  model.friction = {law("generalized_maxwell_slip", bristles), law("contact_compliance", contact)};
  const sim::History history = sim::simulate(model, {.duration = 6.0});
  INFO(history.outcome.reason);
  REQUIRE(history.outcome.ok());
  CHECK(std::abs(history.energy.defect) < 1e-9 * history.energy.input);
}

TEST_CASE("smooth engine: a slider is judged by its present speed, not by that of a decay long over",
          "[sim][smooth]") {
  // The damped contact relaxes within 1e-15 s from 3e5 m/s; ten seconds later it stops where the mass does, not at
  // 3e-8 m/s, which is the rounding of the former speed.
  sim::Model model;
  model.oscillator = {.mass = 2.3901670337220833,
                      .stiffness = 0.07854940852779521,
                      .damping = 0.13678257095223942,
                      .cubic_stiffness = 3118420.205337021};
  model.excitation = {.type = sim::ExcitationType::base_ramp, .slope = -1.735585405704788e-05};
  model.friction = {law("contact_compliance", {{"kinetic", 1.4444433679902722e-07},
                                               {"static", 4.029581411153558e-07},
                                               {"contact_stiffness", 875.9381759286968},
                                               {"contact_damping", 9.4794992477594e-13}})};
  model.initial = {.position = -3.3972312529691396e-05, .velocity = 6.686877781790962e-05};
  for (const double tolerance : {1e-9, 3e-10, 1e-10, 3e-11, 1e-11, 3e-12, 1e-12, 1e-13, 3e-14}) {
    model.solver = {sim::SolverKind::implicit_steps, tolerance};
    const sim::History history = sim::simulate(model, {.duration = 30.0});
    CAPTURE(tolerance);
    REQUIRE(history.outcome.ok());
    int reversals = 0;
    for (const sim::Event& event : history.events) {
      if (event.kind == sim::EventKind::reversal) ++reversals;
    }
    CHECK(reversals == 3);
    // A slider stops with the mass, and the turn of the mass acts first however the two crossings are rounded.
    REQUIRE(history.events.size() == 10);
    for (const std::size_t i : {1U, 4U, 7U}) {
      CHECK(history.events[i].kind == sim::EventKind::reversal);
      CHECK(history.events[i + 1].t - history.events[i].t < 1e-9);
    }
  }
}

TEST_CASE("smooth engine: a mass that touches rest and goes on as before has not turned", "[sim][smooth]") {
  // rate_state with mu0/a = 76: near t = 0.0985 s the mass comes to rest to rounding, and creeps on in the same
  // direction. Judged by the speed of its steps, which is rounding, it would touch zero or turn there.
  sim::Model model;
  model.oscillator = {.mass = 0.246121975179598, .stiffness = 822.2788298276305, .damping = -3.700815580118917};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 0.03234131226537181,
                      .frequency = 10.466280765318338,
                      .harmonics = {{.order = 4, .amplitude = 6.752217206017932e-05, .phase = 3.272399025386265}}};
  friction::ParameterValues rock = {{"normal_force", 0.4468652623786342},
                                    {"mu0", 0.45326123505277643},
                                    {"a", 0.005965893127860531},
                                    {"b", 0.006145726879732284},
                                    {"slip_distance", 0.0009331701162164074},
                                    {"reference_velocity", 0.00010905217683261384}};
  rock.set("evolution", "aging");
  rock.set("fluctuation",
           std::vector<friction::ParameterValues>{
               {{"ratio", 0.6222330653928851}, {"correlation_time", 0.031710565887636176}, {"seed", 439.0}}});
  model.friction = {law("rate_state", rock), law("contact_compliance", {{"kinetic", 20.657227883758623},
                                                                        {"contact_stiffness", 1816981.3780520023},
                                                                        {"contact_damping", 0.11322588907519668}})};
  int touches = 0;
  for (const double tolerance : {1e-8, 5e-9, 1e-9, 5e-10, 1e-10, 1e-11}) {
    model.solver.tolerance = tolerance;
    const auto engine = sim::make_engine(model);
    CAPTURE(tolerance);
    while (const sim::Interval* interval = engine->next(0.105)) {
      if (interval->ending == sim::EventKind::reversal) CHECK(engine->direction() != interval->direction);
      if (interval->ending == sim::EventKind::grazing) ++touches;
    }
    CHECK(engine->outcome().ok());
  }
  CHECK(touches == 0);
}

TEST_CASE("smooth engine: what a motion says is a number up to the end of the range", "[sim][smooth]") {
  // It grows by exp(535) in a second and would reach 1e308 m/s after 1.33 s.
  sim::Model model;
  model.oscillator = {.mass = 0.129, .stiffness = 1648.0, .damping = -72.0};
  model.excitation = {.type = sim::ExcitationType::base_ramp, .slope = -0.00135};
  model.friction = {law("coulomb", {{"kinetic", 0.001}})};
  for (const sim::SolverKind kind : {sim::SolverKind::explicit_steps, sim::SolverKind::implicit_steps}) {
    model.solver.kind = kind;
    const auto engine = sim::make_engine(model);
    double fastest = 0.0;
    while (const sim::Interval* interval = engine->next(2.0)) {
      for (const double part : {0.0, 0.2, 0.5, 0.9, 1.0}) {
        const sim::Sample sample = interval->at(part * interval->duration);
        if (!std::isfinite(sample.x) || !std::isfinite(sample.v)) FAIL("not a number at " << sample.t << " s");
        fastest = std::max(fastest, std::abs(sample.v));
      }
    }
    CHECK(engine->outcome().reason == "the motion left the range of double precision");
    CHECK(fastest > 1e280);
  }
}

TEST_CASE("smooth engine: a mass between the stops of a play turns within its rounding", "[sim][smooth]") {
  // It rings on a bond by 1e-14 m, less than a step may err by. A step passed over a swing, and the slip seemed to
  // end where it began, again and again.
  sim::Model model;
  model.oscillator = {.mass = 28.849586584400438,
                      .stiffness = 1.9345833732647637,
                      .damping = 242.4374010990789,
                      .damper_to = sim::DamperTo::base};
  model.excitation = {.type = sim::ExcitationType::force_harmonic,
                      .amplitude = 0.0005774253002049363,
                      .frequency = 0.0002873501294037647,
                      .phase = 2.7928371876330345};
  friction::ParameterValues contact{{"kinetic", 8.496246762069198e-06},
                                    {"static", 9.099433582107653e-06},
                                    {"contact_stiffness", 166979.83338947687}};
  contact.set("warming", std::vector<friction::ParameterValues>{
                             {{"power", 2.1512749004972426e-08}, {"time_constant", 17.83739701264118}}});
  model.friction = {
      law("contact_compliance", std::move(contact)),
      law("free_play",
          {{"kinetic", 0.20263290489561728}, {"static", 0.9215964943572423}, {"play", 0.000633699088210587}})};
  model.initial = {.position = -0.00022153484585152978};
  const sim::History automatic = sim::simulate(model, {.duration = 1400.0});
  INFO(automatic.outcome.reason);
  REQUIRE(automatic.outcome.ok());
  model.solver = {sim::SolverKind::implicit_steps, 1e-13};
  const sim::History tight = sim::simulate(model, {.duration = 1400.0});
  REQUIRE(tight.outcome.ok());
  CHECK(automatic.events.size() == tight.events.size());
  CHECK(automatic.final.x == Approx(tight.final.x).epsilon(1e-12));
}
