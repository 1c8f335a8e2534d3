#include "sim/validate.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/cancellation.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "sim/batch/batch.hpp"
#include "sim/curves/continuation.hpp"
#include "sim/curves/curves.hpp"
#include "sim/curves/sticking_boundary.hpp"
#include "sim/engine/engine.hpp"
#include "sim/engine/exact_engine.hpp"
#include "sim/motion/free_decay.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/batch_steady_states.hpp"
#include "sim/orbits/steady_state.hpp"
#include "sim/parallel.hpp"

using namespace dualdamp;
using sim::Model;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Model sound() {
  Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 4.0, .damping = 0.4};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 1.0, .frequency = 1.5};
  model.friction.emplace_back(friction::Coulomb(1.0, 1.0));
  return model;
}

struct Fault {
  std::string path;  ///< as in a scenario file
  std::string allowed;
  std::function<void(Model&)> make;
};

std::vector<Fault> faults() {
  return {
      {"system.mass", "> 0 kg", [](Model& m) { m.oscillator.mass = 0.0; }},
      {"system.mass", "> 0 kg", [](Model& m) { m.oscillator.mass = not_a_number; }},
      {"system.stiffness", "> 0 N/m", [](Model& m) { m.oscillator.stiffness = -1.0; }},
      {"system.damping", "any finite value", [](Model& m) { m.oscillator.damping = infinity; }},
      {"system.cubic_stiffness", "any finite value", [](Model& m) { m.oscillator.cubic_stiffness = not_a_number; }},
      {"system.friction", "1 to 256 items",
       [](Model& m) { m.friction.resize(257, friction::Law(friction::Coulomb(1.0, 1.0))); }},
      {"excitation.amplitude", ">= 0 m", [](Model& m) { m.excitation.amplitude = -1.0; }},
      {"excitation.amplitude", ">= 0 m", [](Model& m) { m.excitation.amplitude = infinity; }},
      {"excitation.frequency", "> 0 rad/s", [](Model& m) { m.excitation.frequency = 0.0; }},
      {"excitation.frequency", "> 0 rad/s", [](Model& m) { m.excitation.frequency = not_a_number; }},
      {"excitation.phase", ">= -1.0e+06 rad and <= 1.0e+06 rad",
       [](Model& m) { m.excitation.phase = not_a_number; }},
      {"excitation.phase", ">= -1.0e+06 rad and <= 1.0e+06 rad", [](Model& m) { m.excitation.phase = -1e18; }},
      {"excitation.harmonics.phase", ">= -1.0e+06 rad and <= 1.0e+06 rad",
       [](Model& m) { m.excitation.harmonics = {{2, 1.0, 1e18}}; }},
      {"excitation.offset", "any finite value",
       [](Model& m) {
         m.excitation.type = sim::ExcitationType::force_harmonic;
         m.excitation.offset = not_a_number;
       }},
      {"excitation.harmonics.order", ">= 2 and <= 1000",
       [](Model& m) { m.excitation.harmonics = {{1, 1.0, 0.0}}; }},
      {"excitation.harmonics.amplitude", ">= 0 m",
       [](Model& m) { m.excitation.harmonics = {{2, not_a_number, 0.0}}; }},
      {"excitation.harmonics", "1 to 8 items", [](Model& m) { m.excitation.harmonics.resize(9, {3, 0.1, 0.0}); }},
      {"initial.position", "any finite value", [](Model& m) { m.initial.position = not_a_number; }},
      {"initial.velocity", "any finite value", [](Model& m) { m.initial.velocity = infinity; }},
      {"numerics.tolerance", ">= 1.0e-15 and <= 0.001", [](Model& m) { m.solver.tolerance = 0.0; }},
  };
}

