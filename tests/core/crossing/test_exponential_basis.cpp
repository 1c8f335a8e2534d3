#include "core/crossing/exponential_basis.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tests/support/numbers.hpp"
#include "tests/support/oracle.hpp"
#include "tests/support/random.hpp"

namespace {

using namespace dualdamp::core;
using dualdamp::test::epsilon;
using dualdamp::test::Random;

using Nodes = std::vector<Complex>;

double largest(const Nodes& nodes) {
  double size = 0.0;
  for (const Complex& z : nodes) size = std::max(size, std::abs(z));
  return size;
}

/// How large a divided difference of exp(z s) over these nodes can be: the integral over the simplex (Hermite and
/// Genocchi) gives s^n/n! max exp(Re z s), the recursion (E(without b) + E(without a))/|a - b| for any pair a, b.
/// Rounding follows the same two bounds, so an error is judged against their smaller.
double natural_size(const Nodes& nodes, double s) {
  double decay = nodes.front().real();
  double size = 1.0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    decay = std::max(decay, nodes[i].real());
    if (i > 0) size *= s / static_cast<double>(i);
  }
  size *= std::exp(decay * s);
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    for (std::size_t b = a + 1; b < nodes.size(); ++b) {
      if (nodes[a] == nodes[b]) continue;
      Nodes without_a = nodes;
      Nodes without_b = nodes;
      without_a.erase(without_a.begin() + static_cast<std::ptrdiff_t>(a));
      without_b.erase(without_b.begin() + static_cast<std::ptrdiff_t>(b));
      size =
          std::min(size, (natural_size(without_a, s) + natural_size(without_b, s)) / std::abs(nodes[a] - nodes[b]));
    }
  }
  return size;
}

ExponentialBasis chain(const Nodes& nodes) {
  ExponentialBasis basis;
  int parent = ExponentialBasis::no_parent;
  for (const Complex& z : nodes) parent = basis.add(z, parent);
  basis.finish();
  return basis;
}

Complex value_of(const ExponentialBasis& basis, int k, double s) {
  ExponentialBasis::Values values;
  basis.evaluate(s, values);
  return {values.re[static_cast<std::size_t>(k)], values.im[static_cast<std::size_t>(k)]};
}

/// Error of the top of the chain in units of eps (1 + |z| s) natural_size: rounding z s alone turns the phase by
/// eps |z| s.
double chain_error(const Nodes& nodes, double s) {
  const Complex expected = dualdamp::oracle::divided_exponential(nodes, s);
  const Complex found = value_of(chain(nodes), static_cast<int>(nodes.size()) - 1, s);
  return std::abs(found - expected) / (epsilon * (1.0 + largest(nodes) * s) * natural_size(nodes, s));
}

/// An exponent of size 1 / s times up to 300, decaying or growing little.
Complex random_exponent(Random& random, double s, double angle_size) {
  const double angle = random.logarithmic(1e-3, angle_size);
  switch (random.pick(4)) {
    case 0:
      return {-angle / s, 0.0};
    case 1:
      return {0.0, random.sign() * angle / s};
    case 2:
      return {std::min(angle, 20.0) / s * random.uniform(0.0, 1.0), angle / s};
    default:
      return std::polar(angle / s, random.sign() * random.uniform(1.6, 3.1));
  }
}

ModeFunction random_function(const ExponentialBasis& basis, Random& random) {
  ModeFunction f;
  clear(basis, f);
  for (std::size_t k = 0; k < static_cast<std::size_t>(basis.size()); ++k) {
    f.re[k] = random.sign() * random.logarithmic(1e-3, 1.0);
    f.im[k] = random.sign() * random.logarithmic(1e-3, 1.0);
  }
  return f;
}

double value_at(const ExponentialBasis& basis, const ModeFunction& f, double s) {
  ExponentialBasis::Values values;
  basis.evaluate(s, values);
  return evaluate(basis, f, values);
}

/// A basis as an oscillator has it: constant, perhaps with powers, own motion, drive, a fast decay.
ExponentialBasis random_basis(Random& random, bool chains) {
  ExponentialBasis basis;
  const int constant = basis.add(0.0);
  const double rate = random.logarithmic(0.1, 10.0);
  basis.add({0.0, rate});
  basis.add({0.0, 3.0 * rate});
  basis.add({-random.logarithmic(1e-3, 1e3), 0.0});
  if (random.chance(0.5)) basis.add({random.uniform(-1.0, 0.2), random.logarithmic(0.1, 10.0)});
  if (chains) {
    const int ramp = basis.add(0.0, constant);
    const double first = -random.logarithmic(1e-8, 1.0);
    basis.add(-random.logarithmic(1e-6, 1e3), basis.add(first, random.chance(0.5) ? constant : ramp));
    basis.add(-random.logarithmic(1.0, 1e3), basis.add(first));
    const Complex resonance(-random.logarithmic(1e-8, 1e-2) * rate, rate);
    basis.add(std::conj(resonance), basis.add(resonance, 1));
  }
  basis.finish();
  return basis;
}

