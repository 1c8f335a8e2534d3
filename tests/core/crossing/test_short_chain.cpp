#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <limits>

#include "core/crossing/exponential_basis.hpp"
#include "core/crossing/short_chain.hpp"
#include "tests/support/oracle.hpp"
#include "tests/support/random.hpp"

using namespace dualdamp;
using core::Complex;

TEST_CASE("a short chain is the divided differences of the oracle", "[basis]") {
  // Each G_m adds three terms of the two above it: a few roundings.
  constexpr double allowed = 8.0 * std::numeric_limits<double>::epsilon();
  test::Random random(5);
  for (int round = 0; round < 300; ++round) {
    Complex a;
    Complex b;
    if (random.chance(0.5)) {
      a = std::polar(random.logarithmic(1e-4, 1.0), random.angle());
      b = std::conj(a);
    } else {
      a = random.chance(0.2) ? 0.0 : random.uniform(-1.0, 1.0);
      b = random.chance(0.2) ? a.real() : random.uniform(-1.0, 1.0);
    }
    const std::size_t count = 2 + static_cast<std::size_t>(random.pick(4));
    const core::ShortChain chain((a + b).real(), (a * b).real(), count);
    const double s = random.chance(0.1) ? 1.0 : random.logarithmic(1e-6, 1.0);
    const auto g = chain.at(s);
    std::array<Complex, 6> nodes = {a, b};
    INFO("a " << a << " b " << b << " s " << s);
    for (std::size_t m = 1; m <= count; ++m) {
      const double expected = oracle::divided_exponential({nodes.data(), m + 1}, s).real();
      CHECK(std::abs(g[m - 1] - expected) <= allowed * std::abs(expected));
    }
    CHECK(std::abs(chain.exponential(a, g) - std::exp(a * s)) <= allowed * std::exp(1.0));
  }
}

TEST_CASE("a basis evaluates short chains and powers as any other chain", "[basis]") {
  const Complex a(-0.3, 2.0);
  core::ExponentialBasis basis;
  const int first = basis.add(a);
  int last = basis.add(std::conj(a), first);
  for (int n = 0; n < 3; ++n) last = basis.add(0.0, last);
  int power = basis.add(0.0);
  for (int n = 0; n < 3; ++n) power = basis.add(0.0, power);
  basis.finish();
  for (const double s : {0.0, 0.01, 0.4, 0.49, 0.51, 3.0}) {
    core::ExponentialBasis::Values values;
    basis.evaluate(s, values);
    for (int k = 0; k < basis.size(); ++k) {
      std::array<Complex, 6> nodes{};
      std::size_t count = 0;
      for (int i = k; i != core::ExponentialBasis::no_parent; i = basis.parent(i))
        nodes[count++] = basis.exponent(i);
      const Complex expected = oracle::divided_exponential({nodes.data(), count}, s);
      const Complex found(values.re[static_cast<std::size_t>(k)], values.im[static_cast<std::size_t>(k)]);
      INFO("element " << k << " at " << s);
      CHECK(std::abs(found - expected) <= 1e-14 * std::abs(expected));
    }
  }
}
