#include "identify/methods/amplitudes/fundamental_laws.hpp"

#include <array>
#include <boost/math/special_functions/digamma.hpp>
#include <cmath>
#include <numbers>

#include "identify/departures/departures.hpp"
#include "identify/methods/amplitudes/harmonic_balance.hpp"

namespace dualdamp::identify {

using std::numbers::pi;
using Terms = FundamentalLaw::Terms;

namespace {

/// x - 2/3 x^3 + 4/15 x^5 - ... for |x| < 1/4; ten terms leave x 1e-20.
double dawson_series(double x) {
  double term = x;
  double sum = 0.0;
  for (int k = 0; k < 10; ++k) {
    sum += term;
    term *= -2.0 * x * x / (2.0 * k + 3.0);
  }
  return sum;
}

}  // namespace

double dawson(double x) {
  // A trapezoidal sum over odd multiples of h about the even one next to x (rybicki1989). Its error falls like
  // exp(-(pi/(2 h))^2), 7e-18 for this step; the terms that are left out are as small.
  constexpr double h = 0.25;
  constexpr int terms = 13;
  static const std::array<double, terms> weights = [] {
    std::array<double, terms> list{};
    for (std::size_t i = 0; i < terms; ++i)
      list[i] = std::exp(-std::pow((2.0 * static_cast<double>(i) + 1.0) * h, 2));
    return list;
  }();
  constexpr double far = 1e8;  // from there on 1/(2 x) to the last digit
  if (std::abs(x) > far) return 0.5 / x;
  if (std::abs(x) < h) return dawson_series(x);
  const double middle = 2.0 * std::round(x / (2.0 * h));
  const double rest = x - middle * h;
  double above = std::exp(2.0 * rest * h);
  double below = 1.0 / above;
  const double further_above = above * above;
  const double further_below = below * below;
  double sum = 0.0;
  double n = 1.0;
  for (const double weight : weights) {
    sum += weight * (above / (middle + n) + below / (middle - n));
    above *= further_above;
    below *= further_below;
    n += 2.0;
  }
  return std::exp(-rest * rest) * sum / std::sqrt(pi);
}

namespace {

/// (4/pi) sum_k (-1)^k a^(k+1) W_(k+2) with Wallis' integrals W_n = int sin^n; 16 terms leave a^17.
ValueAndSlope saturating_series(double a) {
  double even = 0.25 * pi;
  double odd = 2.0 / 3.0;
  double power = 1.0;
  ValueAndSlope sum;
  for (int k = 0; k < 16; k += 2) {
    sum.value += power * a * (even - a * odd);
    sum.slope += power * ((k + 1.0) * even - (k + 2.0) * a * odd);
    power *= a * a;
    even *= (k + 3.0) / (k + 4.0);
    odd *= (k + 4.0) / (k + 5.0);
  }
  return {4.0 / pi * sum.value, 4.0 / pi * sum.slope};
}

}  // namespace

ValueAndSlope saturating_fundamental(double a) {
  if (a < 0.1) return saturating_series(a);
  // (4/pi) int a sin^2/(1 + a sin) = (4/pi) (1 - pi/(2 a) + A/a), A = int 1/(1 + a sin), (1 - a^2) A' = a A - 1.
  const double d = (1.0 - a) * (1.0 + a);
  ValueAndSlope A{1.0 + (1.0 - a) / 3.0, -1.0 / 3.0};  // at a = 1
  if (std::abs(d) > 1e-6) {
    A.value = d > 0.0 ? std::acos(a) / std::sqrt(d) : std::acosh(a) / std::sqrt(-d);
    A.slope = (a * A.value - 1.0) / d;
  }
  return {4.0 / pi * (1.0 + (A.value - 0.5 * pi) / a), 4.0 / pi * (A.slope - (A.value - 0.5 * pi) / a) / a};
}

namespace {

using Fundamentals = FundamentalLaw::Fundamentals;
/// Avoids the long double with which Boost rounds the last digit.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

Fundamentals of_power(double V, double /*X*/, double n) {
  const double phi = fundamental_factor(n) * std::pow(V, n);
  const double factor_slope =
      0.5 * (boost::math::digamma(0.5 * n + 1.0, InDouble()) - boost::math::digamma(0.5 * n + 1.5, InDouble()));
  return {{coulomb_share, phi}, {0.0, n * phi}, {0.0, phi * (std::log(V) + factor_slope)}};
}

Fundamentals of_saturating(double V, double /*X*/, double v0) {
  const double a = V / v0;
  const ValueAndSlope s = saturating_fundamental(a);
  return {{coulomb_share, v0 * s.value}, {0.0, V * s.slope}, {0.0, s.value - a * s.slope}};
}

Fundamentals of_stribeck(double V, double /*X*/, double vs) {
  const double u = V / vs;
  const double D = dawson(u);
  const double slope = coulomb_share * (1.0 - 2.0 * u * D - D / u);  // D' = 1 - 2 u D
  return {{coulomb_share, V, coulomb_share * D / u}, {0.0, V, slope}, {0.0, 0.0, -slope / vs}};
}

/// Coulomb and viscous friction and one term that grows as X^n or V^n; no shape parameter.
Fundamentals with_power(double V, double term, double n) {
  return {{coulomb_share, V, term}, {0.0, V, n * term}, {}};
}

}  // namespace

const std::vector<FundamentalLaw>& fundamental_laws() {
  static constexpr LawCoefficient F0{"F0", "N"};
  static constexpr LawCoefficient c{"c", "N.s/m", 1};
  static const std::vector<FundamentalLaw> laws = {
      {.name = departures::plain_name,
       .coefficients = {F0, c},
       .fundamentals = [](double V, double, double) { return Fundamentals{{coulomb_share, V}, {0.0, V}, {}}; },
       .forces = [](double v, double) { return Terms{1.0, v}; }},
      {.name = "quadratic_drag",
       .coefficients = {F0, c, {"drag", "N.s^2/m^2", 2, 0, true}},
       .fundamentals = [](double V, double, double) { return with_power(V, 8.0 / (3.0 * pi) * V * V, 2.0); },
       .forces = [](double v, double) { return Terms{1.0, v, v * v}; },
       .one_more = true},
      {.name = "viscous_power",
       .coefficients = {F0, {"force_at_1_m/s", "N"}},
       .shape = LawShape{"exponent", "", 0.1, 4.0, false, true},
       .fundamentals = of_power,
       .forces = [](double v, double n) { return Terms{1.0, std::pow(v, n)}; },
       .one_more = true},
      {.name = "viscous_saturating",
       .coefficients = {F0, c},
       .shape = LawShape{"v0", "m/s", 0.02, 100.0, true, false},
       .fundamentals = of_saturating,
       .forces = [](double v, double v0) { return Terms{1.0, v / (1.0 + v / v0)}; },
       .one_more = true},
      {.name = "stribeck",
       .coefficients = {F0, c, {"static_less_kinetic", "N"}},
       .shape = LawShape{"stribeck_velocity", "m/s", 0.02, 5.0, true, false},
       .fundamentals = of_stribeck,
       .forces = [](double v, double vs) { return Terms{1.0, v, std::exp(-(v / vs) * (v / vs))}; }},
      {.name = "position_quadratic",
       .coefficients = {F0, c, {"curvature", "N/m^2", 0, 2, true}},
       .fundamentals = [](double V, double X, double) { return with_power(V, coulomb_share * X * X / 3.0, 2.0); },
       .alias_at_one_frequency = true,
       .one_more = true},
      {.name = "position_linear",
       .coefficients = {F0, c, {"slope", "N/m", 0, 1, true}},
       .fundamentals = [](double V, double X, double) { return with_power(V, coulomb_share * 0.5 * X, 1.0); },
       .alias_at_one_frequency = true,
       .one_more = true},
  };
  return laws;
}

}  // namespace dualdamp::identify
