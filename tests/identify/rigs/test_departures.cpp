// Every departure from Coulomb + viscous friction tends to it as its severity falls.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "identify/rigs/rigs.hpp"
#include "sim/orbits/steady_state.hpp"

using namespace dualdamp;

TEST_CASE("departures: sorted, explained, and smaller with a smaller severity") {
  const auto& list = identify::rigs::departures();
  CHECK(list.size() >= 12);
  CHECK(std::ranges::is_sorted(list, {}, &identify::rigs::Rig::name));
  identify::rigs::Truth truth;
  truth.model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 4.0};
  truth.model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 10.0};
  truth.F0 = 2.0;
  const sim::SteadyState reference = sim::steady_state(identify::rigs::undisturbed(truth));
  REQUIRE(reference.outcome.ok());
  const identify::rigs::ReferenceMotion motion{.amplitude = reference.amplitude, .frequency = 10.0, .Y = 0.1};
  for (const identify::rigs::Rig& departure : list) {
    CAPTURE(departure.name);
    CHECK(identify::rigs::find_departure(departure.name) == &departure);
    CHECK_FALSE(departure.severity.empty());
    CHECK(departure.family != identify::rigs::Family::none);
    if (departure.mislead != nullptr) {  // the motion is the truth's, and the laboratory is wrong about it
      identify::rigs::Laboratory laboratory{.constants = {.mass = 1.0, .stiffness = 100.0, .frequency = 10.0},
                                            .sensors = {}};
      departure.mislead(laboratory, 0.1);
      const identify::Sensors& sensors = laboratory.sensors;
      CHECK((laboratory.constants.mass != 1.0 || laboratory.constants.stiffness != 100.0 ||
             sensors.x.gain_error != 0.0 || sensors.y.gain_error != 0.0 || sensors.x.phase_lag != 0.0 ||
             sensors.x.gain_drift != 0.0 || sensors.x.outlier_size != 0.0 || laboratory.friction_growth != 0.0));
      continue;
    }
    const auto distance = [&](double s) {
      const sim::SteadyState state = sim::steady_state(identify::rigs::departed(departure, truth, motion, s));
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
