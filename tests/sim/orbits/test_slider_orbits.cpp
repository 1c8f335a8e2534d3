// Steady states of oscillators with sliders against tests/reference/slider_orbits.csv: 30 digits, from closed forms
// in 45-digit arithmetic that share nothing with the engine (slider_orbits.py beside it).

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "friction_models/laws/contact_compliance.hpp"
#include "friction_models/laws/coulomb.hpp"
#include "friction_models/laws/iwan.hpp"
#include "friction_models/laws/reset_integrator.hpp"
#include "sim/curves/curves.hpp"
#include "sim/orbits/period_map.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/support/source_tree.hpp"

using namespace dualdamp;

namespace {

struct Reference {
  std::string law;
  sim::Model model;
  int count = 1;
  double stiffness = 0.0;
  double kinetic = 0.0;
  double static_level = 0.0;
  double damping = 0.0;
  double peak = 0.0;
};

std::vector<Reference> references() {
  std::ifstream file(dualdamp::testing::in_tree("tests/reference/slider_orbits.csv"));
  std::vector<Reference> list;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
    const auto number = [&](std::size_t i) { return cells[i].empty() ? 0.0 : std::stod(cells[i]); };
    Reference r{.law = cells[0], .model = {}};
    r.model.oscillator = {.mass = number(1), .stiffness = number(3), .damping = number(2)};
    r.model.excitation = {
        .type = sim::ExcitationType::base_harmonic, .amplitude = number(5), .frequency = number(4)};
    r.count = static_cast<int>(number(6));
    r.stiffness = number(7);
    r.kinetic = number(8);
    r.static_level = cells[9].empty() ? r.kinetic : number(9);
    r.damping = number(10);
    r.peak = number(11);
    list.push_back(r);
  }
  return list;
}

/// A heavily overdamped mass with Coulomb friction under five harmonics, from a start off its orbit. A forcing
/// period takes 3e-4 of a distance from the orbit away.
sim::Model slow_model(double position, double velocity, std::vector<friction::Law> contacts) {
  sim::Model model;
  model.oscillator = {.mass = 0.038, .stiffness = 0.0067, .damping = 287.0};
  model.excitation = {
      .type = sim::ExcitationType::force_harmonic, .amplitude = 0.079, .frequency = 1.04, .phase = 0.33};
  model.excitation.harmonics = {{.order = 2, .amplitude = 0.0034, .phase = 1.67},
                                {.order = 5, .amplitude = 0.0176, .phase = 1.27},
                                {.order = 7, .amplitude = 0.0204, .phase = -2.7},
                                {.order = 10, .amplitude = 0.0066, .phase = 1.28}};
  model.friction = {friction::Law(friction::Coulomb(0.0134, 0.0134))};
  for (friction::Law& contact : contacts) model.friction.push_back(std::move(contact));
  model.initial = {.position = position, .velocity = velocity};
  return model;
}

}  // namespace

// A contact that never slides is a spring about the initial position. The numbers are those of the oscillator with
// that spring and Coulomb friction: closed forms between events, Newton's method on a map of its own (scipy).
TEST_CASE("contacts that never slide beside friction that sticks are springs, however slow the motion settles",
          "[contact_compliance]") {
  using friction::Law;
  const Law contact(friction::ContactCompliance(0.0129, 0.0129, 0.0073, 0.0));
  const Law bond(friction::ResetIntegrator(0.0129, 0.0073, 0.3, 0.0));
  const Law elements(friction::Iwan({{0.003, 0.01}, {0.005, 0.02}, {0.0007, 0.05}}));
  const Law weak_bond(friction::ResetIntegrator(0.02, 0.002, 0.3, 0.0));
  const Law weak_contact(friction::ContactCompliance(0.01, 0.02, 0.003, 0.0));
  struct Case {
    sim::Model model;
    double peak;
    double trough;
  };
  const std::vector<Case> cases = {
      {slow_model(8e-5, -5.5e-4, {contact}), 0.01561434176488441, 0.015193551892289325},
      {slow_model(8e-5, -5.5e-4, {bond}), 0.013541138427239363, 0.01312034902493786},
      {slow_model(-3e-4, 0.0, {elements}), 0.014006342982930686, 0.013585553410977447},
      {slow_model(7.7e-3, 0.0, {contact, weak_bond, weak_contact}), 0.016250529304940864, 0.01582974063496545},
  };
  for (const Case& c : cases) {
    const sim::SteadyState state = sim::steady_state(c.model);
    INFO(state.outcome.reason);
    REQUIRE(state.outcome.ok());
    CHECK(state.peak == Approx(c.peak).epsilon(1e-9));
    CHECK(state.trough == Approx(c.trough).epsilon(1e-9));
    CHECK(state.transient_periods < 200);
    CHECK(state.stable());
    CHECK(state.warnings.size() == 1);
  }
}