/// Every public function that takes a model with a harmonic excitation.
std::vector<std::function<void(const Model&)>> entrances() {
  return {
      [](const Model& m) { (void)sim::make_engine(m); },
      [](const Model& m) { (void)sim::simulate(m, {.duration = 10.0}); },
      [](const Model& m) { (void)sim::steady_state(m); },
      [](const Model& m) { (void)sim::one_period(m, {}, 10); },
      [](const Model& m) { (void)sim::xy_curve(m, {1.0, 2.0}); },
      [](const Model& m) { (void)sim::frequency_response(m, {1.0, 2.0}); },
      [](const Model& m) { (void)sim::regime_map(m, {1.0}, {1.0, 2.0}); },
      [](const Model& m) { (void)sim::continue_branch(m, sim::BranchParameter::amplitude, 2.0, 1.0); },
      [](const Model& m) { (void)sim::sticking_boundary(m, std::vector{1.0}); },
  };
}

/// Varied quantities have values other than those of the model.
bool is_replaced(const std::string& path, std::size_t entrance) {
  const bool amplitude = path == "excitation.amplitude" && (entrance == 4 || entrance >= 6);
  const bool frequency = path == "excitation.frequency" && (entrance == 5 || entrance == 6 || entrance == 8);
  return amplitude || frequency;
}

}  // namespace

TEST_CASE("A sound model has no problems") {
  CHECK(sim::validate(sound()).empty());
  CHECK(sim::validate(Model{}).empty());
  const Model model = sound();
  CHECK_NOTHROW(sim::valid(model));
}

TEST_CASE("Each fault of a model is named as in a scenario file, with what is allowed") {
  for (const Fault& fault : faults()) {
    Model model = sound();
    fault.make(model);
    const std::vector<core::Diagnostic> problems = sim::validate(model);
    CAPTURE(fault.path);
    REQUIRE(problems.size() == 1);
    CHECK(problems[0].message.starts_with("'" + fault.path + "' "));
    CHECK(problems[0].allowed == fault.allowed);
    CHECK_FALSE(problems[0].found.empty());
  }
}

TEST_CASE("Faults of a model whose coordinate is an angle have the units of a rotation") {
  Model model = sound();
  model.oscillator.coordinate = core::Coordinate::angle;
  model.oscillator.mass = -1.0;
  model.excitation.amplitude = -2.0;
  const std::vector<core::Diagnostic> problems = sim::validate(model);
  REQUIRE(problems.size() == 2);
  CHECK(problems[0].allowed == "> 0 kg.m^2");
  CHECK(problems[0].found == "-1 kg.m^2");
  CHECK(problems[1].found == "-2 rad");
  model.excitation.type = sim::ExcitationType::force_harmonic;
  CHECK(sim::validate(model)[1].found == "-2 N.m");
  model.oscillator.mass = 1.0;
  try {
    static_cast<void>(sim::xy_curve(model, {-3.0}));
    FAIL("a negative amplitude was accepted");
  } catch (const core::InputError& error) {
    CHECK(error.diagnostics()[0].found == "-3 N.m");
  }
}

TEST_CASE("All problems of a model come at once") {
  Model model = sound();
  model.oscillator.mass = -1.0;
  model.oscillator.stiffness = 0.0;
  model.excitation.frequency = -2.0;
  const std::vector<core::Diagnostic> problems = sim::validate(model);
  REQUIRE(problems.size() == 3);
  CHECK(problems[0].found == "-1 kg");
  CHECK(problems[1].message == "'system.stiffness' is out of range: a motion needs a spring");
}

TEST_CASE("Noise and ramps are checked by their own numbers") {
  Model model = sound();
  model.excitation = {.type = sim::ExcitationType::force_noise, .noise = {.intensity = -1.0, .bandwidth = 0.0}};
  REQUIRE(sim::validate(model).size() == 2);
  CHECK(sim::validate(model)[0].allowed == ">= 0 N^2.s");
  model.excitation = {.type = sim::ExcitationType::base_ramp, .slope = not_a_number};
  REQUIRE(sim::validate(model).size() == 1);
  CHECK(sim::validate(model)[0].message == "'excitation.velocity' is out of range");
}

