// Mechanisms: each of them vanishes into Coulomb + viscous friction, and the formulas that they are built by hold.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "identify/departures/departures.hpp"
#include "sim/analytic/den_hartog.hpp"
#include "sim/analytic/free_decay.hpp"
#include "sim/motion/free_decay.hpp"
#include "sim/orbits/steady_state.hpp"

using namespace dualdamp;

namespace {

/// The rig of the paper: X = 9.7 mm in mid range.
const sim::Oscillator oscillator{.mass = 1.042, .stiffness = 1568.0};
const double natural = sim::natural_frequency(oscillator);
const identify::departures::Apparatus rig{.oscillator = oscillator,
                                          .reference = {.amplitude = 9.7e-3, .frequency = natural, .Y = 5.6e-3}};
const identify::departures::RigFriction usual{.F0 = 3.7, .c = 11.0};

sim::SteadyState steady(const std::string& name, const std::vector<double>& values) {
  const identify::departures::Departure* mechanism = identify::departures::find_mechanism(name);
  REQUIRE(mechanism != nullptr);
  const sim::SteadyState state =
      sim::steady_state(identify::departures::driven(*mechanism, rig, usual, values, rig.reference.Y));
  REQUIRE(state.outcome.ok());
  return state;
}

double zeta_of(double c) { return c / (2.0 * std::sqrt(oscillator.mass * oscillator.stiffness)); }

double closed_form(double c) {
  const auto state = sim::analytic::non_sticking_state(sim::analytic::den_hartog(zeta_of(c), 1.0), rig.reference.Y,
                                                       usual.F0 / oscillator.stiffness);
  REQUIRE(state);
  return state->amplitude;
}

/// Force of all laws against the speed v > 0 [N].
double force_at(const sim::Model& model, double v) {
  double sum = model.oscillator.damping * v;
  for (const friction::Law& law : model.friction) {
    const friction::Instant now{.v = v};
    sum += law.force(law.start(now), now, friction::Direction::forward);
  }
  return sum;
}

}  // namespace

TEST_CASE("mechanisms: sorted, explained, with plausible values and searches within their ranges") {
  const auto& list = identify::departures::mechanisms();
  CHECK(list.size() >= 16);
  CHECK(std::ranges::is_sorted(list, {}, &identify::departures::Departure::name));
  for (const identify::departures::Departure& mechanism : list) {
    CAPTURE(mechanism.name);
    CHECK(identify::departures::find_mechanism(mechanism.name) == &mechanism);
    CHECK_FALSE(mechanism.meaning.empty());
    CHECK_FALSE(mechanism.plausible.empty());
    for (const identify::departures::DepartureParameter& parameter : mechanism.parameters) {
      CAPTURE(parameter.name);
      const double scale = identify::departures::natural_scale(rig, parameter.unit);
      CHECK(scale > 0.0);
      CHECK(parameter.low < parameter.start);
      CHECK(parameter.start < parameter.high);
      CHECK(parameter.range.contains(parameter.low * scale));
      CHECK(parameter.range.contains(parameter.high * scale));
    }
    for (const identify::departures::PlausibleValues& plausible : mechanism.plausible) {
      REQUIRE(plausible.values.size() == mechanism.parameters.size());
      CHECK_FALSE(plausible.because.empty());
      for (std::size_t i = 0; i < plausible.values.size(); ++i)
        CHECK(mechanism.parameters[i].range.contains(plausible.values[i]));
    }
  }
  CHECK(identify::departures::find_mechanism("gremlins") == nullptr);
}

TEST_CASE("mechanisms: each one vanishes into Coulomb + viscous friction, whose amplitude has a closed form") {
  // Each value is s = 1e-6 of its scale, or 1e6 of it, and changes the amplitude by order s with factors of order
  // 1/zeta = 7. Deflections act by the root of s: a contact takes the time 2 sqrt(s)/w to reverse its force, a
  // delay that detunes a little, and bristles have a tenth of their critical damping beside. The film that warms is
  // followed with its power as a state that settles within T/60 s.
  const std::map<std::string, std::vector<double>> vanishing = {
      {"base_clipping", {10.0}},     {"contact_compliance", {1.568e9}},
      {"coulomb_viscous", {}},       {"dahl", {1.568e8}},
      {"detuning", {1e-6}},          {"friction_lag", {1e-6, 0.1, 0.01}},
      {"hardening_spring", {16.0}},  {"hardening_spring_detuned", {16.0, 1e-6}},
      {"lugre", {1.568e8, 1e-6}},    {"position_dependence", {1e4}},
      {"quadratic_drag", {1e-5}},    {"rigid_and_compliant", {1568.0, 1e-6}},
      {"softening_spring", {16.0}},  {"stribeck", {1e-6, 0.1}},
      {"viscous_power", {1.000001}}, {"viscous_saturating", {4e5}},
      {"warming_contact", {1e6}},    {"warming_film", {1e6}}};
  const double expected = closed_form(usual.c);
  for (const identify::departures::Departure& mechanism : identify::departures::mechanisms()) {
    const std::string name(mechanism.name);
    CAPTURE(name);
    REQUIRE(vanishing.contains(name));
    const bool is_bristle = name == "lugre" || name == "dahl";
    const double tolerance = is_bristle ? 7e-3 : name == "contact_compliance" ? 1e-3 : 2e-5;
    CHECK(steady(name, vanishing.at(name)).amplitude == Approx(expected).epsilon(tolerance));
  }
}

