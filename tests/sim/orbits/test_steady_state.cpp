#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "friction_models/laws/attached_mass.hpp"
#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "friction_models/laws/dahl.hpp"
#include "friction_models/laws/rate_state.hpp"
#include "friction_models/laws/viscous_saturating.hpp"
#include "sim/analytic/den_hartog.hpp"
#include "sim/curves/curves.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/support/base_driven.hpp"

namespace {

using namespace dualdamp;
using test::base_driven;
using test::coulomb;

/// The stick-slip case: m = 1, k = 1, c = 0, 0.6 N, force 1 N cos(0.5 t).
sim::Model stick_slip() {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.0};
  model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 1.0, .frequency = 0.5};
  model.friction.emplace_back(friction::Coulomb(0.6, 0.6));
  return model;
}

}  // namespace

TEST_CASE("the standard case agrees with Den Hartog to the last digits") {
  const sim::SteadyState state =
      sim::steady_state(base_driven({.k = 100.0, .c = 4.0, .Y = 0.1, .w = 10.0}, coulomb(2.0)));
  REQUIRE(state.outcome.ok());
  // Eq (3) with exact G and H, to 21 digits.
  CHECK(std::abs(state.peak - 0.186078097956786198557) < 2e-14);
  CHECK(std::abs(state.trough + 0.186078097956786198557) < 2e-14);
  CHECK(std::abs(state.amplitude - 0.186078097956786198557) < 2e-14);
  CHECK(state.stops_per_cycle == 0);
  CHECK(state.sticks.empty());
  CHECK(state.stable());
  CHECK(state.warnings.empty());
  // Friction dissipates 4 F x0 in a period on any orbit with two reversals; the work of the base is that of
  // friction and damper.
  CHECK(state.energy.friction == Approx(4.0 * 2.0 * state.peak).epsilon(1e-13));
  CHECK(std::abs(state.energy.defect) < 1e-13 * state.energy.input);
  // Only the fundamental of x meets the harmonic base: pi k Y X1 sin(phase) = 4 F x0 + c int v^2.
  const double input = std::numbers::pi * 100.0 * 0.1 * state.fundamental * std::sin(state.phase);
  const double dissipated = 4.0 * 2.0 * state.peak + 4.0 * state.mean_square_speed * state.period;
  CHECK(std::abs(input - dissipated) < 1e-13 * input);
  CHECK(std::abs(state.energy.viscous - 4.0 * state.mean_square_speed * state.period) < 1e-14 * input);
}

TEST_CASE("200 random orbits that do not stick agree with Den Hartog") {
  std::mt19937_64 random(20261121);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  double worst = 0.0;
  double worst_phase = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double m = std::exp(uniform(-2.0, 2.0));
    const double k = std::exp(uniform(0.0, 9.0));
    const double zeta = std::exp(uniform(-5.0, 0.7));
    const double r = std::exp(uniform(-1.5, 1.0));
    const double force = std::exp(uniform(-3.0, 3.0));
    const auto functions = sim::analytic::den_hartog(zeta, r);
    const double x_f = force / k;
    const double Y = x_f / sim::analytic::non_sticking_boundary(functions) * std::exp(uniform(0.02, 3.0));
    const auto expected = sim::analytic::non_sticking_state(functions, Y, x_f);
    REQUIRE(expected);
    const sim::SteadyState state = sim::steady_state(base_driven({.m = m,
                                                                  .k = k,
                                                                  .c = 2.0 * zeta * std::sqrt(m * k),
                                                                  .Y = Y,
                                                                  .w = r * std::sqrt(k / m),
                                                                  .phase = uniform(0.0, 6.0)},
                                                                 coulomb(force)));
    REQUIRE(state.outcome.ok());
    worst = std::max(worst, std::abs(state.amplitude / expected->amplitude - 1.0));
    worst_phase =
        std::max(worst_phase, std::abs(std::remainder(state.phase - expected->phase, 2.0 * std::numbers::pi)));
  }
  CHECK(worst < 1e-12);
  CHECK(worst_phase < 1e-11);
}