TEST_CASE("Every public function refuses an invalid model instead of computing with it") {
  const auto all = entrances();
  for (const Fault& fault : faults()) {
    Model model = sound();
    fault.make(model);
    for (std::size_t i = 0; i < all.size(); ++i) {
      CAPTURE(fault.path, i);
      if (!is_replaced(fault.path, i)) CHECK_THROWS_AS(all[i](model), core::InputError);
    }
  }
}

TEST_CASE("Arguments beside the model are checked too") {
  const Model model = sound();
  Model free = model;
  free.excitation = {};
  CHECK_THROWS_AS(sim::steady_state(free), core::InputError);
  CHECK_THROWS_AS(sim::xy_curve(free, {1.0}), core::InputError);
  CHECK_THROWS_AS(sim::free_decay(model, 3), core::InputError);
  CHECK_THROWS_AS(sim::simulate(model, {.duration = not_a_number}), core::InputError);
  CHECK_THROWS_AS(sim::simulate(model, {.duration = 1.0, .sample_rate = -1.0}), core::InputError);
  CHECK_THROWS_AS(sim::xy_curve(model, {1.0, not_a_number}), core::InputError);
  CHECK_THROWS_AS(sim::frequency_response(model, {1.0, 0.0}), core::InputError);
  CHECK_THROWS_AS(sim::regime_map(model, {1.0}, {-1.0}), core::InputError);
  CHECK_THROWS_AS(sim::continue_branch(model, sim::BranchParameter::frequency, 0.0, 1.0), core::InputError);
  CHECK_THROWS_AS(sim::sticking_boundary(model, std::vector{-1.0}), core::InputError);
  CHECK_THROWS_AS(sim::one_period(model, {}, 10), core::InputError);
  Model cubic = model;
  cubic.oscillator.cubic_stiffness = 1.0;
  CHECK_THROWS_AS(sim::ExactEngine(cubic), core::InputError);
}

TEST_CASE("A batch with columns of different length or values out of range is refused") {
  const sim::OscillatorBatch good = sim::batch_of(sound(), 3).value();
  CHECK_NOTHROW(sim::steady_states(good));
  const auto refused = [&](auto change) {
    sim::OscillatorBatch batch = good;
    change(batch);
    CHECK_THROWS_AS(sim::steady_states(batch), core::InputError);
    CHECK_THROWS_AS(sim::sliding_orbits(batch), core::InputError);
    sim::BatchMotions motions{.position = {0.0, 0.0, 0.0}, .velocity = {1.0, 1.0, 1.0}};
    CHECK_THROWS_AS(sim::pass_periods(batch, 2, motions), core::InputError);
  };
  refused([](auto& b) { b.damping.pop_back(); });
  refused([](auto& b) { b.mass[1] = 0.0; });
  refused([](auto& b) { b.stiffness[2] = not_a_number; });
  refused([](auto& b) { b.static_level[0] = 0.5; });
  refused([](auto& b) { b.frequency[0] = 0.0; });
  refused([](auto& b) { b.type = sim::ExcitationType::none; });
  sim::BatchMotions short_one{.position = {0.0}, .velocity = {1.0}};
  CHECK_THROWS_AS(sim::pass_periods(good, 2, short_one), core::InputError);
  CHECK_THROWS_AS(sim::steady_states(good, {.width = 3}), core::InputError);
}

TEST_CASE("A cancellation ends motions, steady states, maps and loops over parts") {
  core::request_cancellation();
  const Model model = sound();
  CHECK_THROWS_AS(sim::simulate(model, {.duration = 1e9}), core::Cancelled);
  CHECK_THROWS_AS(sim::regime_map(model, {1.0, 2.0}, {1.0, 2.0}), core::Cancelled);
  CHECK_THROWS_AS(sim::continue_branch(model, sim::BranchParameter::amplitude, 2.0, 1.0), core::Cancelled);
  CHECK_THROWS_AS(sim::in_parts(10, 1, 2, [](std::size_t, std::size_t) {}), core::Cancelled);
  core::clear_cancellation();
  CHECK(sim::steady_state(model).outcome.ok());
}
