#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "sim/engine/linear_mode.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/oracle.hpp"
#include "tests/support/random.hpp"

using namespace dualdamp;
using oracle::LinearProblem;
using test::epsilon;
using test::Random;

namespace {

/// The state at s, by a mode.
oracle::State solved(const LinearProblem& p, const sim::LinearMode::Layout& layout, double s) {
  const sim::LinearMode mode(p.mass, p.damping, p.stiffness, {}, layout);
  core::ModeFunction x;
  core::ModeFunction v;
  mode.solve({.polynomial = {p.constant, p.ramp, p.second, p.third}}, p.x0, p.v0, x);
  core::differentiate(mode.basis(), x, v);
  core::ExponentialBasis::Values values;
  mode.basis().evaluate(s, values);
  return {core::evaluate(mode.basis(), x, values), core::evaluate(mode.basis(), v, values)};
}

}  // namespace

TEST_CASE("powers of time drive a mode as the oracle says, brief or not", "[mode]") {
  Random random(77);
  double worst = 0.0;
  for (int round = 0; round < 400; ++round) {
    LinearProblem p{.mass = random.logarithmic(0.1, 10.0)};
    const double w = random.logarithmic(1e-2, 1e2);
    p.stiffness = random.chance(0.1) ? 0.0 : p.mass * w * w * (random.chance(0.1) ? -1.0 : 1.0);
    p.damping = random.chance(0.1) ? 0.0 : 2.0 * p.mass * w * random.logarithmic(1e-3, 20.0);
    const double rate = p.damping / p.mass + std::sqrt(std::abs(p.stiffness) / p.mass);
    if (rate == 0.0) continue;
    const bool is_brief = random.chance(0.5);
    const double s = (is_brief ? random.logarithmic(1e-5, 1.0) : random.uniform(1.0, 6.0)) / rate;
    const int degree = random.pick(4);
    // Each power is of the same size at s.
    const double force = p.mass / (s * s);
    p.constant = random.uniform(-1.0, 1.0) * force;
    if (degree > 0) p.ramp = random.uniform(-1.0, 1.0) * force / s;
    if (degree > 1) p.second = random.uniform(-1.0, 1.0) * 2.0 * force / (s * s);
    if (degree > 2) p.third = random.uniform(-1.0, 1.0) * 6.0 * force / (s * s * s);
    p.x0 = random.uniform(-1.0, 1.0);
    p.v0 = random.uniform(-1.0, 1.0) / s;
    const auto expected = oracle::solve(p, s);
    const oracle::State found = solved(p, {.degree = degree, .is_brief = is_brief}, s);
    const double error = std::max(std::abs(found.x - expected.x), s * std::abs(found.v - expected.v)) /
                         (1.0 + std::abs(expected.x) + s * std::abs(expected.v));
    INFO("m " << p.mass << " C " << p.damping << " K " << p.stiffness << " s " << s << " degree " << degree
              << (is_brief ? " brief" : "") << " error " << error);
    if (is_brief) worst = std::max(worst, error);
    // If they are not on one chain, the particular solution loses 1/(rate s)^degree, or that of the slow one of two
    // exponents.
    CHECK(error < (is_brief ? 16.0 * epsilon : 1e-9));
  }
  WARN("largest error of brief modes " << worst);
}
