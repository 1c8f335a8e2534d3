#include "friction_models/modifiers/fluctuation.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "friction_models/laws/coulomb.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "friction_models/registry.hpp"
#include "sim/conformance/law_conformance.hpp"
#include "sim/law_host/law_host.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/support/standard_system.hpp"

using namespace dualdamp;
using friction::Direction;
using friction::Fluctuation;
using friction::Law;
using friction::ParameterValues;

namespace {

constexpr double mean_kinetic = 2.0;  // N
constexpr double length = 0.02;       // m
constexpr double cell = length / 10.0;

ParameterValues over_position(double ratio, double seed) {
  const ParameterValues record{{"ratio", ratio}, {"correlation_length", length}, {"seed", seed}};
  return {{"fluctuation", std::vector<ParameterValues>{record}}};
}

Law rough_coulomb() {
  return friction::modified(Law(friction::Coulomb(mean_kinetic, mean_kinetic)), over_position(0.3, 7.0),
                            {mean_kinetic});
}

/// Work of one way from a to b under a level that a law started there has: the sum over cells, i about i times the
/// width.
double work_of_way(const Law& law, double a, double b) {
  double work = 0.0;
  for (int i = static_cast<int>(std::round(a / cell)); (i - 0.5) * cell < b; ++i) {
    const double level = law.force(law.start({.x = i * cell}), {.x = i * cell}, Direction::forward);
    work += level * (std::min(b, (i + 0.5) * cell) - std::max(a, (i - 0.5) * cell));
  }
  return work;
}

}  // namespace

TEST_CASE("fluctuation over position: a stationary Markov chain of correlation exp(-1/10)",
          "[friction][fluctuation]") {
  // n_(i+1) - rho n_i of variance 1 - rho^2, uncorrelated with n_i, n_(i-1), ...: that is the whole process, being
  // normal. 200,000 cells hold 10,000 independent ones: 4 standard errors of a second moment are 0.06 of it.
  const Fluctuation field(11);
  const double rho = std::exp(-0.1);
  const int count = 200'000;
  double variance = 0.0;
  double innovation = 0.0;
  double with_past[3] = {};
  for (int i = -count / 2; i < count / 2; ++i) {
    const double here = field.at(i);
    const double step = field.at(i + 1) - rho * here;
    variance += here * here / count;
    innovation += step * step / count;
    for (int lag = 0; lag < 3; ++lag) with_past[lag] += step * field.at(i - lag) / count;
  }
  CHECK(variance == Approx(1.0).epsilon(0.06));
  CHECK(innovation == Approx(1.0 - rho * rho).epsilon(0.06));
  // Products of independent numbers: 4 sqrt((1 - rho^2)/200,000) = 0.004.
  for (const double correlation : with_past) CHECK(std::abs(correlation) < 0.004);
}

TEST_CASE("fluctuation over position: blocks are joined without a seam", "[friction][fluctuation]") {
  // Pairs astride a multiple of 512, 6 cells apart: 4/sqrt(20,000) = 0.03.
  const Fluctuation field(12);
  const int count = 20'000;
  double correlation = 0.0;
  for (int block = 0; block < count; ++block)
    correlation += field.at(512 * block - 3) * field.at(512 * block + 3) / count;
  CHECK(std::abs(correlation - std::exp(-0.6)) < 0.04);
  CHECK(field.at(77) == Fluctuation(12).at(77));
  CHECK(field.at(77) != Fluctuation(13).at(77));
}

TEST_CASE("laws under a fluctuation over position conform to the law contract", "[friction][fluctuation]") {
  const ParameterValues rigid{{"kinetic", 2.0}, {"static", 3.0}};
  struct {
    std::string name;
    ParameterValues values;
  } const laws[] = {
      {"coulomb", rigid},
      {"contact_compliance", {{"kinetic", 2.0}, {"static", 3.0}, {"contact_stiffness", 1e3}}},
      {"lugre", {{"kinetic", 2.0}, {"static", 3.0}, {"stribeck_velocity", 0.05}, {"sigma0", 1e3}, {"sigma1", 1.0}}},
      {"bristle", {{"stiffness", 500.0}, {"snap_distance", 2e-3}, {"count", 6.0}, {"seed", 42.0}}}};
  const ParameterValues noise = over_position(0.4, 3.0);
  for (const auto& [name, values] : laws) {
    ParameterValues all = values;
    all.set("fluctuation", *noise.find("fluctuation"));
    sim::LawCase c = sim::law_case(name, all);
    c.stroke = 0.05;
    c.odd = false;
    // Whether a step of the level relaxes a spring depends on its stretch: jumps have more than one branch.
    c.random = true;
    if (name == "bristle") c.passive = false;
    CAPTURE(name);
    CHECK(sim::nonconformities(c) == std::vector<std::string>{});
  }
}

TEST_CASE("fluctuation over position: a place has one level, whichever way the mass comes",
          "[friction][fluctuation]") {
  const Law law = rough_coulomb();
  CHECK(law.aperiodic().empty());
  sim::LawHost host(law, {});
  const double A = 0.0713;
  host.move_to(A);
  CHECK(host.work() == Approx(work_of_way(law, 0.0, A)).epsilon(1e-12));
  host.move_to(-A);
  const double there = host.work();
  host.move_to(A);
  CHECK(host.work() - there == Approx(work_of_way(law, -A, A)).epsilon(1e-12));
  REQUIRE_FALSE(host.broken());
}

TEST_CASE("fluctuation over position: a motion is periodic, its friction work that of its way",
          "[friction][fluctuation]") {
  const Law law = rough_coulomb();
  const sim::SteadyState orbit = sim::steady_state(test::standard_system(law));
  REQUIRE(orbit.outcome.ok());
  CHECK(orbit.stops_per_cycle == 0);
  CHECK(orbit.stable());
  // Rounding of some 400 events a period.
  CHECK(orbit.energy.friction == Approx(2.0 * work_of_way(law, orbit.trough, orbit.peak)).epsilon(1e-11));
  CHECK(std::abs(orbit.peak + orbit.trough) > 1e-4);
}

TEST_CASE("fluctuation: over time or over position, one of them", "[friction][fluctuation]") {
  const friction::LawEntry& entry = *friction::find_law("coulomb");
  const auto faults_with = [&](const ParameterValues& record) {
    ParameterValues values{{"kinetic", 2.0}, {"fluctuation", std::vector<ParameterValues>{record}}};
    return friction::complete(entry, values);
  };
  CHECK(faults_with({{"ratio", 0.1}, {"correlation_length", 0.1}, {"seed", 1.0}}).empty());
  const auto both =
      faults_with({{"ratio", 0.1}, {"correlation_time", 1.0}, {"correlation_length", 0.1}, {"seed", 1.0}});
  REQUIRE(both.size() == 1);
  CHECK(both[0].name == "fluctuation.correlation_length");
  const auto neither = faults_with({{"ratio", 0.1}, {"seed", 1.0}});
  REQUIRE(neither.size() == 1);
  CHECK(neither[0].is_missing);
  CHECK(neither[0].name == "fluctuation.correlation_time");
}
