#include "sim/analytic/free_decay.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace dualdamp::sim::analytic;

TEST_CASE("Every half swing of the closed form solves the differential equation") {
  // From rest at X the half swing lasts pi/s in units of 1/wn and follows
  //   x = x_f + (X - x_f) exp(-zeta t)(cos s t + zeta/s sin s t),   x' < 0,
  // which at its end is x_f - (X - x_f) R: the turning point on the other side.
  const double zeta = 0.0819, x_f = 0.807e-3, X_0 = 13.6e-3;
  const double R = half_swing_decay(zeta);
  CHECK(R == Approx(std::exp(-std::numbers::pi * zeta / std::sqrt(1.0 - zeta * zeta))).epsilon(1e-15));
  double magnitude = X_0;
  for (int n = 0; n <= 4; ++n) {
    CHECK(decrement_amplitude(zeta, x_f, X_0, n) == Approx(magnitude).epsilon(1e-14));
    magnitude = R * (magnitude - x_f) - x_f;
  }
}

TEST_CASE("The closed form is exact in its limits") {
  // Coulomb friction alone: 2 x_f a half swing, 4 F/k a period. No friction: a geometric sequence.
  for (int n = 0; n < 12; ++n) {
    CHECK(decrement_amplitude(0.0, 0.25, 8.0, n) == 8.0 - 0.5 * n);
    CHECK(decrement_amplitude(0.1, 0.0, 8.0, n) == Approx(8.0 * std::pow(half_swing_decay(0.1), n)).epsilon(1e-14));
  }
  // Small zeta approaches the Coulomb limit linearly: X_n - X_n(0) = -pi zeta (n X_0 - ...), below n pi zeta X_0.
  const double zeta = 1e-13;
  CHECK(std::abs(decrement_amplitude(zeta, 0.25, 8.0, 10) - 3.0) < 10 * std::numbers::pi * zeta * 8.0 + 1e-14);
}

TEST_CASE("The extremes alternate and end where the spring does not overcome the friction") {
  // X_n = 1 - 0.4 n: 1, 0.6, 0.2; the spring at 0.2 equals the friction 0.2 and the mass stays.
  const auto stopped = free_decay_extremes(0.0, 0.2, 1.0, 10);
  REQUIRE(stopped.size() == 3);
  CHECK(stopped[1] == Approx(-0.6).epsilon(1e-15));
  CHECK(stopped[2] == Approx(0.2).epsilon(1e-14));
  // X = 1, 0.5, 0, then at rest in the middle; with x_f = 0.3: 1, -0.4, and the next extreme is -0.2, on the same
  // side.
  const auto same_side = free_decay_extremes(0.0, 0.3, -1.0, 10);
  REQUIRE(same_side.size() == 3);
  CHECK(same_side[1] == Approx(0.4).epsilon(1e-15));
  CHECK(same_side[2] == Approx(0.2).epsilon(1e-14));
  CHECK(free_decay_extremes(0.05, 0.0, 1.0, 5).size() == 5);
  CHECK(free_decay_extremes(0.05, 2.0, 1.0, 5).size() == 1);
}
