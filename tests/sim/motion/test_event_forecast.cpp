/// The forecast refuses hopeless motions early and lets all others end.

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "sim/motion/simulate.hpp"
#include "tests/support/make_law.hpp"

using namespace dualdamp;
using friction::ParameterValues;
using sim::Excitation;
using sim::ExcitationType;
using sim::Model;

namespace {

/// Under drives of 0.1 m or 0.1 m/s, and free from 0.3 m.
std::vector<Model> motions_under(const friction::Law& law, double damping) {
  Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = damping};
  model.friction = {law};
  std::vector<Model> models;
  for (const double frequency : {2.0, 10.0, 30.0}) {
    model.excitation = {.type = ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = frequency};
    models.push_back(model);
    model.excitation = {.type = ExcitationType::force_harmonic, .amplitude = 10.0, .frequency = frequency};
    models.push_back(model);
  }
  model.excitation = {.type = ExcitationType::base_ramp, .slope = 0.1};
  models.push_back(model);
  model.excitation = {.type = ExcitationType::force_ramp, .slope = 10.0};
  models.push_back(model);
  model.excitation = {};
  model.initial.position = 0.3;
  models.push_back(model);
  return models;
}

}  // namespace

TEST_CASE("a motion with as many events as allowed is not refused, a hopeless one early") {
  const ParameterValues record{{"ratio", 0.1}, {"correlation_length", 6e-5}, {"seed", 1.0}};
  const std::vector<friction::Law> laws = {
      test::law("bristle", {{"stiffness", 60.0}, {"snap_distance", 0.001}, {"count", 30.0}, {"seed", 1.0}}),
      test::law("coulomb", {{"kinetic", 2.0}, {"fluctuation", std::vector<ParameterValues>{record}}})};
  int refused_early = 0;
  int motions = 0;
  for (const friction::Law& law : laws)
    for (const double damping : {2.0})
      for (const Model& model : motions_under(law, damping)) {
        constexpr double duration = 2.5;
        const sim::History whole = sim::simulate(model, {.duration = duration});
        CAPTURE(law.aperiodic(), damping, static_cast<int>(model.excitation.type), model.excitation.frequency);
        REQUIRE(whole.outcome.ok());
        const long events = static_cast<long>(whole.events.size());
        const sim::History same = sim::simulate(model, {.duration = duration, .max_events = events + 1});
        CHECK(same.outcome.ok());
        if (events < 90'000) continue;
        ++motions;
        const sim::History hopeless = sim::simulate(model, {.duration = duration, .max_events = events / 5});
        CHECK(hopeless.outcome.reason == "more than " + std::to_string(events / 5) + " events before the end");
        refused_early += static_cast<long>(hopeless.events.size()) < events / 5 ? 1 : 0;
      }
  CHECK(motions > 3);
  CHECK(refused_early > 1);
}

TEST_CASE("ten thousand bristles and a fluctuation over 1 nm are refused after some ten thousand events") {
  const ParameterValues record{{"ratio", 0.1}, {"correlation_length", 1e-9}, {"seed", 1.0}};
  const std::vector<friction::Law> laws = {
      test::law("bristle", {{"stiffness", 0.2}, {"snap_distance", 0.001}, {"count", 10'000.0}, {"seed", 1.0}}),
      test::law("coulomb", {{"kinetic", 2.0}, {"fluctuation", std::vector<ParameterValues>{record}}})};
  for (const friction::Law& law : laws)
    for (const Excitation& drive :
         {Excitation{.type = ExcitationType::base_ramp, .slope = 0.1},
          Excitation{.type = ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 10.0}}) {
      Model model;
      model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 4.0};
      model.friction = {law};
      model.excitation = drive;
      const sim::History history = sim::simulate(model, {.duration = 20.0, .max_events = 3'000'000});
      CHECK(history.outcome.reason == "more than 3000000 events before the end");
      CHECK(history.events.size() <= 65'536);
    }
}
