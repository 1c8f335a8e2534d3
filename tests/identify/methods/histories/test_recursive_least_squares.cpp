#include "identify/methods/histories/recursive_least_squares.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/identify/histories.hpp"

using namespace dualdamp;
using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;

namespace {

/// The force that would make friction grow from F0 at the rate `per_second` of it: a change of friction is a force.
History drifting(double per_second, double noise, Normal& normal) {
  History history = sampled(driven_bearing(bearing_c, bearing_F0, 4e-3), 8.0, 1000.0, 2.0);
  history.force.resize(history.x.size());
  for (std::size_t i = 0; i < history.x.size(); ++i) {
    const double t = static_cast<double>(i) / history.sample_rate;
    const double v = history.v[i];
    history.force[i] = bearing_F0 * per_second * t * static_cast<double>((v > 0.0) - (v < 0.0)) + noise * normal();
  }
  return history;
}

}  // namespace

TEST_CASE("Nothing forgotten is least squares, and exact on exact data") {
  Normal normal(1);
  const Estimate e = recursive_least_squares(record_of({drifting(0.0, 0.0, normal)}), bearing_constants, {});
  REQUIRE(e.outcome.ok());
  CHECK(e.usable);
  CHECK(e.warnings.empty());
  // The start's ignorance, 1e12 times the variance of a sample, leaves its inverse.
  CHECK(e.value.c == Approx(bearing_c).epsilon(1e-9));
  CHECK(e.value.F0 == Approx(bearing_F0).epsilon(1e-9));
  REQUIRE(e.curves.size() == 1);
}

TEST_CASE("Forgetting follows a drift with a lag of its memory") {
  Normal normal(2);
  const double rate = 0.05;  // of F0 a second: 40 % over the record
  const History history = drifting(rate, 0.1, normal);
  RecursiveOptions options;
  options.forgetting = 1.0 - 1.0 / 500.0;
  const Estimate following = recursive_least_squares(record_of({history}), bearing_constants, options);
  const Estimate mean = recursive_least_squares(record_of({history}), bearing_constants, {});
  REQUIRE(following.outcome.ok());
  const double end = bearing_F0 * (1.0 + rate * 8.0);
  // An exponential memory of 500 samples, 0.5 s, lags by as much; noise of 0.1 N over 1,000 samples is small.
  CHECK(following.value.F0 == Approx(end - bearing_F0 * rate * 0.5).epsilon(0.01));
  CHECK(mean.value.F0 == Approx(bearing_F0 * (1.0 + rate * 4.0)).epsilon(0.01));
  // And without forgetting the drift is told.
  REQUIRE(mean.warnings.size() == 1);
  CHECK(mean.warnings[0].find("forgetting") != std::string::npos);
  // What is forgotten informs no more.
  CHECK(following.std->F0 > 1.5 * mean.std->F0);
}

TEST_CASE("Intervals hold under noise of the force") {
  int covered = 0;
  const int cases = 100;
  const History clean = sampled(driven_bearing(bearing_c, bearing_F0, 4e-3), 2.0, 500.0, 2.0);
  for (int seed = 0; seed < cases; ++seed) {
    Normal normal(static_cast<std::uint64_t>(seed));
    History noisy = clean;
    for (std::size_t i = 0; i < noisy.x.size(); ++i) noisy.force.push_back(normal());
    const Estimate e = recursive_least_squares(record_of({noisy}), bearing_constants, {});
    REQUIRE(e.outcome.ok());
    covered += e.interval95->F0[0] <= bearing_F0 && bearing_F0 <= e.interval95->F0[1] ? 1 : 0;
  }
  CHECK(covered >= 88);  // three standard deviations of a binomial at 0.95 below
}

TEST_CASE("A forgetting factor out of its range is refused") {
  Normal normal(1);
  RecursiveOptions options;
  options.forgetting = 1.1;
  CHECK_FALSE(
      recursive_least_squares(record_of({drifting(0.0, 0.0, normal)}), bearing_constants, options).outcome.ok());
}

TEST_CASE("Motion in one direction does not tell a Coulomb force from a zero of the force") {
  Normal normal(4);
  History history{.sample_rate = 500.0};
  double x = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double angle = 4.4 * i / history.sample_rate;
    const double v = 0.05 + 0.02 * std::sin(angle);
    const double zero = 1.5;
    x += v / history.sample_rate;
    history.x.push_back(x);
    history.force.push_back(3.0 * 0.02 * 4.4 * std::cos(angle) + 20.0 * v + 8.0 + zero + 0.05 * normal());
  }
  const Estimate e = recursive_least_squares(record_of({history}), {3.0, 0.0, unknown}, {});
  CHECK_FALSE(e.outcome.ok());
  CHECK(e.outcome.reason.find("one direction only") != std::string::npos);
}
