#include "identify/methods/amplitudes/harmonic_balance.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sim/analytic/den_hartog.hpp"
#include "tests/identify/methods/histories/bearing.hpp"
#include "tests/identify/records.hpp"

using namespace dualdamp::identify;
using namespace dualdamp::identify::testing;
namespace analytic = dualdamp::sim::analytic;
using std::numbers::pi;

namespace {

/// (4/pi) int_0^(pi/2) f(V sin theta) sin theta d theta, adaptively.
double fundamental_of(const std::function<double(double)>& f, double V) {
  const auto integrand = [&](double theta) { return f(V * std::sin(theta)) * std::sin(theta); };
  return 4.0 / pi *
         boost::math::quadrature::gauss_kronrod<double, 31>::integrate(integrand, 0.0, 0.5 * pi, 12, 1e-13);
}

/// Pairs at resonance that balance in the first harmonic: k Y = Phi(w X).
Record balanced(const std::function<double(double)>& f, const std::vector<double>& outputs, double sigma = 0.0,
                std::uint64_t seed = 1) {
  Normal normal(seed);
  std::vector<std::pair<double, double>> list;
  for (const double X : outputs)
    list.emplace_back(fundamental_of(f, natural * X) / stiffness + sigma * normal(), X);
  return pairs(list);
}

const std::vector<double> outputs = {5e-3, 7e-3, 9e-3, 11e-3, 13e-3, 15e-3, 17e-3, 19e-3};

const EstimateCurve& curve_named(const Estimate& estimate, const std::string& name) {
  const auto found = std::ranges::find(estimate.curves, name, &EstimateCurve::name);
  REQUIRE(found != estimate.curves.end());
  return *found;
}

}  // namespace

TEST_CASE("The fundamental of a power is its factor times the power") {
  CHECK(fundamental_factor(0.0) == Approx(4.0 / pi).epsilon(1e-14));
  CHECK(fundamental_factor(1.0) == Approx(1.0).epsilon(1e-14));
  CHECK(fundamental_factor(2.0) == Approx(8.0 / (3.0 * pi)).epsilon(1e-14));
  CHECK(fundamental_factor(3.0) == Approx(0.75).epsilon(1e-14));
  CHECK(fundamental_factor(0.36) ==
        Approx(fundamental_of([](double v) { return std::pow(v, 0.36); }, 1.0)).epsilon(1e-6));
}

TEST_CASE("Abel's inversion recovers the law from its fundamental") {
  // A Stribeck law with a saturating viscous term; its fundamental by adaptive quadrature. The inversion's own
  // quadrature has 30 points: 1e-7 on scales of velocity a tenth of u and more.
  const auto law = [](double v) { return 2.0 + 1.0 * std::exp(-v * v / 0.04) + 12.0 * v / (1.0 + v / 0.5); };
  const auto Phi = [&](double V) { return fundamental_of(law, V); };
  const auto slope = [&](double V) { return (Phi(V * 1.0001) - Phi(V * 0.9999)) / (2e-4 * V); };
  for (const double u : {0.05, 0.2, 0.5, 0.8})
    CHECK(friction_from_fundamental(Phi, slope, u) == Approx(law(u)).epsilon(1e-6));
  // Powers in closed form.
  for (const double n : {0.0, 1.0, 2.0, 3.0})
    CHECK(friction_from_fundamental(
              [n](double V) { return fundamental_factor(n) * std::pow(V, n); },
              [n](double V) { return n == 0.0 ? 0.0 : n * fundamental_factor(n) * std::pow(V, n - 1.0); },
              0.7) == Approx(std::pow(0.7, n)).epsilon(1e-12));
}

TEST_CASE("States that balance in the first harmonic give the truth, at resonance or not, with phases or without") {
  const double c = 9.7, F0 = 3.7;
  for (const double r : {0.95, 1.0, 1.04})
    for (const bool phases : {false, true}) {
      PairRecord record;
      for (const double X : outputs) {
        const double w = r * natural;
        const double along = (stiffness - mass * w * w) * X;
        const double across = 4.0 / pi * F0 + c * w * X;
        record.pairs.push_back({.Y = std::hypot(along, across) / stiffness,
                                .x = X,
                                .sweep = {},
                                .number = static_cast<int>(record.pairs.size()) + 1,
                                .omega = w,
                                .phase = phases ? std::atan2(across, along) : unknown});
      }
      const Estimate e = harmonic_balance({record, std::nullopt}, {mass, stiffness, unknown});
      REQUIRE(e.outcome.ok());
      CHECK(e.value.c == Approx(c).epsilon(1e-11));
      CHECK(e.value.F0 == Approx(F0).epsilon(1e-11));
      CHECK(e.excluded.empty());
    }
}

