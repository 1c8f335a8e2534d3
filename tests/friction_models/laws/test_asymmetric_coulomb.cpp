#include "friction_models/laws/asymmetric_coulomb.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "friction_models/laws/coulomb.hpp"
#include "friction_models/registry.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/engine/engine.hpp"
#include "sim/motion/simulate.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/support/standard_system.hpp"

using namespace dualdamp;
using friction::AsymmetricCoulomb;
using friction::Direction;
using friction::Law;
using test::standard_stiffness;

namespace {

constexpr double mass = 1.0;

sim::Model model_with(std::vector<Law> laws, double damping = 0.0) {
  return {.oscillator = {.mass = mass, .stiffness = standard_stiffness, .damping = damping},
          .friction = std::move(laws)};
}

/// The ends of the swings of a free motion and where it rests.
std::vector<double> turning_points(sim::Model model, double from) {
  model.initial = {.position = from};
  std::vector<double> points;
  const auto engine = sim::make_engine(model);
  engine->start(from, 0.0);
  while (engine->time() < 60.0) {
    const sim::Interval* interval = engine->next(60.0 - engine->time());
    if (interval == nullptr || !interval->ending) break;
    points.push_back(interval->at(interval->duration).x);
    if (*interval->ending == sim::EventKind::stop) break;
  }
  return points;
}

}  // namespace

TEST_CASE("asymmetric_coulomb conforms to the law contract", "[friction][asymmetric_coulomb]") {
  const std::vector<std::string> none;
  const auto conforms = [&](const friction::ParameterValues& values) {
    CHECK(sim::nonconformities(sim::law_case("asymmetric_coulomb", values)) == none);
  };
  conforms({{"kinetic_forward", 2.0}, {"kinetic_backward", 1.0}});
  conforms({{"kinetic_forward", 0.0}, {"kinetic_backward", 1.0}, {"static_forward", 3.0}});
  conforms({{"kinetic_forward", 2.0},
            {"kinetic_backward", 1.0},
            {"static_forward", 2.5},
            {"static_backward", 4.0},
            {"viscous_forward", 0.5},
            {"viscous_backward", 3.0}});
  conforms({{"kinetic_forward", 2.0}, {"kinetic_backward", 1.0}, {"position_slope", -30.0}});
  conforms({{"kinetic_forward", 2.0}, {"kinetic_backward", 1.0}, {"drift", -0.1}});
}

TEST_CASE("asymmetric_coulomb: the force in each direction, and the forces that hold", "[asymmetric_coulomb]") {
  const Law law(AsymmetricCoulomb({2.0, 3.0, 0.5}, {1.0, 1.5, 4.0}));
  CHECK(law.force({}, {.v = 2.0}, Direction::forward) == 3.0);
  CHECK(law.force({}, {.v = -2.0}, Direction::backward) == -9.0);
  // From -1.5 N to 3 N.
  CHECK(law.force({}, {}, Direction::none) == 0.75);
  CHECK(law.static_limit({}, {}) == 2.25);
}

TEST_CASE("asymmetric_coulomb: a free swing loses twice the level of its direction over the stiffness",
          "[asymmetric_coulomb]") {
  // Each half swing goes about the rest of its direction: from a to -a - 2 s F/k, s the direction. It ends where
  // the spring holds no more than the static level of the direction in which it pulls.
  const double forward = 3.0;
  const double backward = 1.0;
  const std::vector<Law> laws = {Law(AsymmetricCoulomb({forward, 5.5, 0.0}, {backward, 2.0, 0.0}))};
  for (const double from : {0.3, -0.23, 1.1, 0.05, -0.054, -0.056, 0.019}) {
    std::vector<double> expected;
    double x = from;
    while (true) {
      const double pull = -standard_stiffness * x;
      if (pull <= 5.5 && pull >= -2.0) break;
      x = pull > 0.0 ? -x - 2.0 * forward / standard_stiffness : -x + 2.0 * backward / standard_stiffness;
      expected.push_back(x);
    }
    const std::vector<double> found = turning_points(model_with(laws), from);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) CHECK(std::abs(found[i] - expected[i]) < 1e-13);
  }
}

