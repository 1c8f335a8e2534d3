#include "sim/analytic/den_hartog.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/numbers.hpp"

using namespace dualdamp::sim::analytic;
using dualdamp::test::epsilon;
using dualdamp::test::pi;

namespace {

struct PhasePoint {
  double x = 0.0;
  double v = 0.0;
};

/// x'' + 2 zeta x' + x - x_f = Y cos(r t + phi), time in units of 1/wn: the half period with the friction of x' <
/// 0, for either sign of the computed x'. Runge-Kutta of order four with step pi/(r steps), an independent
/// computation of the same motion.
std::vector<PhasePoint> integrate_half_cycle(double zeta, double r, double Y, double x_f, double phi, PhasePoint s,
                                             int steps) {
  const auto acceleration = [=](double t, const PhasePoint& u) {
    return x_f + Y * std::cos(r * t + phi) - u.x - 2.0 * zeta * u.v;
  };
  const double h = pi / r / steps;
  std::vector<PhasePoint> states{s};
  for (int i = 0; i < steps; ++i) {
    const double t = i * h;
    const PhasePoint k1{s.v, acceleration(t, s)};
    const PhasePoint a{s.x + 0.5 * h * k1.x, s.v + 0.5 * h * k1.v};
    const PhasePoint k2{a.v, acceleration(t + 0.5 * h, a)};
    const PhasePoint b{s.x + 0.5 * h * k2.x, s.v + 0.5 * h * k2.v};
    const PhasePoint k3{b.v, acceleration(t + 0.5 * h, b)};
    const PhasePoint c{s.x + h * k3.x, s.v + h * k3.v};
    const PhasePoint k4{c.v, acceleration(t + h, c)};
    s.x += h / 6.0 * (k1.x + 2.0 * (k2.x + k3.x) + k4.x);
    s.v += h / 6.0 * (k1.v + 2.0 * (k2.v + k3.v) + k4.v);
    states.push_back(s);
  }
  return states;
}

/// Amplitude and lag behind cos(theta) of the fundamental of a half-wave antisymmetric motion sampled over its half
/// period: the trapezoidal rule on half a period of an even function is the full periodic rule, whose error here is
/// that of the jump in x''' at the turning points, of order steps^-4.
std::array<double, 2> fundamental(const std::vector<PhasePoint>& half_cycle) {
  double cosine = 0.0;
  double sine = 0.0;
  const auto steps = static_cast<double>(half_cycle.size() - 1);
  for (std::size_t i = 0; i + 1 < half_cycle.size(); ++i) {
    const double theta = pi * static_cast<double>(i) / steps;
    cosine += 2.0 / steps * half_cycle[i].x * std::cos(theta);
    sine += 2.0 / steps * half_cycle[i].x * std::sin(theta);
  }
  return {std::hypot(cosine, sine), std::atan2(sine, cosine)};
}

struct Reference {
  double zeta, r, G, H, q, dG_dzeta;
};

/// 50-digit evaluation of Eqs (4)-(6) with the complex square root; the derivative by a central difference in 50
/// digits.
constexpr Reference references[] = {
    {0.2, 1.0, 3.19214345367557351, 0.314285851737171917, 0.400000000000000022, -15.8720543415448671},
    {0.0987, 1.0, 6.45457951442355984, 0.31731488421250812, 0.197399999999999992, -65.3045741723800382},
    {0.0987, 1.01, 6.32631080052033794, 0.947992484719060273, 0.200384634830118645, -62.7191299709083358},
    {0.02, 0.98, 16.0764176990274688, -15.9070788873827887, 0.0557207322277803773, 8.20934871274434752},
    {1e-09, 1.0, 636619772.367581303, 0.318309886183790671, 2.00000000000000012e-9, -636619772367581249.0},
    {1e-09, 1.000000002, 127323960.184134634, 254647913.229996201, 4.47213585918162859e-9, 76394373724374153.5},
    {0.2, 0.34, 1.30171547462163281, 0.469574467272008752, 0.894795708527929841, -3.79561165725528764},
    {0.05, 0.27, 0.372690437348483454, -1.70871902604809389, 0.927493078141287253, 6.8202299810358467},
    {0.5, 10.0, 0.00130467772921950327, 0.0157066754528437525, 99.5037687728459861, 0.00255732843880321383},
    {0.999999999, 0.7, 0.879076205735141426, 0.140981932757161093, 1.48999999868456373, -0.618879128708111033},
    {1.0, 1.0, 0.667660252521049523, 0.249492083146224824, 2.0, -0.625243536564578774},
    {1.000000001, 0.7, 0.879076204497383136, 0.140981933288075441, 1.49000000131543629, -0.618879127315199508},
    {1.01, 0.5, 0.969830077747135684, 0.0498912836604732103, 1.25801430834470242, -0.308211619899760585},
    {1.5, 0.8, 0.572828637191153768, 0.203923445137730434, 2.42684980993880225, -0.338160913970125057},
    {3.0, 0.1, 0.990643139782812114, 0.0160538341081091375, 1.15762688289448429, -0.0175496866045006285},
    {20.0, 2.0, 0.0190308403414992103, 0.0122697879120626871, 80.0562302385017377, -0.000922325708012812816},
    {0.95, 0.1, 1.00000000000045209, -2.62700704308077254e-12, 1.00806745806022327, -6.25605128476448173e-11},
    {0.2, 0.02, 1.0000000000000451, 7.43011382686681218e-14, 0.999632012292523573, -7.42988948766598423e-12},
};

}  // namespace

