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
#include "sim/curves/curves.hpp"
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

}  // namespace

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
