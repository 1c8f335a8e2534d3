#include "identify/fundamental_laws.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "identify/harmonic_balance.hpp"

namespace dualdamp::identify {

using std::numbers::pi;
using Terms = FundamentalLaw::Terms;

double dawson(double x) {
  // A trapezoidal sum whose error falls like exp(-(pi/(2 h))^2), 7e-18 for this step; terms beyond the reach are as
  // small.
  constexpr double h = 0.25;
  constexpr double reach = 6.1;
  const auto first = std::max(0, static_cast<int>((std::abs(x) - reach) / (2.0 * h)));
  const auto last = static_cast<int>((std::abs(x) + reach) / (2.0 * h));
  double sum = 0.0;
  for (int i = first; i <= last; ++i) {
    const int n = 2 * i + 1;
    const double near = std::exp(-(x - n * h) * (x - n * h));
    sum -= near * std::expm1(-4.0 * x * n * h) / n;  // the terms n and -n
  }
  return sum / std::sqrt(pi);
}

double saturating_fundamental(double a) {
  // (4/pi) int a sin^2/(1 + a sin) = (4/pi) (1 - pi/(2 a) + A/a), A = int 1/(1 + a sin).
  if (a < 0.1) {
    // (4/pi) sum_k (-1)^k a^(k+1) W_(k+2) with Wallis' integrals W_n = int sin^n; 16 terms leave a^17.
    double even = 0.25 * pi;
    double odd = 2.0 / 3.0;
    double power = a;
    double sum = 0.0;
    for (int k = 0; k < 16; k += 2) {
      sum += power * (even - a * odd);
      power *= a * a;
      even *= (k + 3.0) / (k + 4.0);
      odd *= (k + 4.0) / (k + 5.0);
    }
    return 4.0 / pi * sum;
  }
  const double d = (1.0 - a) * (1.0 + a);
  double A = 1.0;  // at a = 1
  if (std::abs(d) > 1e-6)
    A = d > 0.0 ? std::acos(a) / std::sqrt(d) : std::acosh(a) / std::sqrt(-d);
  else
    A = 1.0 + (1.0 - a) * 2.0 / 3.0;
  return 4.0 / pi * (1.0 - 0.5 * pi / a + A / a);
}

const std::vector<FundamentalLaw>& fundamental_laws() {
  static constexpr LawCoefficient F0{"F0", "N"};
  static constexpr LawCoefficient c{"c", "N.s/m", 1};
  static constexpr double share = 4.0 / pi;
  static const std::vector<FundamentalLaw> laws = {
      {.name = "coulomb_viscous",
       .coefficients = {F0, c},
       .fundamentals = [](double V, double, double) { return Terms{share, V}; },
       .forces = [](double v, double) { return Terms{1.0, v}; }},
      {.name = "quadratic_drag",
       .coefficients = {F0, c, {"drag", "N.s^2/m^2", 2, 0, true}},
       .fundamentals = [](double V, double, double) { return Terms{share, V, 8.0 / (3.0 * pi) * V * V}; },
       .forces = [](double v, double) { return Terms{1.0, v, v * v}; },
       .one_more = true},
      {.name = "power",
       .coefficients = {F0, {"force_at_1_m/s", "N"}},
       .shape = LawShape{"exponent", "", 0.1, 4.0, false, true},
       .fundamentals = [](double V, double,
                          double n) { return Terms{share, fundamental_factor(n) * std::pow(V, n)}; },
       .forces = [](double v, double n) { return Terms{1.0, std::pow(v, n)}; },
       .one_more = true},
      {.name = "saturating_viscous",
       .coefficients = {F0, c},
       .shape = LawShape{"v0", "m/s", 0.02, 100.0, true, false},
       .fundamentals = [](double V, double,
                          double v0) { return Terms{share, v0 * saturating_fundamental(V / v0)}; },
       .forces = [](double v, double v0) { return Terms{1.0, v / (1.0 + v / v0)}; },
       .one_more = true},
      {.name = "stribeck",
       .coefficients = {F0, c, {"static_less_kinetic", "N"}},
       .shape = LawShape{"stribeck_velocity", "m/s", 0.02, 5.0, true, false},
       .fundamentals = [](double V, double, double vs) { return Terms{share, V, share * dawson(V / vs) * vs / V}; },
       .forces = [](double v, double vs) { return Terms{1.0, v, std::exp(-(v / vs) * (v / vs))}; }},
      {.name = "position_quadratic",
       .coefficients = {F0, c, {"curvature", "N/m^2", 0, 2, true}},
       .fundamentals = [](double V, double X, double) { return Terms{share, V, share * X * X / 3.0}; },
       .alias_at_one_frequency = true,
       .one_more = true},
      {.name = "position_linear",
       .coefficients = {F0, c, {"slope", "N/m", 0, 1, true}},
       .fundamentals = [](double V, double X, double) { return Terms{share, V, share * 0.5 * X}; },
       .alias_at_one_frequency = true,
       .one_more = true},
  };
  return laws;
}

}  // namespace dualdamp::identify