TEST_CASE("the stick-slip case has the peak and the sticks of its closed form") {
  // A slip from rest at -X that ends at X, x'' + x = cos(t/2) - 0.6 from |cos(t/2) + X| = 0.6 on, solved for X in
  // 40 digits.
  const sim::SteadyState state = sim::steady_state(stick_slip());
  REQUIRE(state.outcome.ok());
  CHECK(std::abs(state.peak - 1.2515943400339361) < 1e-12);
  CHECK(state.stops_per_cycle == 2);
  REQUIRE(state.sticks.size() == 2);
  for (const sim::Stick& stick : state.sticks) {
    CHECK(std::abs(stick.duration - 1.3755743369215955) < 1e-12);
    CHECK(std::abs(std::abs(stick.position) - 1.2515943400339361) < 1e-12);
  }
  // After a stick the motion does not depend on the former speed: the map has one dimension left, the place of the
  // stick.
  CHECK(std::abs(state.multipliers[0] * state.multipliers[1]) < 1e-12);
  CHECK(state.stable());
}

TEST_CASE("a stick across the period boundary counts once") {
  sim::Model model = stick_slip();
  const sim::SteadyState plain = sim::steady_state(model);
  // Shift time by the middle of the second stick, which then contains t = 0.
  const double shift = plain.sticks[1].start + 0.5 * plain.sticks[1].duration;
  model.excitation.phase = 0.5 * shift;
  const sim::SteadyState shifted = sim::steady_state(model);
  REQUIRE(shifted.sticks.size() == 2);
  CHECK(shifted.stops_per_cycle == 2);
  CHECK(shifted.peak == Approx(plain.peak).epsilon(1e-13));
  for (const sim::Stick& stick : shifted.sticks) {
    CHECK(stick.duration == Approx(1.3755743369215955).epsilon(1e-12));
    CHECK(stick.start >= 0.0);
    CHECK(stick.start < shifted.period);
  }
}

TEST_CASE("the Floquet multipliers are those of a difference quotient of the period map") {
  const sim::Model model = base_driven({.m = 1.3, .k = 80.0, .c = 0.9, .Y = 0.06, .w = 7.1}, coulomb(1.1));
  const sim::SteadyState state = sim::steady_state(model);
  REQUIRE(state.outcome.ok());
  const auto map = [&](double x, double v) {
    sim::Model from = model;
    from.initial = {x, v};
    const sim::Sample end = sim::simulate(from, {.duration = state.period}).final;
    return std::array<double, 2>{end.x, end.v};
  };
  // Central differences of an exact map: h^2 truncation, 1e-16/h rounding.
  const double h = 1e-6;
  const auto x_up = map(state.start.x + h, state.start.v);
  const auto x_down = map(state.start.x - h, state.start.v);
  const auto v_up = map(state.start.x, state.start.v + h);
  const auto v_down = map(state.start.x, state.start.v - h);
  const double a = (x_up[0] - x_down[0]) / (2.0 * h);
  const double b = (v_up[0] - v_down[0]) / (2.0 * h);
  const double c = (x_up[1] - x_down[1]) / (2.0 * h);
  const double d = (v_up[1] - v_down[1]) / (2.0 * h);
  const std::complex<double> sum = state.multipliers[0] + state.multipliers[1];
  const std::complex<double> product = state.multipliers[0] * state.multipliers[1];
  CHECK(sum.real() == Approx(a + d).margin(1e-8));
  CHECK(product.real() == Approx(a * d - b * c).margin(1e-8));
}

TEST_CASE("1,000 forcing periods balance their energy, sticking included") {
  for (const sim::Model& model :
       {stick_slip(), base_driven({.k = 100.0, .c = 4.0, .Y = 0.1, .w = 10.0}, coulomb(2.0)),
        base_driven({.k = 100.0, .c = 1.0, .Y = 0.05, .w = 3.0}, coulomb(1.0, 1.4))}) {
    const double period = 2.0 * std::numbers::pi / model.excitation.frequency;
    const sim::History history = sim::simulate(model, {.duration = 1000.0 * period});
    REQUIRE(history.outcome.ok());
    // Each work is a compensated sum of quadratures that are exact to rounding.
    CHECK(std::abs(history.energy.defect) < 1e-12 * history.energy.input);
    CHECK(history.energy.friction > 0.0);
  }
}

