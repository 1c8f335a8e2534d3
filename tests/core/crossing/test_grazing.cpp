#include "core/crossing/grazing.hpp"

#include "tests/core/crossing/guard_problems.hpp"

using namespace dualdamp::core;
using namespace dualdamp::core::guard_problems;

TEST_CASE("A double root is one grazing, every time it comes, and not a crossing") {
  const Result once = search({constant(1.0), cosine(1.0, 1.0)}, 6.0);
  CHECK_FALSE(once.crossing.found);
  REQUIRE(once.grazings.size() == 1);
  // Value within 16 eps of zero: 2 (s - pi)^2 / 4 <= 32 eps.
  CHECK(std::abs(once.grazings[0].s - pi) <= std::sqrt(64.0 * epsilon));
  CHECK(once.count.grazings == 1);

  const Result often = search({constant(1.0), cosine(1.0, 1.0)}, 200.0 * pi);
  CHECK_FALSE(often.crossing.found);
  CHECK(often.grazings.size() == 100);

  const Result parabola = search(polynomial({1.0, -2.0, 1.0}), 3.0);
  CHECK_FALSE(parabola.crossing.found);
  CHECK(parabola.grazings.size() == 1);
}

TEST_CASE("A grazing behind the crossing is not reported, one before it is, whatever the order of the guards") {
  const Terms crossing = polynomial({2.0, -1.0});             // at 2
  const Terms early = {constant(1.0), cosine(1.0, pi)};       // touches at 1 and 3
  const Terms late = {constant(1.0), cosine(1.0, pi / 2.5)};  // touches at 2.5
  const std::vector<std::vector<Terms>> orders = {
      {crossing, early, late}, {early, late, crossing}, {late, crossing, early}, {late, early, crossing}};
  for (const auto& guards : orders) {
    const Result result = search(Problem(guards), 10.0);
    REQUIRE(result.crossing.found);
    CHECK(std::abs(result.crossing.s - 2.0) <= 8 * epsilon);
    REQUIRE(result.grazings.size() == 1);
    CHECK(std::abs(result.grazings[0].s - 1.0) <= 1e-7);
    CHECK(result.count.grazings == 1);
  }
}

TEST_CASE("Grazings of an earlier search stay in the list") {
  const Problem problem({{constant(1.0), cosine(1.0, 1.0)}, polynomial({7.0, -1.0})});
  Result result;
  result.grazings.push_back({5, 1e6});
  result.end =
      first_crossing(problem.basis(), problem.guards(), 100.0, result.crossing, result.grazings, result.count);
  CHECK(result.crossing.found);
  REQUIRE(result.grazings.size() == 2);
  CHECK(result.grazings[0].guard == 5);
}

TEST_CASE("A grazing that is not over where another guard crosses is no grazing") {
  // One guard sinks into rounding at s = 0.033 and leaves it, below zero, when (turn s)^2/2 > 32 eps: behind 1.2,
  // or never. In the middle of that contact the other guard crosses.
  for (const double turn : {0.0, 1e-7}) {
    const Terms sinking = {{-1e3, 1.0}, cosine(1.0, turn), constant(-1.0)};
    for (const double s : {0.034, 0.04, 0.05, 0.3}) {
      for (const int crossing : {0, 1}) {
        std::vector<Terms> guards = {polynomial({s, -1.0}), sinking};
        if (crossing == 1) std::swap(guards[0], guards[1]);
        const Result result = search(Problem(guards), 10.0);
        CAPTURE(turn, s, crossing);
        check_crossing(result, crossing, s, 8 * epsilon * s);
        CHECK(result.grazings.empty());
      }
    }
  }
}

TEST_CASE("A root pair is two events down to a gap of 1e-7 of the period, and one grazing below") {
  // cos s + cos(gap/2) vanishes at pi -+ gap/2 and dips by gap^2/8. g is known to e = 2 eps A, A = 2, hence the
  // root to e/|g'| = 2 e/gap, and the reported dip has depth above 16 eps A = 7e-15 while gap > 2.4e-7.
  for (double gap = 0.1 * 2.0 * pi; gap > 0.99e-7 * 2.0 * pi; gap /= std::sqrt(10.0)) {
    const double level = std::cos(gap / 2.0);
    CAPTURE(gap);
    check_crossing(search({cosine(1.0, 1.0), constant(level)}, 6.0), 0, std::acos(-level), 16 * epsilon / gap);
  }
  for (const double gap : {1e-8, 3e-9, 1e-9}) {
    const Result result = search({cosine(1.0, 1.0), constant(std::cos(gap / 2.0))}, 6.0);
    CHECK_FALSE(result.crossing.found);
    CHECK(result.grazings.size() == 1);
  }
  // On a chain: (s - 1)^2 - (gap/2)^2.
  for (const double gap : {1e-1, 1e-3, 1e-5, 1e-6}) {
    CAPTURE(gap);
    const Terms terms = polynomial({(1.0 - gap / 2.0) * (1.0 + gap / 2.0), -2.0, 1.0});
    check_crossing(search(terms, 3.0), 0, 1.0 - gap / 2.0, 64 * epsilon / gap);
  }
}

TEST_CASE("A minimum just above zero is neither a crossing nor a grazing") {
  for (const double height : {1e-1, 1e-4, 1e-7, 1e-10, 1e-13}) {
    const Result result = search({constant(1.0 + height), cosine(1.0, 1.0)}, 60.0);
    CAPTURE(height);
    CHECK_FALSE(result.crossing.found);
    CHECK(result.grazings.empty());
  }
}

TEST_CASE("Flatter zeros: a fourfold root is one grazing, a threefold root is a crossing") {
  // |s - 1|^n <= 64 eps A is all that can be asked of the place, A = 2^n (and n! from the chain's coefficients).
  const Result fourfold = search(polynomial({1.0, -4.0, 6.0, -4.0, 1.0}), 3.0);
  CHECK_FALSE(fourfold.crossing.found);
  CHECK(fourfold.grazings.size() == 1);
  const Result threefold = search(polynomial({1.0, -3.0, 3.0, -1.0}), 3.0);
  check_crossing(threefold, 0, 1.0, std::cbrt(64.0 * epsilon * 14.0));
  CHECK(threefold.grazings.empty());
}