TEST_CASE("the derivative over a period by a slider that never slips is 1 in its own row and nothing else",
          "[contact_compliance]") {
  for (const double position : {0.0, 8.03485730955722839e-05, -0.1, 3.0}) {
    CAPTURE(position);
    sim::PeriodMap map(slow_model(position, 0.0,
                                  {friction::Law(friction::ContactCompliance(9.0, 9.0, 0.0073, 0.0)),
                                   friction::Law(friction::ResetIntegrator(9.0, 0.0073, 0.3, 0.0)),
                                   friction::Law(friction::Iwan({{0.003, 9.0}, {0.005, 9.0}}))}));
    const sim::ForcingPeriod period = map.from_start(position, 0.0, sim::Monodromy::with);
    REQUIRE(period.monodromy.rows() >= 5);
    CHECK(period.free_coordinates() == std::vector<Eigen::Index>{0, 1});
  }
}

TEST_CASE("contact compliance has the steady states of a 30-digit calculation", "[contact_compliance]") {
  int compared = 0;
  double worst = 0.0;
  for (Reference& r : references()) {
    if (r.law != "contact") continue;
    CAPTURE(r.stiffness, r.static_level, r.damping, r.model.excitation.frequency);
    r.model.friction.emplace_back(friction::ContactCompliance(r.kinetic, r.static_level, r.stiffness, r.damping));
    const sim::SteadyState state = sim::steady_state(r.model);
    REQUIRE(state.outcome.ok());
    CHECK(state.stable());
    CHECK(state.peak == Approx(r.peak).epsilon(1e-12));
    worst = std::max(worst, std::abs(state.peak / r.peak - 1.0));
    ++compared;
  }
  CHECK(compared == 30);
  WARN(compared << " orbits with contact stiffness 1e2 to 1e7 N/m, largest relative error " << worst);
}

TEST_CASE("iwan has the steady states of a 30-digit calculation", "[iwan]") {
  int compared = 0;
  for (Reference& r : references()) {
    if (r.law != "iwan") continue;
    CAPTURE(r.count);
    r.model.friction.emplace_back(friction::Iwan(friction::Iwan::uniform(r.stiffness, r.kinetic, r.count)));
    const sim::SteadyState state = sim::steady_state(r.model);
    REQUIRE(state.outcome.ok());
    CHECK(state.peak == Approx(r.peak).epsilon(1e-12));
    ++compared;
  }
  CHECK(compared >= 2);
}

TEST_CASE("contact compliance approaches rigid Coulomb friction at order one half", "[contact_compliance]") {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 1.0};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 0.1, .frequency = 7.0};
  model.friction.emplace_back(friction::Coulomb(2.0, 2.0));
  const double rigid = sim::steady_state(model).peak;
  std::vector<double> distance;
  for (const double stiffness : {1e6, 1e8, 1e10}) {
    model.friction = {friction::Law(friction::ContactCompliance(2.0, 2.0, stiffness, 0.0))};
    const sim::SteadyState state = sim::steady_state(model);
    REQUIRE(state.outcome.ok());
    distance.push_back(std::abs(state.peak - rigid));
  }
  for (std::size_t i = 1; i < distance.size(); ++i) {
    // A hundredfold stiffness: a tenth of the distance.
    CHECK(std::log(distance[i - 1] / distance[i]) / std::log(100.0) == Approx(0.5).margin(0.05));
  }
}

TEST_CASE("an orbit that closes only at a loose tolerance, where a slider begins to slide, is that of a tight one",
          "[contact_compliance]") {
  sim::Model model;
  model.oscillator = {.mass = 1.0, .stiffness = 100.0, .damping = 0.2839};
  model.excitation = {.type = sim::ExcitationType::base_harmonic, .amplitude = 1.0, .frequency = 2.1645};
  model.friction.emplace_back(friction::ContactCompliance(0.801952, 0.801952, 248.268, 0.0));
  model.friction.emplace_back(friction::ContactCompliance(0.108755, 0.108755, 72.247, 0.0));
  model.friction.emplace_back(friction::Coulomb(0.3, 0.3));
  std::vector<double> amplitudes;
  for (int i = 0; i < 25; ++i) amplitudes.push_back(0.020799 + i * (0.658436 - 0.020799) / 24.0);
  const sim::Curve tight = sim::xy_curve(model, amplitudes);
  model.solver.tolerance = 6e-4;
  const sim::Curve loose = sim::xy_curve(model, amplitudes);
  for (std::size_t i = 0; i < amplitudes.size(); ++i) {
    CAPTURE(amplitudes[i], loose.reason(loose.points[i]));
    REQUIRE(loose.points[i].ok());
    CHECK(loose.points[i].x == Approx(tight.points[i].x).epsilon(5e-3));
    CHECK(loose.points[i].stable);
  }
}
