// The sticking boundary of the engine against Den Hartog's closed form, which shares no code with it.

#include "sim/curves/sticking_boundary.hpp"

#include <catch2/catch.hpp>

#include "friction_models/laws/coulomb.hpp"
#include "friction_models/laws/free_play.hpp"
#include "friction_models/laws/gap_spring.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/support/make_law.hpp"
#include "tests/support/standard_system.hpp"

using namespace dualdamp;

namespace {

sim::Model model(double zeta, double kinetic, double holding) {
  sim::Model result;
  result.oscillator = {.mass = 1.0, .stiffness = 1.0, .damping = 2.0 * zeta};
  result.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 1.0, .frequency = 1.0};
  result.friction.emplace_back(friction::Coulomb(kinetic, holding));
  return result;
}

bool sticks(sim::Model model, double omega, double amplitude) {
  model.excitation.frequency = omega;
  model.excitation.amplitude = amplitude;
  const sim::SteadyState state = sim::steady_state(model);
  REQUIRE(state.outcome.ok());
  return !state.sticks.empty();
}

/// The mass sticks just below the boundary, and does not just above it.
void check_sides(const sim::Model& model, double omega) {
  const sim::BoundaryPoint point = sim::sticking_boundary(model, std::vector{omega})[0];
  CAPTURE(omega, point.amplitude, point.outcome.reason);
  REQUIRE(point.outcome.ok());
  CHECK(sticks(model, omega, 0.999 * point.amplitude));
  CHECK_FALSE(sticks(model, omega, 1.001 * point.amplitude));
}

}  // namespace

TEST_CASE("the engine's sticking boundary is Den Hartog's, from low frequencies to beyond resonance") {
  const std::vector<double> frequencies = {0.07, 0.11, 0.19, 0.31, 0.45, 0.62, 0.85, 1.0, 1.4, 2.3};
  for (const double zeta : {0.05, 0.2}) {
    for (const sim::BoundaryPoint& point : sim::sticking_boundary(model(zeta, 1.0, 1.0), frequencies)) {
      CAPTURE(zeta, point.omega, point.outcome.reason);
      REQUIRE(point.outcome.ok());
      REQUIRE(point.closed_form.has_value());
      CHECK(point.amplitude == Approx(*point.closed_form).epsilon(2e-11));
    }
  }
}

TEST_CASE("without damping the boundary at r = 3 is x_f/Y = 9/16 exactly") {
  const sim::BoundaryPoint point = sim::sticking_boundary(model(0.0, 1.0, 1.0), std::vector{3.0})[0];
  REQUIRE(point.outcome.ok());
  CHECK(1.0 / point.amplitude == Approx(9.0 / 16.0).epsilon(2e-11));
}

TEST_CASE("static friction above kinetic raises the boundary, and no closed form is claimed") {
  const std::vector<double> frequency = {0.6};
  const sim::BoundaryPoint equal = sim::sticking_boundary(model(0.05, 1.0, 1.0), frequency)[0];
  const sim::BoundaryPoint above = sim::sticking_boundary(model(0.05, 1.0, 1.5), frequency)[0];
  REQUIRE(above.outcome.ok());
  CHECK(above.amplitude > 1.01 * equal.amplitude);
  CHECK_FALSE(above.closed_form.has_value());
}

TEST_CASE(
    "Den Hartog's closed form is stated for a driving force too, and not for a spring or a drive that is not his") {
  const auto boundary = [](const sim::Model& model) { return sim::sticking_boundary(model, std::vector{0.62})[0]; };
  sim::Model forced = model(0.1, 2.0, 2.0);
  forced.oscillator.stiffness = 3.0;
  forced.excitation.type = sim::ExcitationType::force_harmonic;
  forced.oscillator.damper_to = sim::DamperTo::base;  // a base that does not move
  const sim::BoundaryPoint point = boundary(forced);
  REQUIRE(point.closed_form.has_value());
  CHECK(point.amplitude == Approx(*point.closed_form).epsilon(2e-11));
  forced.excitation.offset = 0.5;
  CHECK_FALSE(boundary(forced).closed_form.has_value());
  sim::Model hardening = model(0.1, 1.0, 1.0);
  hardening.oscillator.cubic_stiffness = 0.1;
  const sim::BoundaryPoint cubic = boundary(hardening);
  REQUIRE(cubic.outcome.ok());
  CHECK_FALSE(cubic.closed_form.has_value());
}

