#include "core/interval_start.hpp"

#include "tests/core/guard_problems.hpp"

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
