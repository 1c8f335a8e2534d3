#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "identify/ledger/ledger.hpp"
#include "tests/identify/ledger/laboratory.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

TEST_CASE("Few frequencies at one exact level above resonance violate nothing but by chance") {
  // At one level the measured amplitude is a curve over the frequency and its own noise. Taken for a regressor, it
  // left no noise: all of these were rejected.
  Rig rig;
  rig.m = 0.8;
  rig.k = rig.m * std::pow(2.0 * std::numbers::pi * 12.0, 2);
  rig.zeta = 0.2;
  rig.F0 = rig.k * 0.6e-3;
  rig.on_base = true;
  std::vector<Steady> states;
  const std::vector<double> ratios = {0.92, 0.94, 0.98, 1.0, 1.03, 1.08, 1.12, 1.15, 1.2};
  for (const double r : ratios) states.push_back(steady_state(rig, 1.8 * rig.x_f(), r * rig.omega()));
  std::mt19937_64 random(31);
  std::normal_distribution<double> normal;
  int rejected = 0;
  for (int i = 0; i < 12; ++i) {
    PairRecord record;
    for (std::size_t j = 0; j < ratios.size(); ++j)
      record.pairs.push_back({.Y = 1.8 * rig.x_f(),
                              .x = states[j].x + 0.01 * rig.x_f() * normal(random),
                              .number = static_cast<int>(j) + 1,
                              .omega = ratios[j] * rig.omega(),
                              .phase = states[j].phase + 0.005 * normal(random)});
    Record measured;
    measured.pairs = std::move(record);
    rejected += ledger_of(measured, {rig.m, rig.k, unknown}).departures.empty() ? 0 : 1;
  }
  CHECK(rejected <= 4);  // of three degrees of freedom the noise is known to a factor; 12 of 12 before
}

TEST_CASE("Seven states tell a stiffness that is 2 % off") {
  // A curve with six columns left so little noise that nothing was tested: F0 = 0 was an answer.
  int named = 0;
  for (std::uint64_t seed = 100; seed < 110; ++seed) {
    const Measured m = measured(Kind::response, seed, nullptr, {.stiffness = 0.02, .states = 7});
    named += ledger_of(m.record, m.constants).is_violated(Assumption::constants) ? 1 : 0;
  }
  CHECK(named >= 9);
}
