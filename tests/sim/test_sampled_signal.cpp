#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "core/diagnostics.hpp"
#include "sim/sampled_signal.hpp"
#include "tests/support/random.hpp"

using namespace dualdamp;
using sim::Interpolation;
using sim::Overshoot;
using sim::PolynomialPiece;
using sim::SampledSignal;

namespace {

/// Derivative of order n of a piece, s after its start.
double derivative(const PolynomialPiece& piece, int n, double s) {
  double sum = 0.0;
  for (int j = 3; j >= n; --j) sum = piece.derivatives[static_cast<std::size_t>(j)] + sum * s / (j - n + 1.0);
  return sum;
}

}  // namespace

TEST_CASE("a spline has continuous derivatives, two everywhere and three beside its ends", "[samples]") {
  test::Random random(3);
  std::vector<double> t{0.0};
  std::vector<double> y{1.0};
  for (int i = 0; i < 40; ++i) {
    t.push_back(t.back() + random.uniform(0.2, 2.0));
    y.push_back(random.uniform(-1.0, 1.0));
  }
  const SampledSignal signal(t, y, Interpolation::cubic);
  for (long n = 0; n + 1 < 40; ++n) {
    const PolynomialPiece here = signal.piece(n);
    const PolynomialPiece next = signal.piece(n + 1);
    const auto i = static_cast<std::size_t>(n);
    CHECK(here.derivatives[0] == y[i]);
    for (int order = 0; order < 3; ++order)
      CHECK(std::abs(derivative(here, order, here.duration) - next.derivatives[static_cast<std::size_t>(order)]) <
            1e-11 * std::pow(5.0, order));
    if (n == 0 || n == 38) CHECK(here.derivatives[3] == Approx(next.derivatives[3]).margin(1e-9));
  }
}

TEST_CASE("a spline gives a cubic exactly, and a line and a parabola through fewer nodes", "[samples]") {
  const auto cubic = [](double t) { return 1.0 + t * (-2.0 + t * (0.5 + 0.25 * t)); };
  const std::vector<double> t{0.0, 0.3, 1.1, 1.5, 2.7};
  std::vector<double> y;
  for (const double s : t) y.push_back(cubic(s));
  const SampledSignal signal(t, y, Interpolation::cubic);
  for (long n = 0; n < 4; ++n) {
    const PolynomialPiece piece = signal.piece(n);
    const double s = 0.4 * piece.duration;
    CHECK(derivative(piece, 0, s) == Approx(cubic(signal.begin(n) + s)).epsilon(1e-13));
  }
  const SampledSignal parabola({0.0, 1.0, 3.0}, {0.0, 1.0, 9.0}, Interpolation::cubic);
  CHECK(derivative(parabola.piece(1), 0, 1.0) == Approx(4.0).epsilon(1e-14));
  CHECK(derivative(parabola.piece(0), 0, 0.5) == Approx(0.25).epsilon(1e-14));
  const SampledSignal line({0.0, 2.0}, {1.0, 5.0}, Interpolation::cubic);
  CHECK(derivative(line.piece(0), 0, 0.5) == Approx(2.0).epsilon(1e-14));
}

TEST_CASE("a signal holds its last value, or repeats", "[samples]") {
  const SampledSignal held({0.0, 1.0, 3.0}, {2.0, 4.0, 5.0}, Interpolation::linear);
  CHECK(held.piece(2).derivatives[0] == 5.0);
  CHECK(held.piece(2).derivatives[1] == 0.0);
  CHECK(held.piece(2).duration == std::numeric_limits<double>::infinity());
  CHECK(held.begin(2) == 3.0);
  CHECK(held.begin(3) == 3.0);
  const SampledSignal repeated({0.0, 1.0, 3.0}, {2.0, 4.0, 5.0}, Interpolation::linear, true);
  CHECK(repeated.begin(5) == 7.0);
  CHECK(repeated.piece(5).derivatives[0] == 4.0);
  CHECK(repeated.piece(5).derivatives[1] == 0.5);
  CHECK(repeated.gap() == -3.0);
  CHECK(repeated.jumps());
  CHECK_FALSE(held.jumps());
  const SampledSignal steps({0.0, 1.0, 3.0}, {2.0, 4.0, 5.0}, Interpolation::step);
  CHECK(steps.piece(1).derivatives[0] == 4.0);
  CHECK(steps.piece(1).derivatives[1] == 0.0);
  CHECK(steps.jumps());
  CHECK(repeated.scaled(-2.0).piece(1).derivatives[1] == -1.0);
  CHECK(repeated.scaled(-2.0).size() == 10.0);
}

TEST_CASE("the largest overshoot of a spline is found; other signals have none", "[samples]") {
  const std::vector<double> t = {0.0, 1.0, 1.001, 2.0, 3.0};
  const std::vector<double> y = {0.0, 0.1, -0.1, 0.05, 0.0};
  const SampledSignal spline(t, y, Interpolation::cubic);
  const Overshoot found = spline.largest_overshoot();
  double largest = 0.0;
  for (int i = 0; i < 4; ++i) {
    const PolynomialPiece piece = spline.piece(i);
    for (int j = 0; j <= 10000; ++j) {
      const double value = derivative(piece, 0, 1e-4 * j * piece.duration);
      largest = std::max({largest, value - 0.1, -0.1 - value});
    }
  }
  CHECK(largest > 10.0);
  CHECK(found.size == Approx(largest).epsilon(1e-6));
  CHECK(found.t > 0.0);
  CHECK(SampledSignal(t, y, Interpolation::linear).largest_overshoot().size == 0.0);
  CHECK(SampledSignal({0.0, 1.0, 2.0, 3.0}, {0.0, 1.0, 2.0, 3.0}, Interpolation::cubic).largest_overshoot().size <
        1e-12);
}

TEST_CASE("nodes that make no signal are refused", "[samples]") {
  const auto make = [](std::vector<double> t, std::vector<double> y) {
    return SampledSignal(std::move(t), std::move(y), Interpolation::linear);
  };
  CHECK_THROWS_WITH(make({0.0}, {1.0}), Catch::Contains("too few nodes: 1"));
  CHECK_THROWS_WITH(make({0.0, 1.0}, {1.0}), Catch::Contains("as many times as values"));
  CHECK_THROWS_WITH(make({0.5, 1.0}, {1.0, 2.0}), Catch::Contains("first time"));
  CHECK_THROWS_WITH(make({0.0, 1.0, 1.0}, {1.0, 2.0, 3.0}), Catch::Contains("node 3"));
  CHECK_THROWS_WITH(make({0.0, 1.0}, {1.0, std::nan("")}), Catch::Contains("node 2"));
}