/// A level of the recursion adds the rounding of the two differences below it. They are equal to within the factor
/// that separates the recursion from the integral, so four levels stay within 2^5. The Taylor form loses a few
/// units.
void check_chain(const Nodes& nodes, double s) {
  constexpr double allowed = 32.0;
  const double error = chain_error(nodes, s);
  std::string text;
  for (const Complex& z : nodes)
    text += "(" + std::to_string(z.real() * s) + ", " + std::to_string(z.imag() * s) + ") ";
  INFO("nodes times s: " << text << ", s = " << s);
  CHECK(error <= allowed);
}

}  // namespace

TEST_CASE("A plain element is exp(z s)") {
  // exp, cos and sin err by an ulp; rounding the product z s errs by eps |z s| / 2 in size and phase, which is
  // given back in the size where it has decayed below exp(-8).
  Random random(1);
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double s = random.logarithmic(1e-8, 1e3);
    const Nodes nodes = {random_exponent(random, s, 300.0)};
    const Complex expected = dualdamp::oracle::divided_exponential(nodes, s);
    const Complex found = value_of(chain(nodes), 0, s);
    const Complex product(std::max(nodes[0].real() * s, -8.0), nodes[0].imag() * s);
    const double error = std::abs(found - expected) / std::abs(expected) / (epsilon * (2.0 + std::abs(product)));
    worst = std::max(worst, error);
  }
  CHECK(worst <= 1.0);
}

TEST_CASE("An element at s = 0 is 1 without a parent and 0 with one") {
  Random random(2);
  const ExponentialBasis basis = random_basis(random, true);
  const ModeFunction f = random_function(basis, random);
  ExponentialBasis::Values values;
  basis.start(values);
  double plain = 0.0;
  for (int k = 0; k < basis.size(); ++k) {
    const bool has_parent = basis.parent(k) != ExponentialBasis::no_parent;
    CHECK(value_of(basis, k, 0.0) == (has_parent ? 0.0 : 1.0));
    CHECK(values.re[static_cast<std::size_t>(k)] == (has_parent ? 0.0 : 1.0));
    CHECK(values.im[static_cast<std::size_t>(k)] == 0.0);
    if (!has_parent) plain += f.re[static_cast<std::size_t>(k)];
  }
  CHECK(at_start(basis, f) == plain);
  CHECK(at_start(basis, f) == Approx(value_at(basis, f, 0.0)).epsilon(4 * epsilon));
}

TEST_CASE("Chains of equal exponents are s^n/n! exp(z s)") {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const auto count = static_cast<std::size_t>(2 + random.pick(4));
    const double s = random.logarithmic(1e-8, 1e3);
    const Complex z = random_exponent(random, s, 300.0);
    double factor = 1.0;
    for (std::size_t n = 1; n < count; ++n) factor *= s / static_cast<double>(n);
    const Complex expected = factor * std::exp(z * s);
    const Complex found = value_of(chain(Nodes(count, z)), static_cast<int>(count) - 1, s);
    INFO("z = " << z << ", s = " << s << ", " << count << " nodes");
    CHECK(std::abs(found - expected) <= epsilon * (8.0 + 2.0 * std::abs(z) * s) * std::abs(expected));
  }
}

TEST_CASE("Chains keep their digits: exponents near each other, 1e-16 to 1e-1 apart") {
  Random random(4);
  for (int i = 0; i < 600; ++i) {
    const double s = random.logarithmic(1e-8, 1e3);
    Nodes nodes(static_cast<std::size_t>(2 + random.pick(4)), random_exponent(random, s, 100.0));
    const double distance = random.logarithmic(1e-16, 1e-1);
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      nodes[k] *= 1.0 + distance * random.uniform(-1.0, 1.0);
      if (nodes[k].imag() != 0.0) nodes[k] += Complex(0.0, distance * random.uniform(-1.0, 1.0) * nodes[k].imag());
    }
    check_chain(nodes, s);
  }
}

TEST_CASE("Chains keep their digits: exponents far apart") {
  Random random(4);
  for (int i = 0; i < 400; ++i) {
    const double s = random.logarithmic(1e-8, 1e3);
    Nodes nodes;
    for (int k = 2 + random.pick(4); k > 0; --k) nodes.push_back(random_exponent(random, s, 300.0));
    check_chain(nodes, s);
  }
}