TEST_CASE("asymmetric_coulomb: damping of its own in each direction", "[asymmetric_coulomb]") {
  // Half swings about -+F/k, each shrunk by the factor of its own damper.
  const double c_forward = 3.0;
  const double c_backward = 0.4;
  const Law law(AsymmetricCoulomb({0.5, 0.5, c_forward}, {0.8, 0.8, c_backward}));
  const auto factor = [](double c) {
    const double decay = c / (2.0 * mass);
    return std::exp(-std::numbers::pi * decay / std::sqrt(standard_stiffness / mass - decay * decay));
  };
  const std::vector<double> found = turning_points(model_with({law}), 0.4);
  REQUIRE(found.size() >= 4);
  double x = 0.4;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool forward = x < 0.0;
    const double middle = forward ? -0.5 / standard_stiffness : 0.8 / standard_stiffness;
    x = middle - factor(forward ? c_forward : c_backward) * (x - middle);
    CHECK(std::abs(found[i] - x) < 1e-13);
  }
}

TEST_CASE("asymmetric_coulomb is coulomb where both directions are equal, event by event", "[asymmetric_coulomb]") {
  const auto events = [](const Law& law, double damping) {
    sim::Model model = model_with({law}, damping);
    model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.06, .frequency = 2.0};
    return sim::simulate(model, {.duration = 20.0}).events;
  };
  const auto one = events(Law(AsymmetricCoulomb({2.0, 3.0, 1.5}, {2.0, 3.0, 1.5})), 2.5);
  const auto other = events(Law(friction::Coulomb(2.0, 3.0)), 4.0);
  REQUIRE(one.size() == other.size());
  REQUIRE(one.size() > 10);
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].kind == other[i].kind);
    CHECK(one[i].t == Approx(other[i].t).margin(1e-11));
    CHECK(one[i].x == Approx(other[i].x).margin(1e-12));
  }
}

TEST_CASE("asymmetric_coulomb: a difference of the levels is a constant force", "[asymmetric_coulomb]") {
  // Kinetic and static levels differ by the same: coulomb of the mean level, about a shifted middle.
  const double difference = 1.2;
  sim::Model model = model_with({Law(AsymmetricCoulomb({2.6, 3.6, 0.0}, {1.4, 2.4, 0.0}))}, 4.0);
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.06, .frequency = 2.0};
  sim::Model symmetric = model;
  symmetric.friction = {Law(friction::Coulomb(2.0, 3.0))};
  const double shift = -difference / 2.0 / standard_stiffness;
  model.initial = {.position = 0.05 + shift};
  symmetric.initial = {.position = 0.05};
  const sim::SteadyState one = sim::steady_state(model);
  const sim::SteadyState other = sim::steady_state(symmetric);
  REQUIRE(one.outcome.ok());
  REQUIRE(other.outcome.ok());
  CHECK(one.stops_per_cycle == other.stops_per_cycle);
  CHECK(std::abs(one.peak - shift - other.peak) < 1e-12);
  CHECK(std::abs(one.trough - shift - other.trough) < 1e-12);
}

TEST_CASE("asymmetric_coulomb: both engines agree where the mass sticks unequally", "[asymmetric_coulomb]") {
  sim::Model model = model_with({Law(AsymmetricCoulomb({2.0, 4.0, 1.0}, {1.0, 1.5, 3.0}))}, 1.0);
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.06, .frequency = 2.0};
  const sim::SteadyState exact = sim::steady_state(model);
  model.solver = {.kind = sim::SolverKind::explicit_steps, .tolerance = 1e-11};
  const sim::SteadyState smooth = sim::steady_state(model);
  REQUIRE(exact.outcome.ok());
  REQUIRE(smooth.outcome.ok());
  CHECK(exact.stops_per_cycle == 2);
  CHECK(smooth.stops_per_cycle == 2);
  CHECK(std::abs(exact.peak - smooth.peak) < 1e-9);
  CHECK(std::abs(exact.trough - smooth.trough) < 1e-9);
  CHECK(std::abs(exact.energy.friction - smooth.energy.friction) < 1e-8);
}

TEST_CASE("asymmetric_coulomb: a static level below the kinetic one of its direction is refused",
          "[asymmetric_coulomb]") {
  friction::ParameterValues values = {
      {"kinetic_forward", 2.0}, {"kinetic_backward", 1.0}, {"static_backward", 0.5}};
  const auto faults = friction::complete(AsymmetricCoulomb::parameters(), values);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].name == "static_backward");
  CHECK(faults[0].allowed == ">= 1 N");
}
