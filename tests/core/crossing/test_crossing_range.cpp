/// The search at the ends of the range: growth, amplitudes near the smallest and largest numbers, rates far apart.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/crossing/first_crossing.hpp"
#include "guard_problems.hpp"

namespace {

using namespace dualdamp::core;
using namespace dualdamp::core::guard_problems;

Terms scaled(Terms terms, double factor) {
  for (Term& term : terms) term.coefficient *= factor;
  return terms;
}

/// The same guard under another unit of time.
Terms faster(Terms terms, double factor) {
  for (Term& term : terms) term.exponent *= factor;
  return terms;
}

}  // namespace

TEST_CASE("A guard that leaves the range of double precision ends the search, and says so") {
  CHECK(search({{1.0, 1.0}}, 1e4).end == SearchEnd::left_range);
  CHECK(search({{1.0, 1e-300}, constant(1.0)}, 1e4).end == SearchEnd::left_range);
  CHECK(search({{Complex(1.0, 5.0), 1.0}, constant(1e200)}, 1e4).end == SearchEnd::crossing);
  CHECK(search({{1.0, 1.0}}, 100.0).end == SearchEnd::horizon);
  // Beside a guard that crosses before.
  const Result both = search(Problem({{{1.0, 1.0}}, {constant(1.0), {0.0, 0.0}, {0.0, -1e-2, 1}}}), 1e4);
  check_crossing(both, 1, 100.0, 1e-12);
}

TEST_CASE("A guard that turns too often before the horizon ends the search, and says so") {
  // cos(s) - 0.5 cos(s) + 1.2 never crosses, but the moduli of its elements do not tell; its panels up to here
  // would take an hour.
  const Terms wave = {{Complex(0.0, 1.0), 1.0}, {Complex(0.0, 1.0), -0.5}, constant(1.2)};
  CHECK(search(wave, 1e10).end == SearchEnd::too_long);
  CHECK(search(wave, 1e4).end == SearchEnd::horizon);
}

TEST_CASE("A guard that turns a million times far from zero is passed in few panels, up to its crossing") {
  const Result never = search({{Complex(0.0, 1.0), 1.0}, constant(1.5)}, 1e10);
  CHECK(never.end == SearchEnd::horizon);
  CHECK(never.count.panels < 100);
  // 1 - s/T + 0.1 cos(w s + 0.3), w T = 1e7, is positive up to 0.9 T. A scan from there on and bisection give its
  // first zero.
  const double w = 1e4;
  const double T = 1e3;
  const Terms fading = {{Complex(0.0, w), std::polar(0.1, 0.3)}, constant(1.0), {0.0, -1.0 / T, 1}};
  const auto g = [&](double s) { return 1.0 - s / T + 0.1 * std::cos(w * s + 0.3); };
  double high = 0.9 * T;
  while (g(high) > 0.0) high += 1e-3 / w;
  double low = high - 1e-3 / w;
  for (int i = 0; i < 60; ++i) (g(0.5 * (low + high)) > 0.0 ? low : high) = 0.5 * (low + high);
  const Result result = search(fading, 2.0 * T);
  REQUIRE(result.end == SearchEnd::crossing);
  CHECK(std::abs(result.crossing.s - low) < 1e-9);  // a turn takes 6e-4
  CHECK(result.count.panels < 10000);
}

TEST_CASE("An element that has left the range has no part in guards without it") {
  // Growth by e^24000 beside 1 - s/2000 and beside cos(s/1000), whose elements do not grow.
  for (const double growth : {0.5, 6.0, 1e3}) {
    for (const Complex own : {Complex(growth), Complex(growth, 8.0)}) {
      CAPTURE(own);
      const Terms linear{{own, 0.0}, constant(1.0), {0.0, -1.0 / 2000.0, 1}};
      check_crossing(search(linear, 4000.0), 0, 2000.0, 2000.0 * 4 * epsilon);
      const Terms slow{{own, 0.0}, cosine(1.0, 1e-3)};
      check_crossing(search(slow, 4000.0), 0, 500.0 * pi, 2000.0 * 4 * epsilon);
      const Terms chained{{own, 0.0}, {-own, 0.0, 0}, cosine(1.0, 1e-3)};
      check_crossing(search(chained, 4000.0), 0, 500.0 * pi, 2000.0 * 4 * epsilon);
      const Result positive = search({{own, 0.0}, constant(1.0), cosine(0.5, 1e-3)}, 4000.0);
      CHECK(positive.end == SearchEnd::horizon);
    }
  }
}

