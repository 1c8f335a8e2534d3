// Every departure from Coulomb + viscous friction tends to it as its severity falls.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "identify/departures/departures.hpp"
#include "sim/orbits/steady_state.hpp"

using namespace dualdamp;

TEST_CASE("departures: sorted, explained, and smaller with a smaller severity") {
  const auto& list = identify::departures::departures();
  CHECK(list.size() >= 12);
  CHECK(std::ranges::is_sorted(list, {}, &identify::departures::Departure::name));
  identify::departures::Truth truth;
  truth.model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 4.0};
  truth.model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 10.0};
  truth.F0 = 2.0;
  const sim::SteadyState reference = sim::steady_state(identify::departures::undisturbed(truth));
  REQUIRE(reference.outcome.ok());
  const identify::departures::ReferenceMotion motion{.amplitude = reference.amplitude, .frequency = 10.0, .Y = 0.1};
  for (const identify::departures::Departure& departure : list) {
    CAPTURE(departure.name);
    CHECK(identify::departures::find_departure(departure.name) == &departure);
    CHECK_FALSE(departure.severity.empty());
    CHECK(departure.family != identify::departures::Family::none);
    if (departure.mislead != nullptr) {  // the motion is the truth's, and the laboratory is wrong about it
      identify::departures::Laboratory laboratory{.constants = {.mass = 1.0, .stiffness = 100.0, .frequency = 10.0},
                                                  .sensors = {}};
      departure.mislead(laboratory, motion, 0.1);
      const identify::Sensors& sensors = laboratory.sensors;
      CHECK((laboratory.constants.mass != 1.0 || laboratory.constants.stiffness != 100.0 ||
             sensors.x.gain_error != 0.0 || sensors.y.gain_error != 0.0 || sensors.x.phase_lag != 0.0 ||
             sensors.x.gain_drift != 0.0 || sensors.x.offset != 0.0 || sensors.x.outlier_size != 0.0 ||
             laboratory.friction_growth != 0.0));
      continue;
    }
    const auto distance = [&](double s) {
      const sim::SteadyState state = sim::steady_state(identify::departures::departed(departure, truth, motion, s));
      REQUIRE(state.outcome.ok());
      return std::abs(state.amplitude / reference.amplitude - 1.0) + std::abs(state.phase - reference.phase);
    };
    const double small = distance(1e-3);
    // A static limit that the motion never meets changes nothing.
    if (departure.name == "static_friction") {
      CHECK(small < 1e-12);
      continue;
    }
    CHECK(small < 0.02);
    CHECK(small > 1e-8);
    CHECK(distance(0.1) > 3.0 * small);
  }
}

TEST_CASE("departures: where friction is left alone it is the last law, that of the truth") {
  // Pairs of the stress test take it away and put the friction of another departure in its place.
  using identify::departures::Family;
  identify::departures::Truth truth;
  truth.model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 4.0};
  truth.model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 10.0};
  truth.F0 = 2.0;
  const friction::Instant now{.x = 0.03, .v = 0.4};
  for (const identify::departures::Departure& departure : identify::departures::departures()) {
    const bool leaves_it_alone = departure.family == Family::spring || departure.family == Family::sensors ||
                                 departure.family == Family::constants || departure.family == Family::drive;
    if (!leaves_it_alone) continue;
    CAPTURE(departure.name);
    const sim::Model model =
        identify::departures::departed(departure, truth, {.amplitude = 0.12, .frequency = 10.0, .Y = 0.1}, 0.1);
    REQUIRE_FALSE(model.friction.empty());
    const friction::Law& last = model.friction.back();
    CHECK_FALSE(last.has_memory());
    CHECK(last.static_limit({}, now) == 2.0);
    CHECK(last.force({}, now, friction::Direction::forward) == 2.0);
    CHECK(last.force({}, now, friction::Direction::backward) == -2.0);
  }
}

TEST_CASE("departures: second_mode without friction is two linear masses that weigh what one did") {
  // x = k Y/(k + i w c - w^2 (m1 + m2 a/(a - w^2))), a = p^2 + 2 i 0.02 p w; p^2 = 16 (k/m) (1 - s).
  using Complex = std::complex<double>;
  identify::departures::Truth truth;
  truth.model.oscillator = {.mass = 2.0, .stiffness = 200.0, .damping = 3.0};
  truth.model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 10.0};
  const identify::departures::Departure& departure = *identify::departures::find_departure("second_mode");
  for (const double s : {0.01, 0.1, 0.3}) {
    for (const double w : {8.5, 10.0, 39.0}) {
      CAPTURE(s, w);
      truth.model.excitation.frequency = w;
      const sim::SteadyState state =
          sim::steady_state(identify::departures::departed(departure, truth, {0.3, w, 0.1}, s));
      REQUIRE(state.outcome.ok());
      const double p = 40.0 * std::sqrt(1.0 - s);
      const Complex a(p * p, 0.04 * p * w);
      const Complex mass = 2.0 * (1.0 - s) + 2.0 * s * a / (a - w * w);
      const Complex x = 20.0 / (Complex(200.0, 3.0 * w) - w * w * mass);
      CHECK(state.amplitude == Approx(std::abs(x)).epsilon(1e-9));
    }
  }
}