TEST_CASE("Exact pairs are read with the bias of harmonic balance, and do not bend") {
  const double zeta = 0.12, x_f = 2.36e-3;
  std::vector<std::pair<double, double>> list;
  for (int i = 0; i < 8; ++i) {
    const double Y = 4.4e-3 + 0.4e-3 * i;
    list.emplace_back(Y, analytic::amplitude(analytic::den_hartog(zeta, 1.0), Y, x_f).value());
  }
  const Estimate e = harmonic_balance(pairs(list), at_resonance);
  REQUIRE(e.outcome.ok());
  CHECK(e.usable);
  CHECK(e.value.zeta == Approx(zeta).epsilon(0.02));
  CHECK(e.value.x_f == Approx(x_f).epsilon(0.02));
  CHECK_FALSE(e.lack_of_fit->fired);
  CHECK(e.others.empty());
}

TEST_CASE("A law that bends is rejected, and its curve is the result") {
  const auto law = [](double v) { return 3.16 + 18.7 * v / (1.0 + v / 0.69); };
  const Estimate e = harmonic_balance(balanced(law, outputs), at_resonance);
  REQUIRE(e.outcome.ok());
  CHECK_FALSE(e.usable);
  CHECK(e.lack_of_fit->fired);
  CHECK(mentions(e.warnings[0], "it does not show which of them bends it"));
  REQUIRE(e.others.size() >= 3);
  CHECK(e.others[0].name == "C_0");
  CHECK(e.others[2].unit == "N.s^2/m^2");
  CHECK(e.others[2].value < 0.0);
  // A cubic through a law with one knee: 2 % of it; Abel's inversion of eight points with a cubic between them
  // likewise.
  const EstimateCurve& curve = curve_named(e, "friction_velocity");
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    CHECK(curve.columns[1].values[i] == Approx(law(curve.columns[0].values[i])).epsilon(0.02));
    CHECK(curve.columns[2].values[i] == Approx(law(curve.columns[0].values[i])).epsilon(0.04));
  }
}

TEST_CASE("The five reconstructed pairs are rejected at the 1 % level") {
  const Estimate e = harmonic_balance(pairs(subset_trend), soft_spring);
  REQUIRE(e.outcome.ok());
  CHECK_FALSE(e.usable);
  // Quadratic in x of Y against the line: F = 289 with 1 and 2 degrees of freedom, p = 0.0034 (numpy); harmonic
  // balance adds the exact law's own curvature.
  CHECK(e.lack_of_fit->statistic == Approx(289.0).epsilon(0.1));
  CHECK(e.lack_of_fit->p_value < 0.01);
}

TEST_CASE(
    "Intervals of harmonic balance hold in a Monte Carlo experiment, and its test fires as often as it says") {
  // Errors of the input of 0.05 mm, alike in Phi as the method assumes. 3000 samples know a coverage to 0.4 %.
  const auto law = [](double v) { return 3.7 + 9.7 * v; };
  const Record exact = balanced(law, outputs);
  Normal normal(71);
  int covered_c = 0, covered_F0 = 0, fired = 0;
  constexpr int samples = 3000;
  for (int i = 0; i < samples; ++i) {
    Record noisy = exact;
    for (Pair& pair : noisy.pairs->pairs) pair.Y += 0.05e-3 * normal();
    const Estimate e = harmonic_balance(noisy, at_resonance);
    covered_c += e.interval95->c[0] < 9.7 && 9.7 < e.interval95->c[1];
    covered_F0 += e.interval95->F0[0] < 3.7 && 3.7 < e.interval95->F0[1];
    fired += e.lack_of_fit->p_value < 0.05;
  }
  CHECK(covered_c / double(samples) == Approx(0.95).margin(0.015));
  CHECK(covered_F0 / double(samples) == Approx(0.95).margin(0.015));
  CHECK(fired / double(samples) == Approx(0.05).margin(0.015));
}

TEST_CASE("Records that allow no harmonic balance are refused with the reason") {
  CHECK(harmonic_balance(Record{}, at_resonance).reason == "the record holds no x-Y pairs");
  CHECK(mentions(harmonic_balance(pairs({{0.1, 0.2}}), table_1_constants).reason, "and 1 is left"));
  CHECK(mentions(harmonic_balance(pairs(table_1), {unknown, 100.0, 10.0}).reason, "needs the mass"));
  CHECK(mentions(harmonic_balance(pairs({{0.1, 0.2}, {0.2, 0.5}}), {1.0, 100.0, 30.0}).reason,
                 "spring and inertia take more"));
}
