#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

#include "friction_models/registry.hpp"
#include "tests/identify/fit/synthetic.hpp"

using namespace dualdamp;
using namespace std::complex_literals;

namespace {

/// m = 2 kg, k = 8000 N/m, eta = 0.05, driven by a force.
identify::Rig joint_of(double kinetic) {
  identify::Rig rig;
  rig.known.oscillator = {.mass = 2.0, .stiffness = 8000.0, .damping = 0.0};
  rig.known.oscillator.loss_factor = 0.05;
  rig.known.excitation.type = sim::ExcitationType::force_harmonic;
  rig.laws.push_back({friction::find_law("coulomb"), {{"kinetic", kinetic}}});
  return rig;
}

identify::Fit fit_of(identify::Rig rig, const std::vector<std::string>& names, const identify::Record& record) {
  std::string fault;
  const identify::Experiments experiments =
      identify::experiments_of(record, {.name = "response", .force_driven = true}, fault);
  REQUIRE(fault.empty());
  constexpr double off = 1.15;
  std::vector<identify::FitParameter> sought = test::sought_in(rig, names, off);
  return identify::fit_rig(rig, std::move(sought), experiments, {.profile = false});
}

}  // namespace

TEST_CASE("fit: a loss factor is found from the closed form of a frequency response", "[identify][fit]") {
  const identify::Rig rig = joint_of(0.0);
  const sim::Oscillator& o = rig.known.oscillator;
  identify::Record record;
  record.pairs.emplace();
  constexpr double force = 3.0;
  for (int i = 0; i <= 12; ++i) {
    const double omega = 50.0 + 2.0 * i;  // resonance at 63.2 rad/s
    const std::complex<double> x = force / (o.stiffness * (1.0 + 1.0i * o.loss_factor) - o.mass * omega * omega);
    record.pairs->pairs.push_back(
        {.Y = force, .x = std::abs(x), .number = i + 1, .omega = omega, .phase = -std::arg(x)});
  }
  const identify::Fit fit = fit_of(rig, {"stiffness", "loss_factor"}, record);
  REQUIRE(fit.outcome.ok());
  CHECK(fit.parameters[0].value == Approx(8000.0).epsilon(1e-6));
  CHECK(fit.parameters[1].value == Approx(0.05).epsilon(1e-5));
}

TEST_CASE("fit: a loss factor is told from a damper over frequency, not at one frequency", "[identify][fit]") {
  const identify::Rig rig = joint_of(0.2);
  std::vector<double> frequencies;
  std::vector<std::pair<double, double>> levels;
  for (int i = 0; i <= 16; ++i) {
    frequencies.push_back(48.0 + 2.0 * i);
    levels.emplace_back(1.0 + 0.5 * i, 60.0);
  }
  const std::vector<std::string> names = {"loss_factor", "damping", "kinetic"};
  const identify::Fit over_frequency = fit_of(rig, names, test::response_of(rig, 3.0, frequencies, 1e-6, 1e-3, 5));
  REQUIRE(over_frequency.outcome.ok());
  CHECK(over_frequency.not_identifiable.empty());
  const identify::Interval& interval = over_frequency.parameters[0].interval95;
  CHECK(interval[0] < 0.05);
  CHECK(interval[1] > 0.05);
  const identify::Fit at_one = fit_of(rig, names, test::steady_states_of(rig, levels, 1e-6, 1e-3, 6));
  REQUIRE(at_one.outcome.ok());
  REQUIRE(at_one.not_identifiable.size() == 1);
  CHECK(at_one.not_identifiable.front().parameters == std::vector<std::string>{"loss_factor", "damping"});
}