TEST_CASE("A drive that moves the mass at less than friction over stiffness has its boundary there") {
  // x_f = 1: each boundary lies below it, where an earlier search did not look.
  sim::Model damped = model(1.5, 1.0, 1.0);
  damped.oscillator.damper_to = sim::DamperTo::base;
  for (const double omega : {1.4, 4.0, 10.0}) check_sides(damped, omega);
  // By an independent integration with events: 2.180 and 0.7119 of x_f/100.
  const auto boundary = sim::sticking_boundary(damped, std::vector{4.0, 10.0});
  CHECK(boundary[0].amplitude == Approx(0.2180).epsilon(2e-3));
  CHECK(boundary[1].amplitude == Approx(0.07119).epsilon(2e-3));

  sim::Model structural = model(0.0, 1.0, 1.0);
  structural.oscillator.loss_factor = 2.0;
  check_sides(structural, 4.0);

  sim::Model displaced = model(0.0, 1.0, 2.0);
  displaced.oscillator.damping = 0.1;
  displaced.initial.position = 20.0;
  check_sides(displaced, 1.0);
}

TEST_CASE("a mass that slides at the weakest drive has no sticking boundary, and the reason says so") {
  sim::Model harmonics = model(0.1, 1.0, 1.0);
  harmonics.excitation.harmonics = {{.order = 3, .amplitude = 40.0}};
  const sim::BoundaryPoint moved = sim::sticking_boundary(harmonics, std::vector{0.3})[0];
  CHECK(moved.outcome.reason == "even the weakest drive moves the mass without a stick");

  sim::Model play = model(0.1, 1.0, 1.0);
  play.friction.clear();
  play.friction.emplace_back(friction::FreePlay(1.0, 1.0, 2.0));
  play.excitation.amplitude = 0.1;
  const sim::BoundaryPoint free = sim::sticking_boundary(play, std::vector{0.67})[0];
  CHECK(free.outcome.reason == "even the weakest drive moves the mass without a stick");
}

TEST_CASE(
    "where no steady state is found at the boundary, it is between an amplitude that sticks and one that slides") {
  // With static friction three times kinetic, motions at some amplitudes are aperiodic or hardly settle.
  const auto boundary = [](double zeta, double holding, double omega) {
    return sim::sticking_boundary(model(zeta, 0.2, holding), std::vector{omega})[0];
  };
  const sim::BoundaryPoint narrow = boundary(0.0, 0.6, 0.6525);
  REQUIRE_FALSE(narrow.outcome.ok());
  CHECK(narrow.sticks > 0.0);
  CHECK(narrow.slides > narrow.sticks);
  CHECK(narrow.slides < narrow.sticks * (1.0 + 1e-6));
  CHECK(sticks(model(0.0, 0.2, 0.6), 0.6525, narrow.sticks));
  CHECK_FALSE(sticks(model(0.0, 0.2, 0.6), 0.6525, narrow.slides));

  // The first amplitudes of the search have no steady state: it goes on to larger ones.
  const sim::BoundaryPoint wide = boundary(0.0, 0.6, 0.35);
  CHECK(wide.sticks > 0.0);
  CHECK(wide.slides > wide.sticks);
}

TEST_CASE("where sticking and sliding alternate over amplitude, the boundary is the first change") {
  sim::Model beside_gap;
  beside_gap.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 0.4};
  beside_gap.excitation = {.type = sim::ExcitationType::base_harmonic, .frequency = 1.0};
  beside_gap.friction.emplace_back(friction::Coulomb(0.5, 0.5));
  beside_gap.friction.emplace_back(friction::GapSpring(300.0, 0.02));
  const double omega = 1.7176304102843905;
  check_sides(beside_gap, omega);
  const sim::BoundaryPoint first = sim::sticking_boundary(beside_gap, std::vector{omega})[0];
  CHECK(first.amplitude == Approx(0.1155).epsilon(1e-3));  // the doubled amplitudes lead to 0.2128
  REQUIRE(first.sticks_again.has_value());
  CHECK(first.sticks_again->first == Approx(0.125).epsilon(0.03));
  CHECK(first.sticks_again->second == Approx(0.2128).epsilon(0.03));

  sim::Model distorted;
  distorted.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 0.1};
  distorted.excitation = {.type = sim::ExcitationType::base_harmonic,
                          .frequency = 1.0,
                          .harmonics = {{.order = 2, .amplitude = 0.02, .phase = 1.0}}};
  distorted.friction.emplace_back(friction::Coulomb(0.5, 0.5));
  const sim::BoundaryPoint second = sim::sticking_boundary(distorted, std::vector{2.2})[0];
  CHECK(second.amplitude == Approx(0.08357).epsilon(1e-3));  // the doubled amplitudes lead to 0.2253
  CHECK(second.sticks_again.has_value());
}

