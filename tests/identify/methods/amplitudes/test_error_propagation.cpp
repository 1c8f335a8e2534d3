#include "identify/methods/amplitudes/error_propagation.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/analytic/den_hartog.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;
using std::numbers::pi;

namespace {

struct Estimates {
  double zeta, x_f;
};

/// Eqs (14) and (13), written out afresh.
Estimates two_point(double x1, double x2, double Y1, double Y2, const ResonanceG& G) {
  const double zeta = (Y2 - Y1) / (2.0 * (x2 - x1));
  return {zeta, (x1 * Y2 - x2 * Y1) / (G.value(zeta) * (Y1 - Y2))};
}

/// Central difference with one step of Richardson extrapolation: relative error of order (h/x)^4.
template <typename Function>
Estimates derivative(Function estimate, double x) {
  const double h = 1e-3 * std::abs(x);
  const auto difference = [&](double step) {
    const Estimates up = estimate(x + step);
    const Estimates down = estimate(x - step);
    return Estimates{(up.zeta - down.zeta) / (2.0 * step), (up.x_f - down.x_f) / (2.0 * step)};
  };
  const Estimates coarse = difference(h);
  const Estimates fine = difference(0.5 * h);
  return {(4.0 * fine.zeta - coarse.zeta) / 3.0, (4.0 * fine.x_f - coarse.x_f) / 3.0};
}

}  // namespace

TEST_CASE("Eqs (16) and (17) are the derivatives of Eqs (14) and (13)") {
  for (const bool approximate : {false, true}) {
    for (const double r : {1.0, 0.97}) {
      const ResonanceG G{r, approximate};
      const double x1 = 0.186078, x2 = 1.436144, Y1 = 0.1, Y2 = 0.6;
      const TwoPointSensitivity s = two_point_sensitivity({Y1, x1}, {Y2, x2}, G);
      const Estimates e = two_point(x1, x2, Y1, Y2, G);
      CHECK(s.zeta == Approx(e.zeta).epsilon(1e-15));
      CHECK(s.x_f == Approx(e.x_f).epsilon(1e-14));
      const auto by_x1 = derivative([&](double v) { return two_point(v, x2, Y1, Y2, G); }, x1);
      const auto by_x2 = derivative([&](double v) { return two_point(x1, v, Y1, Y2, G); }, x2);
      const auto by_Y1 = derivative([&](double v) { return two_point(x1, x2, v, Y2, G); }, Y1);
      const auto by_Y2 = derivative([&](double v) { return two_point(x1, x2, Y1, v, G); }, Y2);
      CHECK(s.of_zeta.x1 == Approx(by_x1.zeta).epsilon(1e-9));
      CHECK(s.of_zeta.x2 == Approx(by_x2.zeta).epsilon(1e-9));
      CHECK(s.of_zeta.Y1 == Approx(by_Y1.zeta).epsilon(1e-9));
      CHECK(s.of_zeta.Y2 == Approx(by_Y2.zeta).epsilon(1e-9));
      CHECK(s.of_x_f.x1 == Approx(by_x1.x_f).epsilon(1e-9));
      CHECK(s.of_x_f.x2 == Approx(by_x2.x_f).epsilon(1e-9));
      CHECK(s.of_x_f.Y1 == Approx(by_Y1.x_f).epsilon(1e-9));
      CHECK(s.of_x_f.Y2 == Approx(by_Y2.x_f).epsilon(1e-9));
    }
  }
}

TEST_CASE("The paper's 22.64 % example") {
  // Pairs 1 and 4 of Table 1, Y1 read as 0.105: with G re-evaluated at the zeta that follows, against the true 2 N.
  const ResonanceG exact{1.0, false};
  const ResonanceG approximate{1.0, true};
  const double x1 = 0.186078, x2 = 1.436144;
  const Estimates e = two_point(x1, x2, 0.105, 0.6, exact);
  CHECK(e.zeta == Approx(0.19799).margin(5e-6));
  CHECK(100.0 * std::abs(100.0 * e.x_f / 2.0 - 1.0) == Approx(22.640).margin(5e-4));
  CHECK(100.0 * std::abs(100.0 * two_point(x1, x2, 0.105, 0.6, approximate).x_f / 2.0 - 1.0) ==
        Approx(19.16).margin(5e-3));
  // Eqs (16)-(17) alone, without the 0.14 % that the method errs by itself.
  const TwoPointSensitivity s = two_point_sensitivity({0.1, x1}, {0.6, x2}, exact);
  CHECK(100.0 * 100.0 * s.of_x_f.Y1 * 0.005 / 2.0 == Approx(22.50).margin(5e-3));
}

TEST_CASE("An input error counts whatever zeta, an output error with the factor 2 zeta") {
  // Pairs of the straight line at fixed inputs and x_f. Small-zeta forms, with D = x2 - x1, E = Y2 - Y1:
  //   dx_f/dY1 = (pi/4) x2/D, dx_f/dY2 = -(pi/4) x1/D, dx_f/dx1 = -(pi/4) x2 E/D^2, dx_f/dx2 = (pi/4) x1 E/D^2,
  // short by terms of relative order zeta^2 through 2 zeta G = 4/pi (1 + O(zeta^2)).
  const double Y1 = 0.1, Y2 = 0.6, x_f = 0.02;
  for (const double zeta : {0.1, 0.05, 0.02, 0.005}) {
    const ResonanceG G{1.0, false};
    const double x1 = Y1 / (2.0 * zeta) - G.value(zeta) * x_f;
    const double x2 = Y2 / (2.0 * zeta) - G.value(zeta) * x_f;
    const TwoPointSensitivity s = two_point_sensitivity({Y1, x1}, {Y2, x2}, G);
    const double D = x2 - x1, E = Y2 - Y1;
    CAPTURE(zeta);
    CHECK(s.of_x_f.Y1 == Approx(pi / 4.0 * x2 / D).epsilon(10.0 * zeta * zeta));
    CHECK(s.of_x_f.Y2 == Approx(-pi / 4.0 * x1 / D).epsilon(10.0 * zeta * zeta));
    CHECK(s.of_x_f.x1 == Approx(-pi / 4.0 * x2 * E / (D * D)).epsilon(10.0 * zeta * zeta));
    CHECK(s.of_x_f.x2 == Approx(pi / 4.0 * x1 * E / (D * D)).epsilon(10.0 * zeta * zeta));
  }
  // The partial coefficients tell another story: A falls with zeta, C stays, E grows as x_f/zeta.
  const auto at = [&](double zeta) {
    const ResonanceG G{1.0, false};
    const double shift = G.value(zeta) * x_f;
    return two_point_sensitivity({Y1, Y1 / (2.0 * zeta) - shift}, {Y2, Y2 / (2.0 * zeta) - shift}, G);
  };
  CHECK(at(0.2).A == Approx(-0.376).margin(5e-4));
  CHECK(at(0.05).A == Approx(-0.094).margin(5e-4));
  CHECK(at(0.02).A == Approx(-0.038).margin(5e-4));
  CHECK(at(0.2).C == Approx(0.940).margin(5e-4));
  CHECK(at(0.02).C == Approx(0.942).margin(5e-4));
  CHECK(at(0.2).E == Approx(0.099).margin(5e-4));
  CHECK(at(0.02).E == Approx(1.000).margin(5e-4));
}