TEST_CASE("mechanisms: a film has the force of the damper c at the reference speed") {
  const double V = rig.reference.speed();
  const double expected = usual.F0 + usual.c * V;
  for (const auto& [name, value] :
       std::map<std::string, double>{{"viscous_power", 0.4}, {"viscous_saturating", 0.3}}) {
    CAPTURE(name);
    const sim::Model model = identify::departures::driven(*identify::departures::find_mechanism(name), rig, usual,
                                                          std::vector{value}, rig.reference.Y);
    CHECK(force_at(model, V) == Approx(expected).epsilon(1e-14));
    // Below it sublinear films have more: F = c V (v/V)^n, and c (1 + V/v0) v/(1 + v/v0).
    const double half =
        name == "viscous_power" ? std::pow(0.5, value) : 0.5 * (1.0 + V / value) / (1.0 + 0.5 * V / value);
    CHECK(force_at(model, 0.5 * V) == Approx(usual.F0 + usual.c * V * half).epsilon(1e-14));
  }
}

TEST_CASE("mechanisms: a clipped base moves as the formula says and is read by its peak") {
  const double stroke = 6e-3;
  const double Y = 6.75e-3;
  const sim::Excitation drive = identify::departures::driven(*identify::departures::find_mechanism("base_clipping"),
                                                             rig, usual, std::vector{stroke}, Y)
                                    .excitation;
  const double a = Y / stroke;
  // Coefficients fall by exp(-2 asinh(pi/2a)) = 0.11 from one to the next: eight of them leave 0.11^8 = 2e-8 of Y.
  for (int i = 0; i <= 40; ++i) {
    const double angle = std::numbers::pi * i / 40.0;
    double y = drive.amplitude * std::cos(angle);
    for (const sim::Harmonic& harmonic : drive.harmonics)
      y += harmonic.amplitude * std::cos(harmonic.order * angle + harmonic.phase);
    CHECK(y == Approx(Y * std::tanh(a * std::cos(angle)) / std::tanh(a)).margin(5e-8 * Y));
  }
  CHECK(drive.amplitude > 1.02 * Y);  // a clipped wave has more in its fundamental than its peak
}

TEST_CASE("mechanisms: a warm film is a weaker damper, by the power that it turns to heat") {
  const double power = 3.0;
  const sim::SteadyState warm = steady("warming_film", {power});
  // With a time constant far above the period the film has the damping c exp(-P/power) with the mean power P =
  // c exp(-P/power) <v^2> of its own motion; what is left is of order T/60 s = 0.3 %.
  const double V = rig.reference.speed();
  const double cold = usual.c * std::exp(0.5 * usual.c * V * V / power);
  double c = usual.c;
  for (int i = 0; i < 60; ++i) {
    sim::Model model = identify::departures::driven(*identify::departures::find_mechanism("coulomb_viscous"), rig,
                                                    {usual.F0, c}, {}, rig.reference.Y);
    const double heat = c * sim::steady_state(model).mean_square_speed;
    c = 0.5 * (c + cold * std::exp(-heat / power));
  }
  CHECK(c < 0.9 * cold);
  CHECK(warm.amplitude == Approx(closed_form(c)).epsilon(0.3e-2));
}

TEST_CASE("mechanisms: what lies in drive or spring is not there in a free decay on another spring") {
  const double stiffness = 4365.0;
  const double zeta = usual.c / (2.0 * std::sqrt(oscillator.mass * stiffness));
  const auto expected = sim::analytic::free_decay_extremes(zeta, usual.F0 / stiffness, 14.7e-3, 5);
  for (const identify::departures::Departure& mechanism : identify::departures::mechanisms()) {
    CAPTURE(mechanism.name);
    const auto& values = mechanism.plausible.front().values;
    const sim::FreeDecay decay =
        sim::free_decay(identify::departures::released(mechanism, rig, usual, values, stiffness, 14.7e-3), 5);
    REQUIRE(decay.outcome.ok());
    REQUIRE(decay.extremes.size() == expected.size());
    double distance = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i)
      distance = std::max(distance, std::abs(decay.extremes[i].x - expected[i]) / 14.7e-3);
    const bool is_plain = mechanism.forced_only || mechanism.name == "coulomb_viscous";
    if (is_plain)
      CHECK(distance < 1e-12);
    else
      CHECK(distance > 1e-6);
  }
}