TEST_CASE("G, H, q and dG/dzeta agree with a 50-digit evaluation") {
  // G is a quotient of sums of positive terms (below zeta = 1): a few dozen roundings. H is as accurate as the
  // distance of b from the next multiple of pi, which the smallest case here (zeta = 0.95, r = 0.1) takes from
  // terms 60 times larger. The derivative is a difference of terms of size G pi/r.
  for (const Reference& expected : references) {
    CAPTURE(expected.zeta, expected.r);
    const DenHartog d = den_hartog(expected.zeta, expected.r);
    CHECK_FALSE(d.singular);
    CHECK(std::abs(d.G / expected.G - 1.0) < 40 * epsilon);
    CHECK(std::abs(d.H / expected.H - 1.0) < 400 * epsilon);
    CHECK(std::abs(d.q / expected.q - 1.0) < 4 * epsilon);
    CHECK(std::abs(d.dG_dzeta - expected.dG_dzeta) <
          100 * epsilon * (std::abs(expected.dG_dzeta) + d.G * pi / d.r));
  }
}

TEST_CASE("The two forms of G and H for zeta above 1 meet where they are exchanged") {
  for (double r : {0.05, 0.3, 1.0, 3.0}) {
    CAPTURE(r);
    const DenHartog below = den_hartog(1.02, r);
    const DenHartog above = den_hartog(std::nextafter(1.02, 2.0), r);
    // One step of zeta moves G and H by less than the rounding of either form, near 1e-15/sqrt(1.02^2 - 1).
    CHECK(std::abs(above.G - below.G) < 2e-14 * below.G);
    CHECK(std::abs(above.H - below.H) < 2e-13 * std::max(below.H, epsilon * below.G));
    CHECK(std::abs(above.dG_dzeta - below.dG_dzeta) < 1e-12);
  }
}

TEST_CASE("The damped resonance frequency makes H vanish and G a hyperbolic cotangent") {
  // w = wd: b = pi, so sin b = 0 and G = sinh a/(cosh a - 1) = coth(a/2) with a = pi zeta/s.
  for (double zeta : {0.01, 0.0987, 0.3, 0.7}) {
    const double s = std::sqrt(1.0 - zeta * zeta);
    const DenHartog d = den_hartog(zeta, s);
    // The rounding of s moves b by one part in 2^53, and G and H by that times their slopes, of order 1/zeta^2.
    CHECK(std::abs(d.H) < 10 * epsilon / (zeta * zeta));
    CHECK(std::abs(d.G * std::tanh(pi * zeta / (2.0 * s)) - 1.0) < 10 * epsilon / (zeta * zeta));
  }
  CHECK(approximate_G(0.2) == Approx(std::sinh(0.2 * pi) / (std::cosh(0.2 * pi) - 1.0)).epsilon(1e-14));
  const double h = 1e-5;  // central difference: relative error h^2/zeta^2 = 2.5e-9
  CHECK(approximate_G_derivative(0.2) ==
        Approx((approximate_G(0.2 + h) - approximate_G(0.2 - h)) / (2.0 * h)).epsilon(1e-8));
}