TEST_CASE("no number is returned where there is none") {
  SECTION("resonance without damping and with friction below (pi/4) k Y grows without bound") {
    const sim::SteadyState state = sim::steady_state(base_driven({}, coulomb(0.5)));
    CHECK(state.outcome.kind == core::OutcomeKind::no_steady_state);
    CHECK(state.outcome.reason.find("grows") != std::string::npos);
    // Growth in proportion to time; it can first be recognised after 2,000 periods.
    CHECK(state.transient_periods < 2010);
  }
  SECTION("a viscous force that saturates below what the drive puts in") {
    // At large amplitude the drive's fundamental k Y = 3 N stands against (4/pi)(F0 + c v0) = 2.5 N.
    sim::Model model = base_driven({.Y = 3.0}, coulomb(1.0));
    model.friction.emplace_back(friction::ViscousSaturating(2.0, 0.5));
    const sim::SteadyState state = sim::steady_state(model);
    CHECK(state.outcome.kind == core::OutcomeKind::no_steady_state);
    CHECK(state.outcome.reason.find("grows") != std::string::npos);
    CHECK(state.transient_periods < 4010);
  }
  SECTION("the same beside a smooth law, whose work ends before growth is certain") {
    sim::Model model = base_driven({.k = 100.0, .Y = 0.3, .w = 10.0}, coulomb(0.0));
    model.friction.clear();
    model.friction.emplace_back(friction::Dahl(3.0, 1000.0, 1.0));
    const sim::SteadyState state = sim::steady_state(model);
    CHECK(state.outcome.kind == core::OutcomeKind::no_steady_state);
    CHECK(state.outcome.reason.find("grows") != std::string::npos);
    CHECK(state.transient_periods < 2000);
  }
  SECTION("so little below that limit that growth does not show in 20,000 periods") {
    const sim::SteadyState state =
        sim::steady_state(base_driven({.k = 100.0, .Y = 0.1, .w = 10.0}, coulomb(7.85398)));
    CHECK(state.outcome.kind == core::OutcomeKind::no_steady_state);
    CHECK(state.outcome.reason.find("grows without bound") != std::string::npos);
  }
  SECTION("just above that limit it is bounded") {
    CHECK(sim::steady_state(base_driven({}, coulomb(0.79))).outcome.ok());
  }
  SECTION("negative damping") {
    const sim::SteadyState state =
        sim::steady_state(base_driven({.k = 100.0, .c = -1.0, .Y = 0.1, .w = 10.0}, coulomb(2.0)));
    CHECK(state.outcome.kind == core::OutcomeKind::no_steady_state);
  }
  SECTION("nothing damps: the transient beats for ever") {
    const double r = GENERATE(0.7, 0.7001, 0.83, 0.917, 0.9901, 1.013, 1.37);
    const sim::SteadyState state = sim::steady_state(base_driven({.w = r}, coulomb(0.0)));
    CAPTURE(r);
    CHECK(state.outcome.kind == core::OutcomeKind::no_steady_state);
    CHECK(state.outcome.reason.find("grows") == std::string::npos);
  }
  SECTION("a continuum of orbits at r = 1/2 without viscous damping") {
    const sim::SteadyState state = sim::steady_state(base_driven({.w = 0.5}, coulomb(0.1)));
    CHECK(state.outcome.kind == core::OutcomeKind::not_unique);
    CHECK(state.outcome.reason.find("not unique") != std::string::npos);
  }
}

TEST_CASE("a drive that friction holds leaves the mass where it was, and says so") {
  sim::Model model = base_driven({.c = 0.1, .w = 0.7}, coulomb(2.0));
  model.initial.position = 0.3;
  const sim::SteadyState state = sim::steady_state(model);
  REQUIRE(state.outcome.ok());
  CHECK(state.amplitude == 0.0);
  CHECK(state.peak == 0.3);
  CHECK(state.stops_per_cycle == 0);
  REQUIRE(state.sticks.size() == 1);
  CHECK(state.sticks[0].duration == Approx(state.period).epsilon(1e-14));
  CHECK(state.stable());
  CHECK_FALSE(state.warnings.empty());
}

