#include "core/crossing/interval_start.hpp"

#include "tests/core/crossing/guard_problems.hpp"

using namespace dualdamp::core;
using namespace dualdamp::core::guard_problems;

TEST_CASE("The germ tells the order of the zero at the start and the sign behind it") {
  const auto germ_of = [](const std::vector<double>& c) {
    const Problem problem({polynomial(c)});
    const Germ found = germ(problem.basis(), problem.guards()[0], 0.0);
    return std::pair(found.sign, found.zeros);
  };
  CHECK(germ_of({1e-3, -1.0}) == std::pair(1, 0));
  CHECK(germ_of({-1e-3, 1.0}) == std::pair(-1, 0));
  CHECK(germ_of({0.0, 1e-9, -1.0}) == std::pair(1, 1));
  CHECK(germ_of({0.0, 0.0, -1e-9, 1.0}) == std::pair(-1, 2));
  CHECK(germ_of({0.0, 0.0, 0.0, 1.0}) == std::pair(1, 3));
  CHECK(germ_of({0.0, 0.0, 0.0, 0.0, 1.0}).first == 0);
  // Rounding counts as zero: 1 - cos s with its constant off by an ulp.
  const Problem problem({{constant(1.0 + epsilon), cosine(-1.0, 1.0)}});
  CHECK(germ(problem.basis(), problem.guards()[0], 0.0).sign == 1);
  CHECK(germ(problem.basis(), problem.guards()[0], 0.0).zeros == 2);
}

TEST_CASE("A coefficient that counts only later is no rounding of the start") {
  const auto begins = [](double rate) {
    ExponentialBasis basis;
    const int own = basis.add(Complex(0.0, rate));
    int power = basis.add(0.0);
    const int constant = power;
    for (int n = 0; n < 3; ++n) power = basis.add(0.0, power);
    basis.finish();
    ModeFunction f;
    clear(basis, f);
    f.re[static_cast<std::size_t>(own)] = 1e-6;
    f.re[static_cast<std::size_t>(constant)] = -1e-3;
    f.re[static_cast<std::size_t>(power)] = 1e14;
    return std::pair(start_amplitude(basis, f), germ(basis, f, 0.0).zeros);
  };
  // Beside motions of 1e6 rad/s it reaches 1e14/1e18 of them.
  CHECK(begins(1e6).first == Approx(1e-3 + 1e-6 + 1e-4));
  CHECK(begins(1e6).second == 0);
}
