// The table of departures: each one is explained, serves a question, and its parameters have a meaning at all
// severities.

#include "identify/departures/departures.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>

using namespace dualdamp;

namespace {

identify::departures::RigBase base() {
  identify::departures::RigBase result{
      .F0 = 2.0, .reference = {.amplitude = 0.12, .frequency = 10.0, .Y = 0.1}, .warming_time = 3.0};
  result.boundary_velocity = 0.02;
  result.model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 4.0};
  result.model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 10.0};
  return result;
}

}  // namespace

TEST_CASE("departures: sorted, explained, each of them with a severity or a mechanism") {
  const auto& list = identify::departures::all_departures();
  CHECK(std::ranges::is_sorted(list, std::ranges::less{}, &identify::departures::Departure::name));
  CHECK(std::ranges::adjacent_find(list, {}, &identify::departures::Departure::name) == list.end());
  for (const identify::departures::Departure& departure : list) {
    CAPTURE(departure.name);
    CHECK_FALSE(departure.meaning.empty());
    const bool has_severity = identify::departures::find_departure(departure.name) != nullptr;
    CHECK((has_severity || identify::departures::find_mechanism(departure.name) != nullptr));
    CHECK(has_severity == (departure.values_at != nullptr));
    CHECK(has_severity == (departure.largest > 0.0));
    for (const identify::departures::DepartureParameter& parameter : departure.parameters) {
      CHECK_FALSE(parameter.unit.empty());
      CHECK_FALSE(parameter.meaning.empty());
    }
  }
}

TEST_CASE("departures: parameters of a departure lie in their ranges at all severities") {
  for (const identify::departures::Departure& departure : identify::departures::departures()) {
    CAPTURE(departure.name);
    for (const double s : {1e-6 * departure.largest, departure.largest}) {
      const std::vector<double> values = departure.values_at(base(), s);
      REQUIRE(values.size() == departure.parameters.size());
      for (std::size_t i = 0; i < values.size(); ++i) {
        CAPTURE(departure.parameters[i].name, values[i]);
        CHECK(departure.parameters[i].range.contains(values[i]));
      }
    }
  }
}

TEST_CASE("departures: one that serves both questions is the same model in both") {
  // A departure at s and the mechanism at the parameters of s, on the same oscillator and drive. Films and warmth
  // are left out: there F0 and c mean the limit s -> 0 in one question and the reference motion in the other;
  // lugre takes its speed of boundary lubrication from the question.
  const identify::departures::RigBase common = base();
  identify::departures::Truth truth{.model = common.model, .F0 = common.F0};
  const identify::departures::Apparatus apparatus{.oscillator = common.model.oscillator,
                                                  .reference = common.reference};
  for (const char* name : {"contact_compliance", "dahl", "detuning", "friction_lag", "stribeck", "viscous_power"}) {
    CAPTURE(name);
    const identify::departures::Departure& departure = *identify::departures::find_departure(name);
    const double s = 0.2;
    const std::vector<double> values = departure.values_at(common, s);
    const sim::Model departed = identify::departures::departed(departure, truth, common.reference, s);
    const sim::Model driven = identify::departures::driven(*identify::departures::find_mechanism(name), apparatus,
                                                           {common.F0, common.c()}, values, common.reference.Y);
    CHECK(departed.oscillator.damping == driven.oscillator.damping);
    CHECK(departed.excitation.frequency == driven.excitation.frequency);
    CHECK(departed.excitation.amplitude == driven.excitation.amplitude);
    REQUIRE(departed.friction.size() == driven.friction.size());
    for (std::size_t i = 0; i < driven.friction.size(); ++i) {
      const friction::Instant now{.x = 0.01, .v = 0.3};
      const friction::Law& a = departed.friction[i];
      const friction::Law& b = driven.friction[i];
      CHECK(a.force(a.start(now), now, friction::Direction::forward) ==
            b.force(b.start(now), now, friction::Direction::forward));
    }
  }
}