TEST_CASE("low frequencies stop more than twice a period") {
  // After each reversal of the base the mass follows in several slips: 2, 4, 6 stops as the drive becomes slower.
  CHECK(sim::steady_state(base_driven({.c = 0.02, .w = 0.2}, coulomb(0.3))).stops_per_cycle == 2);
  CHECK(sim::steady_state(base_driven({.c = 0.02, .w = 0.1}, coulomb(0.3))).stops_per_cycle == 4);
  CHECK(sim::steady_state(base_driven({.c = 0.02, .w = 0.07}, coulomb(0.3))).stops_per_cycle == 6);
}

TEST_CASE("an x-Y curve carries failed points as rows with a reason") {
  // Friction of 0.5 N limits an undamped resonance up to Y = 0.5/(pi/4).
  const sim::Curve curve = sim::xy_curve(base_driven({}, coulomb(0.5)), {0.3, 0.6, 1.0});
  REQUIRE(curve.points.size() == 3);
  CHECK(curve.points[0].ok());
  CHECK(curve.points[0].x == 0.0);
  CHECK(curve.points[1].ok());
  CHECK(curve.points[1].x > 0.0);
  CHECK_FALSE(curve.points[2].ok());
  CHECK_FALSE(curve.reason(curve.points[2]).empty());
}

TEST_CASE("the certificate of a curve is the sum of its points'") {
  // Static friction above kinetic: none of the points is found in a pack.
  const sim::Model model = base_driven({.k = 100.0, .c = 1.0, .Y = 0.05, .w = 10.0}, coulomb(0.5, 0.6));
  core::SearchCount sum;
  for (const double omega : {5.0, 10.0, 20.0}) {
    sim::Model point = model;
    point.excitation.frequency = omega;
    const sim::SteadyState state = sim::steady_state(point);
    // Two reversals and the end of the period: three searches in each computed period.
    CHECK(state.certificate.searches >= 3 * (1 + state.newton_steps));
    CHECK(state.certificate.panels >= state.certificate.searches);
    sum += state.certificate;
  }
  const core::SearchCount found = sim::frequency_response(model, {5.0, 10.0, 20.0}).certificate;
  CHECK(found.searches == sum.searches);
  CHECK(found.panels == sum.panels);
  CHECK(found.splits == sum.splits);
  CHECK(found.grazings == sum.grazings);
}

TEST_CASE("a frequency response keeps its order and peaks near resonance") {
  const auto curve = sim::frequency_response(
                         base_driven({.k = 100.0, .c = 1.0, .Y = 0.05, .w = 10.0}, coulomb(0.5)), {5.0, 10.0, 20.0})
                         .points;
  REQUIRE(curve.size() == 3);
  CHECK(curve[0].omega == 5.0);
  CHECK(curve[1].x > curve[0].x);
  CHECK(curve[1].x > curve[2].x);
  // The phase lag goes from 0 through a quarter turn to a half turn.
  CHECK(curve[0].phase < 0.5 * std::numbers::pi);
  CHECK(curve[2].phase > 0.5 * std::numbers::pi);
}

TEST_CASE("the energy account resolves a transient far faster than the motion") {
  // c/m = 20,000 1/s against k/c = 0.005 1/s: seven decades between the two exponents.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 2e4};
  model.initial = {.position = 1.0, .velocity = 5.0};
  const sim::History history = sim::simulate(model, {.duration = 10.0});
  REQUIRE(history.outcome.ok());
  CHECK(history.energy.viscous > 0.0);
  CHECK(std::abs(history.energy.defect) < 1e-12 * history.energy.viscous);
}