TEST_CASE("Chains keep their digits: exponents in two clusters") {
  Random random(4);
  for (int i = 0; i < 400; ++i) {
    const double s = random.logarithmic(1e-8, 1e3);
    const Complex a = random_exponent(random, s, 30.0);
    const Complex b = random_exponent(random, s, 30.0);
    const double distance = random.logarithmic(1e-16, 1.0);
    Nodes nodes;
    for (int k = 2 + random.pick(4); k > 0; --k) {
      nodes.push_back((random.chance(0.5) ? a : b) * (1.0 + distance * random.uniform(-1.0, 1.0)));
    }
    check_chain(nodes, s);
  }
}

TEST_CASE("Chains keep their digits: exponents of an oscillator's own pair below a drive, a constant and a ramp") {
  Random random(4);
  for (int i = 0; i < 400; ++i) {
    const double s = random.logarithmic(1e-8, 1e3);
    const double omega = random.logarithmic(1e-3, 100.0) / s;
    const double zeta = random.logarithmic(1e-16, 0.99);
    const Complex own(-zeta * omega, omega * std::sqrt((1.0 - zeta) * (1.0 + zeta)));
    const Complex drive(0.0, own.imag() * (1.0 + random.sign() * random.logarithmic(1e-16, 1e-1)));
    check_chain({drive, own, std::conj(own)}, s);
    check_chain({own, std::conj(own)}, s);
    check_chain({0.0, own, std::conj(own)}, s);
    check_chain({0.0, 0.0, own, std::conj(own)}, s);
    const double slow = -random.logarithmic(1e-10, 1.0) / s;
    const double fast = -random.logarithmic(1.0, 300.0) / s;
    check_chain({0.0, 0.0, slow, fast}, s);
    check_chain({slow, fast}, s);
  }
}

TEST_CASE("Elements obey E' = z E + E_parent and differentiate() follows") {
  // Central differences of order six: truncation (|z| h)^6/140 = 4e-14, rounding about eps/(|z| h) = 4e-14.
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const ExponentialBasis basis = random_basis(random, true);
    const ModeFunction f = random_function(basis, random);
    ModeFunction slope;
    differentiate(basis, f, slope);
    const double s = random.logarithmic(0.1, 10.0);
    for (int k = 0; k < basis.size(); ++k) {
      double rate = 1e-3;
      for (int p = k; p != ExponentialBasis::no_parent; p = basis.parent(p)) {
        rate = std::max(rate, std::abs(basis.exponent(p)));
      }
      const double h = 0.01 / std::max(rate, 1.0 / s);
      const auto e = [&](double offset) { return value_of(basis, k, s + offset * h); };
      const Complex difference = (45.0 * (e(1) - e(-1)) - 9.0 * (e(2) - e(-2)) + (e(3) - e(-3))) / (60.0 * h);
      Complex expected = basis.exponent(k) * e(0);
      if (basis.parent(k) != ExponentialBasis::no_parent) expected += value_of(basis, basis.parent(k), s);
      CHECK(std::abs(difference - expected) <=
            1e-10 * (std::abs(e(-3)) + std::abs(e(3))) * std::max(rate, 1.0 / s));
    }
    // The same for the sum of all, term by term: f' = Re sum c_k (z_k E_k + E_parent).
    double expected = 0.0;
    double scale = 0.0;
    for (int k = 0; k < basis.size(); ++k) {
      const Complex c(f.re[static_cast<std::size_t>(k)], f.im[static_cast<std::size_t>(k)]);
      Complex rate = basis.exponent(k) * value_of(basis, k, s);
      if (basis.parent(k) != ExponentialBasis::no_parent) rate += value_of(basis, basis.parent(k), s);
      expected += (c * rate).real();
      scale += std::abs(c) * std::abs(basis.exponent(k) * value_of(basis, k, s)) + std::abs(c * rate);
    }
    CHECK(std::abs(value_at(basis, slope, s) - expected) <= 32 * epsilon * scale);
  }
}

TEST_CASE("accumulate() and clear() are addition and zero") {
  Random random(6);
  const ExponentialBasis basis = random_basis(random, true);
  const ModeFunction f = random_function(basis, random);
  const ModeFunction g = random_function(basis, random);
  ModeFunction sum = f;
  accumulate(basis, -2.5, g, sum);
  const double s = 0.7;
  CHECK(value_at(basis, sum, s) == Approx(value_at(basis, f, s) - 2.5 * value_at(basis, g, s)).epsilon(1e-13));
  clear(basis, sum);
  CHECK(value_at(basis, sum, s) == 0.0);
}

