#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "friction_models/registry.hpp"
#include "sim/law_host/loaded_contacts.hpp"
#include "sim/motion/simulate.hpp"

using namespace dualdamp;

namespace {

sim::Model model_with(const std::string& law, friction::ParameterValues values) {
  const friction::LawEntry* entry = friction::find_law(law);
  REQUIRE(friction::complete(*entry, values).empty());
  return {.oscillator = {.mass = 1.0, .stiffness = 1000.0, .damping = 1.0}, .friction = entry->make(values)};
}

struct LoadedCase {
  std::string law;
  friction::ParameterValues values;
};

sim::Sample last_of(const sim::Model& model, double duration) {
  return sim::simulate(model, {.duration = duration, .sample_rate = 1.0 / duration}).samples.back();
}

}  // namespace

TEST_CASE("A motion that begins loaded goes on as the one that loaded it", "[sim][loaded_contacts]") {
  const auto [law, values] = GENERATE(from_range(std::vector<LoadedCase>{
      {"contact_compliance", {{"kinetic", 1.0}, {"static", 1.3}, {"contact_stiffness", 1000.0}}},
      {"reset_integrator", {{"kinetic", 1.0}, {"stiffness", 1500.0}, {"static_gain", 0.2}}},
      {"free_play", {{"kinetic", 1.0}, {"play", 1e-3}}},
      {"iwan", {{"stiffness", 2000.0}, {"limit", 1.0}, {"count", 5.0}}},
      {"dahl", {{"kinetic", 1.0}, {"sigma0", 1500.0}}},
      {"bouc_wen", {{"limit", 1.0}, {"stiffness", 1500.0}, {"exponent", 2.0}}}}));
  const double velocity = GENERATE(0.1, -0.1);
  const double duration = GENERATE(3e-3, 12e-3);  // before and after the contact of the first law yields
  CAPTURE(law, velocity, duration);
  sim::Model whole = model_with(law, values);
  whole.initial = {1e-3, velocity};
  const sim::Sample between = last_of(whole, duration);
  REQUIRE(between.v * velocity > 0.0);
  sim::Model second = model_with(law, values);
  second.initial = {between.x, between.v};
  REQUIRE(sim::load_contacts(second, between.x - whole.initial.position));
  const sim::Sample end = last_of(whole, duration + 0.1);
  const sim::Sample same = last_of(second, 0.1);
  CHECK(same.x == Approx(end.x).margin(1e-9));
  CHECK(same.v == Approx(end.v).margin(1e-7));
  // Unloaded, the motion is another one.
  REQUIRE(sim::load_contacts(second, 0.0));
  CHECK(std::abs(last_of(second, 0.1).x - end.x) > 1e-7);
}

TEST_CASE("Laws that remember no way start as without a load", "[sim][loaded_contacts]") {
  sim::Model model = model_with("stribeck", {{"kinetic", 1.0}, {"static", 1.5}, {"stribeck_velocity", 0.05}});
  model.initial = {2e-2, -0.1};
  const sim::Sample without = last_of(model, 0.2);
  REQUIRE(sim::load_contacts(model, 1e-3));
  CHECK(last_of(model, 0.2).x == without.x);
}