TEST_CASE("one period of samples closes and shows the numbers of its steady state") {
  for (const sim::Model& model :
       {base_driven({.k = 100.0, .c = 4.0, .Y = 0.1, .w = 10.0}, coulomb(2.0)), stick_slip()}) {
    const sim::SteadyState state = sim::steady_state(model);
    REQUIRE(state.outcome.ok());
    const std::vector<sim::Sample> orbit = sim::one_period(model, state, 1000);
    REQUIRE(orbit.size() == 1001);
    CHECK(orbit.back().t == Approx(state.period).epsilon(1e-12));
    CHECK(orbit.back().x == Approx(orbit.front().x).margin(1e-12 * state.amplitude));
    CHECK(orbit.back().v == Approx(orbit.front().v).margin(1e-12 * state.max_speed));
    double peak = 0.0;
    double fastest = 0.0;
    for (const sim::Sample& sample : orbit) {
      peak = std::max(peak, sample.x);
      fastest = std::max(fastest, std::abs(sample.v));
    }
    // Between samples the parabola through a peak loses (pi/1000)^2/2 of it.
    CHECK(peak == Approx(state.peak).epsilon(1e-5));
    CHECK(fastest == Approx(state.max_speed).epsilon(1e-5));
  }
}

TEST_CASE(
    "a contact that chatters is followed for so many periods as its events allow, and the reason says how many") {
  // 1,260 searches for events in a forcing period: 8,000 periods would take half a minute.
  sim::Model model;
  model.oscillator = {.mass = 25.8854440222061, .stiffness = 29.464560568384144, .damping = -0.526931409706663};
  model.excitation = {.type = sim::ExcitationType::base_harmonic,
                      .amplitude = 0.0002442174311547273,
                      .frequency = 0.07415230919184149};
  model.excitation.harmonics = {{.order = 4, .amplitude = 3.3769694588216337e-07, .phase = 3.267410907817765}};
  model.friction = {friction::Law(
      friction::ContactCompliance(0.00554379499995696, 0.009153992635209725, 65803.55565032351, 0.0))};
  model.initial = {0.0017438533177979965, -7.102567474888547e-05};
  const sim::SteadyState state = sim::steady_state(model);
  REQUIRE_FALSE(state.outcome.ok());
  CHECK(state.transient_periods < 2000);
  CHECK_THAT(state.outcome.reason,
             Catch::Contains("within " + std::to_string(state.transient_periods) + " forcing periods"));
  CHECK(state.certificate.panels < 6'000'000);
}

TEST_CASE("a search whose panels are split thousands of times each ends too") {
  // A mass that oscillates on a stiff contact a hundred thousand times in a period: 150 searches take 0.6 s.
  sim::Model model;
  model.oscillator = {.mass = 0.0034313611325045286, .stiffness = 0.05705331160642706, .damping = 0.00028};
  model.excitation = {
      .type = sim::ExcitationType::base_harmonic, .amplitude = 0.55, .frequency = 0.00874825766303915};
  model.friction = {friction::Law(
      friction::ContactCompliance(0.0676619972434493, 0.0676619972434493, 261671.28568546916, 4.7e-8))};
  const sim::SteadyState state = sim::steady_state(model);
  REQUIRE_FALSE(state.outcome.ok());
  CHECK_THAT(state.outcome.reason, Catch::Contains("the computation was stopped"));
  CHECK(state.certificate.splits < 10'000'000);
}

TEST_CASE("a mass that creeps to where friction holds it rests, and is no subharmonic") {
  // A drive below the friction force that begins with a stretched spring: each period ends nearer to the place
  // where spring and drive together just do not move the mass, k x + k3 x^3 = -(F0 - A), but never reaches it.
  for (const double cubic : {0.0, 3.598}) {
    CAPTURE(cubic);
    sim::Model model;
    model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.8722, .cubic_stiffness = cubic};
    model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 0.07669, .frequency = 3.4493};
    model.initial = {.position = -23.06, .velocity = -4.5719};
    model.friction.emplace_back(friction::Coulomb(0.12394, 0.12394));
    const sim::SteadyState state = sim::steady_state(model);
    REQUIRE(state.outcome.ok());
    CHECK(state.amplitude == 0.0);
    CHECK(state.period_ratio == 1);
    CHECK(state.stops_per_cycle == 0);
    CHECK(state.max_speed == 0.0);
    CHECK(state.energy.friction == 0.0);
    REQUIRE(state.sticks.size() == 1);
    CHECK(state.sticks.front().duration == state.period);
    CHECK(state.others.empty());
    CHECK_THAT(state.warnings.back(), Catch::Contains("only in the limit"));
    const double x = state.peak;
    CHECK(x + cubic * x * x * x == Approx(-(0.12394 - 0.07669)).epsilon(1e-5));
    for (const sim::Sample& sample : sim::one_period(model, state, 10)) {
      CHECK(sample.x == x);
      CHECK(sample.v == 0.0);
    }
  }
}