TEST_CASE("Undamped resonance with an odd harmonic is singular") {
  CHECK(den_hartog(0.0, 1.0).singular);
  CHECK(den_hartog(0.0, 0.2).singular == (std::fma(-5.0, 0.2, 1.0) == 0.0));
  CHECK_FALSE(den_hartog(0.0, 0.5).singular);
  CHECK_FALSE(den_hartog(1e-300, 1.0).G < 1e299);  // G -> 2/(pi zeta)
  const DenHartog d = den_hartog(0.0, 1.0);
  CHECK_FALSE(amplitude(d, 1.0, 0.1).has_value());
  CHECK_FALSE(non_sticking_state(d, 1.0, 0.1).has_value());
  CHECK(non_sticking_boundary(d) == 0.0);
}

TEST_CASE("Table 1 of the paper") {
  // m = 1, k = 100, c = 4, F0 = 2, w = 10: zeta = 0.2, x_f = 0.02, r = 1. Printed to six decimals.
  const DenHartog d = den_hartog(0.2, 1.0);
  const std::array<std::array<double, 2>, 4> table = {
      {{0.1, 0.186078}, {0.2, 0.436118}, {0.5, 1.186141}, {0.6, 1.436144}}};
  for (const auto& [Y, x] : table) {
    const auto state = non_sticking_state(d, Y, 0.02);
    REQUIRE(state.has_value());
    CHECK(std::abs(state->amplitude - x) < 0.5000001e-6);
  }
  CHECK(std::abs(amplitude(d, 0.1, 0.02).value() - 0.186078097956786198557) < 4 * epsilon);
}

TEST_CASE("The closed form is a motion of the differential equation") {
  // Started at the turning point in the stated phase, half a period must end at the opposite turning point, at
  // rest. Runge-Kutta with 4000 steps over at most three free periods: error (h wn)^4 of order 1e-10 at the most.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int tried = 0;
  while (tried < 60) {
    const double zeta = tried % 5 == 4 ? 1.0 + uniform(random) : 0.5 * uniform(random);
    const double r = 0.35 + 1.5 * uniform(random);
    const double x_f = 0.7 * uniform(random);
    const auto state = non_sticking_state(den_hartog(zeta, r), 1.0, x_f);
    if (!state) continue;
    ++tried;
    CAPTURE(zeta, r, x_f);
    const auto motion =
        integrate_half_cycle(zeta, r, 1.0, x_f, state->turning_phase, {state->amplitude, 0.0}, 4000);
    const double size = std::max(1.0, state->amplitude);
    CHECK(std::abs(motion.back().x + state->amplitude) < 1e-9 * size);
    CHECK(std::abs(motion.back().v) < 1e-9 * size);
    double fastest_return = -1.0;
    for (std::size_t i = 1; i + 1 < motion.size(); ++i) fastest_return = std::max(fastest_return, motion[i].v);
    CHECK(fastest_return < 1e-9 * size);

    const auto [first, lag] = fundamental(motion);
    CHECK(first == Approx(state->fundamental).epsilon(1e-6));
    const double difference = std::remainder(state->turning_phase + lag - state->phase, 2.0 * pi);
    CHECK(std::abs(difference) < 1e-6);
  }
}

TEST_CASE("The boundary of sticking is sharp in the integrated motion") {
  // Eq (3) continued beyond the boundary must show a velocity of the wrong sign within the half period, and none
  // short of it. At a relative distance d beyond it the wrong velocity is of order d where the maximum lies inside,
  // of order d^2 where the turning point decides; d = 1e-3 leaves 1e-6 and less, the integration errs by (h wn)^4 =
  // 1e-14.
  const std::array<std::array<double, 2>, 8> cases = {
      {{0.0, 0.4}, {0.05, 0.37}, {0.001, 0.34}, {0.2, 1.0}, {0.1, 0.8}, {0.0, 1.7}, {0.3, 0.45}, {1.3, 0.6}}};
  for (const auto& [zeta, r] : cases) {
    CAPTURE(zeta, r);
    const DenHartog d = den_hartog(zeta, r);
    const double boundary = non_sticking_boundary(d);
    CHECK(non_sticking_state(d, 1.0, boundary * (1.0 - 1e-4)).has_value());
    CHECK_FALSE(non_sticking_state(d, 1.0, boundary * (1.0 + 1e-4)).has_value());
    const auto wrong_way = [&, zeta = zeta, r = r](double x_f) {
      // The phase of the formula, which is defined on both sides of the boundary.
      const double x_o = amplitude(d, 1.0, x_f).value();
      const double phi = std::atan2(2.0 * zeta * r, 1.0 - r * r) + std::atan2(-d.H * x_f, x_o + d.G * x_f);
      double greatest = -1.0;
      for (const PhasePoint& s : integrate_half_cycle(zeta, r, 1.0, x_f, phi, {x_o, 0.0}, 20000)) {
        greatest = std::max(greatest, s.v);
      }
      return greatest;
    };
    CHECK(wrong_way(boundary * (1.0 - 1e-4)) < 1e-12);
    CHECK(wrong_way(boundary * (1.0 + 1e-3)) > 1e-12);
  }
}