TEST_CASE("a scan also looks at the amplitudes of the caller; plain Coulomb friction is not scanned") {
  const std::vector<double> frequency = {0.62};
  const std::vector<double> far = {40.0};
  sim::Model hardening = model(0.05, 1.0, 1.0);
  hardening.oscillator.cubic_stiffness = 0.1;
  const auto alone = sim::sticking_boundary(hardening, frequency)[0];
  const auto beside = sim::sticking_boundary(hardening, frequency, far)[0];
  REQUIRE(alone.outcome.ok());
  CHECK(alone.amplitude == beside.amplitude);
  CHECK(sim::sticking_boundary(model(0.05, 1.0, 1.0), frequency)[0].amplitude ==
        sim::sticking_boundary(model(0.05, 1.0, 1.0), frequency, far)[0].amplitude);
}

TEST_CASE("a boundary that takes too long is given up, with the amplitudes between which it lies") {
  const auto boundary = [](const std::vector<double>& amplitudes, long most_work) {
    return sim::sticking_boundary(model(0.05, 1.0, 1.5), std::vector{0.6}, amplitudes, most_work)[0];
  };
  const sim::BoundaryPoint whole = boundary({}, sim::most_boundary_work);
  REQUIRE(whole.outcome.ok());
  CHECK_FALSE(whole.seen_up_to.has_value());

  const sim::BoundaryPoint stopped = boundary({}, whole.work / 4);
  CHECK(stopped.is_stopped);
  CHECK_THAT(stopped.outcome.reason, Catch::Contains("stopped"));
  CHECK(stopped.sticks > 0.0);
  CHECK(stopped.sticks < whole.amplitude);
  CHECK(stopped.work < whole.work / 3);

  // Of many amplitudes above the boundary only some are looked at, and the bisection still has its share.
  std::vector<double> far;
  for (int i = 0; i < 400; ++i) far.push_back((2.0 + 0.01 * i) * whole.amplitude);
  const long all = boundary(far, sim::most_boundary_work).work;
  const sim::BoundaryPoint above = boundary(far, all / 2);
  REQUIRE(above.outcome.ok());
  CHECK(above.amplitude == whole.amplitude);
  REQUIRE(above.seen_up_to.has_value());
  CHECK(*above.seen_up_to > above.amplitude);
  CHECK(*above.seen_up_to < far.back());
}

TEST_CASE("where contacts yield from the first motion on, the mass never sticks, and nothing is computed") {
  for (const friction::Law& law : {test::law("dahl", {{"kinetic", 2.0}, {"sigma0", 2000.0}, {"exponent", 1.5}}),
                                   test::law("iwan", {{"stiffness", 80.0}, {"limit", 3.0}, {"count", 20.0}}),
                                   test::law("viscous_power", {{"coefficient", 1.0}, {"exponent", 0.3}})}) {
    const sim::BoundaryPoint point = sim::sticking_boundary(test::standard_system(law), std::vector{10.0})[0];
    CHECK(point.outcome.reason == "even the weakest drive moves the mass without a stick");
    CHECK_FALSE(point.is_stopped);
    CHECK(point.work == 0);
  }
}

TEST_CASE("the steps of the smooth engine count in the work of a boundary") {
  sim::Model beside_bristles = model(0.05, 1.0, 1.5);
  beside_bristles.friction.push_back(test::law("dahl", {{"kinetic", 0.1}, {"sigma0", 20.0}}));
  beside_bristles.excitation.frequency = 0.6;
  beside_bristles.excitation.amplitude = 2.0;
  const sim::SteadyState one = sim::steady_state(beside_bristles, {.others = false});
  REQUIRE(one.outcome.ok());
  CHECK(one.work > 2 * one.certificate.work());

  const sim::BoundaryPoint stopped = sim::sticking_boundary(beside_bristles, std::vector{0.6}, {}, 3 * one.work)[0];
  CHECK(stopped.is_stopped);
  CHECK(stopped.work > 2 * one.work);
  CHECK(stopped.work < 12 * one.work);
}