TEST_CASE("A growth that crosses late is found wherever double precision reaches") {
  // 1 - c e^s at ln(1/c).
  for (const double c : {1e-20, 1e-100, 1e-200, 1e-290}) {
    const double root = -std::log(c);
    check_crossing(search({{1.0, -c}, constant(1.0)}, 705.0), 0, root, 8 * epsilon * root);
  }
  // e^s (1 + 1e-3 cos 5s) - c e^(s/2): starts negative of c, so turned around; at 2 ln c but for the ripple.
  const Result late = search({{1.0, -1e-100}, {0.5, 1.0}}, 600.0);
  check_crossing(late, 0, 2.0 * std::log(1e100), 1e-12);
}

TEST_CASE("The unit of a guard does not matter, from 1e-300 to 1e300") {
  const std::vector<std::pair<Terms, double>> cases = {
      {{cosine(1.0, 1.0)}, 10.0},
      {{constant(0.3), {Complex(-0.05, 1.0), 1.0}, cosine(0.4, 2.3, 0.5)}, 30.0},
      {{constant(1.0), cosine(1.0, 1.0)}, 10.0},                                      // grazes
      {{{-1.0, 1.0}, {-1e3, 0.5}, {-1e-3, -1e-4}}, 100.0},                            // rates far apart
      {{{-0.3, 1.0}, {Complex(-0.3, 1.0), 0.9}, {Complex(-0.2, 1.0), 1e-5}}, 300.0},  // far down a decay
      {{{0.2, -1e-3}, {Complex(-0.1, 2.0), 0.5}, constant(2.0)}, 60.0},               // grows
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const auto& [terms, horizon] = cases[i];
    const Result here = search(terms, horizon);
    for (const int power : {-990, -700, -540, -270, -60, 60, 270, 540, 700, 990}) {
      CAPTURE(i, power);
      const Result there = search(scaled(terms, std::ldexp(1.0, power)), horizon);
      CHECK(there.end == here.end);
      CHECK(std::abs(there.crossing.s - here.crossing.s) <= 4 * epsilon * here.crossing.s);
      CHECK(there.grazings.size() == here.grazings.size());
    }
    for (const double unit : {1e-40, 1e-12, 1e12, 1e40}) {
      CAPTURE(i, unit);
      const Result there = search(faster(terms, unit), horizon / unit);
      CHECK(there.end == here.end);
      CHECK(std::abs(there.crossing.s * unit - here.crossing.s) <= 16 * epsilon * here.crossing.s);
    }
  }
}

TEST_CASE("Panels follow the slow elements once the fast ones have died out, however far apart they are") {
  for (const double decay : {1e2, 1e4, 1e6, 1e9}) {
    CAPTURE(decay);
    // A velocity under a heavy damper: driven at 1, a fast start of its own.
    const Result driven = search({cosine(1.0, 1.0, -1.5), {-decay, 5.0}, {-1.0 / decay, -1e-9}}, 6.28);
    CHECK(driven.end == SearchEnd::crossing);
    CHECK(driven.count.panels + driven.count.splits < 40);
    // Fast contacts beside it, each with its own rate.
    Terms contacts{cosine(1.0, 1.0, -1.5)};
    for (int i = 0; i < 12; ++i) contacts.push_back({-decay * std::pow(1.7, i), 0.1});
    const Result many = search(contacts, 6.28);
    CHECK(many.end == SearchEnd::crossing);
    CHECK(many.count.panels + many.count.splits < 60);
  }
}

// 1 + d + cos s is d above zero at its minima; the rounding of s makes 4.4e-16 s of its value. So with d = 2e-14
// the minima behind s = 100 are tangencies, although the constant outweighs the wave by more than the rounding at s
// = 0.
TEST_CASE("A far minimum within the rounding of its time is reported, not passed") {
  const Result result = search({{Complex(0.0, 1.0), 1.0}, constant(1.0 + 2e-14)}, 1000.0);
  CHECK(result.end == SearchEnd::horizon);
  int minima = 0;
  for (double s = std::numbers::pi; s < 1000.0; s += 2.0 * std::numbers::pi) {
    if (s < 100.0) continue;
    ++minima;
    CHECK(std::ranges::any_of(result.grazings,
                              [s](const Grazing& grazing) { return std::abs(grazing.s - s) < 1e-3; }));
  }
  CHECK(minima == 143);
}