TEST_CASE("The boundary of sticking is exact at three undamped points") {
  CHECK(non_sticking_boundary(den_hartog(0.0, 0.5)) == Approx(1.0 / 3.0).epsilon(1e-14));
  CHECK(non_sticking_boundary(den_hartog(0.0, 0.25)) == Approx(1.0 / 15.0).epsilon(1e-14));
  CHECK(non_sticking_boundary(den_hartog(0.0, 3.0)) == Approx(9.0 / 16.0).epsilon(1e-14));
}

TEST_CASE("The turning point decides near resonance and not at low frequency") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    const DenHartog d = den_hartog(0.01 + 0.29 * uniform(random), 0.55 + uniform(random));
    CAPTURE(d.zeta, d.r);
    CHECK(non_sticking_limit(d) == Approx(turning_point_limit(d)).epsilon(1e-12 * (1.0 + d.G)));
  }
  // At r = 0.34 the mass first stops inside the half period: the turning point alone misses it by a factor.
  const DenHartog low = den_hartog(0.001, 0.34);
  CHECK(non_sticking_limit(low) > 5.0 * turning_point_limit(low));
  // Just below r = 1/2 the maximum lies close to the turning point, at wt = 0.017, and is higher by 1e-4 only.
  const DenHartog hidden = den_hartog(0.0011624925211738257, 0.4962164762079036);
  CHECK(non_sticking_limit(hidden) - turning_point_limit(hidden) > 4.5e-4);
  // Values quoted in the paper's range: x_o/x_f > 1.063 at zeta = 0.0987 and 1.090 at zeta = 0.142.
  CHECK(non_sticking_limit(den_hartog(0.0987, 1.0)) == Approx(1.063).margin(5e-4));
  CHECK(non_sticking_limit(den_hartog(0.142, 1.0)) == Approx(1.090).margin(5e-4));
}

TEST_CASE("Slopes of the parameter functions are their differences") {
  // Central differences with h = 1e-5 err by h^2/6 times a third derivative, which scales with the inverse cube of
  // the distance from the resonance, (zeta^2 + (r - 1)^2)^(1/2) >= 0.03 here, relative to a slope with the inverse
  // of it: 1e-10/6/1e-3 = 2e-8; the rounding of the functions adds 1e-16/h.
  constexpr double h = 1e-5;
  for (const double zeta : {0.03, 0.12, 0.5, 0.9})
    for (const double r : {0.4, 0.95, 1.0, 1.07, 2.5}) {
      CAPTURE(zeta, r);
      const DenHartog here = den_hartog(zeta, r);
      const DenHartogSlopes s = slopes(here);
      const DenHartog more = den_hartog(zeta + h, r);
      const DenHartog less = den_hartog(zeta - h, r);
      const DenHartog above = den_hartog(zeta, r + h);
      const DenHartog below = den_hartog(zeta, r - h);
      const auto near = [](double slope, double high, double low, double size) {
        CHECK(slope == Approx((high - low) / (2.0 * h)).epsilon(1e-6).margin(1e-8 * (1.0 + std::abs(size))));
      };
      near(s.G_zeta, more.G, less.G, here.G);
      near(s.H_zeta, more.H, less.H, here.H);
      near(s.q_zeta, more.q, less.q, here.q);
      near(s.G_r, above.G, below.G, here.G);
      near(s.H_r, above.H, below.H, here.H);
      near(s.q_r, above.q, below.q, here.q);
      CHECK(s.G_zeta == Approx(here.dG_dzeta).epsilon(1e-11).margin(1e-12));
    }
}