TEST_CASE("a mass whose slips of many periods rounding hides rests, and is no subharmonic") {
  // Each of 64 slips is below the tolerance, but their sum is not: 7.7e-12 m of 0.073 m.
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 0.7008, .cubic_stiffness = 2.1232};
  model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 0.04961, .frequency = 3.3242};
  model.initial = {.position = -22.201};
  model.friction.emplace_back(friction::Coulomb(0.12394, 0.12394));
  const sim::SteadyState state = sim::steady_state(model);
  REQUIRE(state.outcome.ok());
  CHECK(state.amplitude == 0.0);
  CHECK(state.period_ratio == 1);
  CHECK(state.period == Approx(2.0 * std::numbers::pi / 3.3242));
  REQUIRE(state.sticks.size() == 1);
  CHECK(state.sticks.front().duration == state.period);
  for (const std::string& warning : state.warnings) CHECK_THAT(warning, !Catch::Contains("subharmonic"));
}

TEST_CASE("a motion that winds towards its orbit has the period of that orbit") {
  // Floquet multipliers 0.854 exp(+-1.2 i): the motion comes back within the tolerance after two forcing periods
  // before it does after one.
  sim::Model model;
  model.oscillator = {
      .mass = 1.0, .stiffness = 1.0, .damping = 0.042354024476327225, .cubic_stiffness = 3142.717697683719};
  model.excitation = {.type = sim::ExcitationType::force_harmonic, .amplitude = 0.36, .frequency = 1.98};
  model.initial = {.position = -2.6, .velocity = -1.2};
  model.friction.emplace_back(friction::Coulomb(0.037, 0.037));
  const sim::SteadyState state = sim::steady_state(model);
  REQUIRE(state.outcome.ok());
  CHECK(state.period_ratio == 1);
  CHECK(state.peak == Approx(0.0702226118175).epsilon(1e-9));
}

TEST_CASE("a drive with harmonics of even order costs no search for a mirror image") {
  // A period whose motion reverses within exp(-187) of the reference velocity takes 500 steps, with its derivative
  // a tenth of a second. The orbit was found in 0.3 s, and a mirror image, which there cannot be, not in 20 s. Peak
  // and trough are those of another integrator, which closes this orbit to 1e-9.
  sim::Model model;
  model.oscillator = {.mass = 0.0029785579746387132,
                      .stiffness = 28.53777269754676,
                      .damping = 0.012454760455115173,
                      .damper_to = sim::DamperTo::base};
  model.excitation = {
      .type = sim::ExcitationType::base_harmonic,
      .amplitude = 0.002751113759152524,
      .frequency = 29.493605238036356,
      .harmonics = {{4, 0.0011408909672623463, 2.0361431606662213}, {6, 6.579654904758664e-06, 2.997395692366217}}};
  model.friction.emplace_back(friction::RateState({.normal_force = 0.021571869059225684,
                                                   .mu0 = 0.765754362463864,
                                                   .a = 0.0040893832861653365,
                                                   .b = 0.006125979791459921,
                                                   .slip_distance = 3.2167233369958305e-05,
                                                   .reference_velocity = 8.435410524011105e-06,
                                                   .evolution = friction::RateState::Evolution::slip}));
  model.friction.emplace_back(
      friction::AttachedMass(0.00048269256483096467, 0.6506049572918766, 6.196017191715506e-05));
  const sim::SteadyState state = sim::steady_state(model);
  REQUIRE(state.outcome.ok());
  CHECK(state.peak == Approx(0.0049755170313).epsilon(1e-9));
  CHECK(state.trough == Approx(-0.0042462242982).epsilon(1e-9));
  CHECK(state.others.empty());
  CHECK(state.certificate.searches < 100'000);
}