TEST_CASE("shift() is evaluate() at the shifted time, and refuses what it cannot do exactly") {
  Random random(7);
  for (int i = 0; i < 300; ++i) {
    const ExponentialBasis basis = random_basis(random, false);
    const double s = random.uniform(0.0, 10.0);
    double fastest = 0.0;
    for (int k = 0; k < basis.size(); ++k) fastest = std::max(fastest, std::abs(basis.exponent(k)));
    const double delta = random.sign() * random.logarithmic(1e-18, 0.099) / fastest;
    ExponentialBasis::Values shifted;
    ExponentialBasis::Values expected;
    basis.evaluate(s, shifted);
    basis.evaluate(s + delta, expected);
    REQUIRE(basis.shift(delta, shifted));
    for (int k = 0; k < basis.size(); ++k) {
      const Complex difference(shifted.re[static_cast<std::size_t>(k)] - expected.re[static_cast<std::size_t>(k)],
                               shifted.im[static_cast<std::size_t>(k)] - expected.im[static_cast<std::size_t>(k)]);
      // s + delta itself is rounded: eps |z| s of phase.
      const double size = std::exp(basis.exponent(k).real() * s);
      CHECK(std::abs(difference) <= epsilon * (4.0 + 2.0 * std::abs(basis.exponent(k)) * s) * size);
    }
    const ExponentialBasis::Values before = shifted;
    CHECK_FALSE(basis.shift(0.101 / fastest, shifted));
    CHECK(shifted.re[1] == before.re[1]);
  }
  ExponentialBasis::Values values;
  const ExponentialBasis chained = chain({-1.0, -1.0});
  chained.evaluate(1.0, values);
  CHECK_FALSE(chained.shift(1e-9, values));
}

TEST_CASE("step_panel() walks panel by panel, an ulp or two a step") {
  Random random(8);
  for (int i = 0; i < 20; ++i) {
    const ExponentialBasis basis = random_basis(random, false);
    ExponentialBasis::Values values;
    basis.evaluate(0.0, values);
    for (int step = 1; step <= 200; ++step) {
      ExponentialBasis::Values next;
      basis.step_panel(values, next);
      values = next;
      if (step != 1 && step != 200) continue;
      ExponentialBasis::Values expected;
      const double s = step * basis.panel();
      basis.evaluate(s, expected);
      for (int k = 0; k < basis.size(); ++k) {
        const auto e = static_cast<std::size_t>(k);
        // One complex product: 3 eps at most; the rotor itself: 2 eps; both add up.
        const double size = std::hypot(expected.re[e], expected.im[e]);
        const double allowed = 5.0 * step + 2.0 * std::abs(basis.exponent(k)) * s;
        CHECK(std::abs(values.re[e] - expected.re[e]) <= epsilon * allowed * size + 1e-300);
        CHECK(std::abs(values.im[e] - expected.im[e]) <= epsilon * allowed * size + 1e-300);
      }
    }
  }
}

TEST_CASE("bound() is a bound on the whole interval, and not a wasteful one on a panel") {
  Random random(9);
  double waste = 1.0;
  for (int i = 0; i < 3000; ++i) {
    const bool chains = random.chance(0.5);
    const ExponentialBasis basis = random_basis(random, chains);
    const ModeFunction f = random_function(basis, random);
    const double begin = random.chance(0.2) ? 0.0 : random.logarithmic(1e-6, 100.0);
    const bool panel = random.chance(0.5);
    const double width = panel ? basis.panel() : random.logarithmic(1e-6, 100.0);
    ExponentialBasis::Values values;
    basis.evaluate(begin, values);
    const double limit = bound(basis, f, values, begin, width);
    double sum = 0.0;  // of the moduli at the end points, what a bound cannot be far below
    double largest = 0.0;
    for (int j = 0; j <= 40; ++j) {
      basis.evaluate(begin + width * j / 40.0, values);
      largest = std::max(largest, std::abs(evaluate(basis, f, values)));
      double moduli = 0.0;
      for (std::size_t k = 0; k < static_cast<std::size_t>(basis.size()); ++k) {
        moduli += std::hypot(f.re[k], f.im[k]) * std::hypot(values.re[k], values.im[k]);
      }
      sum = std::max(sum, moduli);
    }
    INFO("begin " << begin << ", width " << width << ", chains " << chains);
    CHECK(largest <= limit * (1.0 + 64 * epsilon));
    if (panel) waste = std::max(waste, limit / sum);
  }
  // |c| and |E| by their 1-norms lose 2 together, a growing element exp(Re z width) <= 5, a chain 1 + |z| width.
  CHECK(waste <= 8.0);
}
