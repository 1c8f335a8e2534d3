#include "sim/analytic/den_hartog.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cassert>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "core/constants.hpp"

namespace dualdamp::sim::analytic {

namespace {

using std::numbers::pi;

using core::infinity;

/// scale (1 - sin(sqrt z)/sqrt z), an entire function of z; `sine_ratio` is scale sin(sqrt z)/sqrt z, used if
/// nothing cancels.
double one_minus_sine_ratio(double z, double sine_ratio, double scale) {
  if (std::abs(z) > 1.0) return scale - sine_ratio;
  double term = z / 6.0;
  double sum = term;
  for (int k = 2; k <= 9; ++k) {
    term *= -z / ((2 * k) * (2 * k + 1));
    sum += term;
  }
  return scale * sum;
}

/// scale times d/dz of sin(sqrt z)/sqrt z; `cosine` and `sine_ratio` contain the factor scale.
double sine_ratio_slope(double z, double cosine, double sine_ratio, double scale) {
  if (std::abs(z) > 1.0) return (cosine - sine_ratio) / (2.0 * z);
  double power = 1.0 / 6.0;  // z^(k-1)/(2k+1)! up to sign
  double sum = -power;
  for (int k = 2; k <= 10; ++k) {
    power *= -z / ((2 * k) * (2 * k + 1));
    sum -= k * power;
  }
  return scale * sum;
}

double sinh_minus_argument(double a) {
  if (a > 1.0) return std::sinh(a) - a;
  double term = a * a * a / 6.0;
  double sum = term;
  for (int k = 2; k <= 9; ++k) {
    term *= a * a / ((2 * k) * (2 * k + 1));
    sum += term;
  }
  return sum;
}

/// cos b and sin(b)/b with b = pi sqrt(1 - zeta^2)/r, and 1 + cos b without cancellation.
struct Circular {
  double cosine = 0.0;
  double sine_ratio = 0.0;
  double one_plus_cosine = 0.0;
};

/// For zeta < 1. Near resonance with an odd harmonic b is close to an odd multiple of pi, and the result depends on
/// the distance: it is formed from 1 - n r and 1 - s, never from b.
Circular circular(double zeta, double r) {
  const double s = std::sqrt((1.0 - zeta) * (1.0 + zeta));
  const double half_turns = s / r;
  const double n = std::round(half_turns);
  const double distance = n == 0.0 ? half_turns : (std::fma(-n, r, 1.0) - zeta * zeta / (1.0 + s)) / r;
  const bool odd = std::fmod(n, 2.0) != 0.0;
  const double sign = odd ? -1.0 : 1.0;
  const double b = pi * half_turns;
  Circular c;
  c.cosine = sign * std::cos(pi * distance);
  c.sine_ratio = b == 0.0 ? 1.0 : sign * std::sin(pi * distance) / b;
  const double half = odd ? std::sin(0.5 * pi * distance) : std::cos(0.5 * pi * distance);
  c.one_plus_cosine = 2.0 * half * half;
  return c;
}

/// For zeta >= 1, b = i B, times exp(-a).
Circular hyperbolic(double B, double a) {
  Circular c;
  const double growing = 0.5 * std::exp(B - a);
  const double falling = 0.5 * std::exp(-B - a);
  c.cosine = growing + falling;
  c.sine_ratio = B == 0.0 ? std::exp(-a) : falling * std::expm1(2.0 * B) / B;
  c.one_plus_cosine = c.cosine + std::exp(-a);
  return c;
}

/// Eqs (4)-(5) with numerator and denominator written in z = b^2 = (pi/r)^2 (1 - zeta^2), which is free of
/// branches:
///   N = (sinh a - a) + a (1 - sin b/b),   D = (cosh a - 1) + (1 + cos b)
/// Both terms of N are positive for zeta <= 1, so nothing cancels.
void set_by_squares(DenHartog& d) {
  const double beta_pi = pi / d.r;
  const double a = d.zeta * beta_pi;
  const double z = beta_pi * beta_pi * (1.0 - d.zeta) * (1.0 + d.zeta);
  const bool scaled = a > 20.0 || z < 0.0;  // then all terms below contain a factor exp(-a)
  const double e = scaled ? std::exp(-a) : 1.0;
  Circular c;
  if (z >= 0.0) {
    c = circular(d.zeta, d.r);
    c.cosine *= e;
    c.sine_ratio *= e;
    c.one_plus_cosine *= e;
  } else {
    c = hyperbolic(std::sqrt(-z), a);
  }
  const double rest = one_minus_sine_ratio(z, c.sine_ratio, e);
  const double slope = sine_ratio_slope(z, c.cosine, c.sine_ratio, e);
  const double growth = scaled ? -0.5 * std::expm1(-2.0 * a) : std::sinh(a);  // sinh a
  const double sinh_rest = scaled && a > 1.0 ? growth - a * e : e * sinh_minus_argument(a);
  const double half = scaled ? -0.5 * std::expm1(-a) : std::sinh(0.5 * a);
  const double cosh_rest = 2.0 * half * half;  // cosh a - 1

  const double N = sinh_rest + a * rest;
  const double D = cosh_rest + c.one_plus_cosine;
  d.singular = D == 0.0;
  if (d.singular) {
    d.G = d.H = infinity;
    d.dG_dzeta = infinity;
    return;
  }
  d.G = N / D;
  d.H = beta_pi / d.r * c.sine_ratio / D;
  const double dN = beta_pi * (cosh_rest + rest + 2.0 * a * a * slope);
  const double dD = beta_pi * (growth + a * c.sine_ratio);
  d.dG_dzeta = (dN - d.G * dD) / D;
}

/// For zeta well above 1, with the two decay rates l1 l2 = 1, p = pi l/(2 r), w(p) = 1 - tanh(p)/p:
///   G = (l2 tanh p1 - l1 tanh p2)/(l2 - l1) = pi/(2 r) (w(p2) - w(p1))/(l2 - l1),
///   H = (1/r)(tanh p2 - tanh p1)/(l2 - l1).
void set_by_decay_rates(DenHartog& d) {
  const double sigma = std::sqrt((d.zeta - 1.0) * (d.zeta + 1.0));
  const double fast = d.zeta + sigma;
  const double slow = 1.0 / fast;
  const double h = 0.5 * pi / d.r;
  const auto lag = [](double p) {
    if (p > 0.3) return 1.0 - std::tanh(p) / p;
    const double u = p * p;  // Taylor series; its next term is below 3e-17 of the sum
    return u * (1.0 / 3 +
                u * (-2.0 / 15 +
                     u * (17.0 / 315 + u * (-62.0 / 2835 +
                                            u * (1382.0 / 155925 +
                                                 u * (-21844.0 / 6081075 +
                                                      u * (929569.0 / 638512875 +
                                                           u * (-6404582.0 / 10854718875 +
                                                                u * (443861162.0 / 1856156927625 -
                                                                     u * (18888466084.0 / 194896477400625))))))))));
  };
  const auto square_sech = [](double p) {
    const double e = std::exp(-2.0 * p);
    return 4.0 * e / ((1.0 + e) * (1.0 + e));
  };
  const double t1 = std::tanh(h * slow);
  const double t2 = std::tanh(h * fast);
  d.G = h * (lag(h * fast) - lag(h * slow)) / (2.0 * sigma);
  // tanh p2 - tanh p1 = sinh(p2 - p1)/(cosh p1 cosh p2), which keeps its digits where both tangents are close to 1.
  const double e1 = std::exp(-2.0 * h * slow);
  const double e2 = std::exp(-2.0 * h * fast);
  d.H = -std::expm1(-4.0 * h * sigma) * e1 / ((1.0 + e1) * (1.0 + e2) * sigma * d.r);
  d.dG_dzeta =
      ((fast * t1 + slow * t2) - h * (square_sech(h * slow) + square_sech(h * fast))) / (2.0 * sigma * sigma) -
      d.G * d.zeta / (sigma * sigma);
}

/// h(theta) = b/(w sin theta), theta = wt in (0, pi).
class HalfCycleQuotient {
 public:
  explicit HalfCycleQuotient(const DenHartog& d)
      : d_(d), beta_(1.0 / d.r), drive_((1.0 + d.G) / d.r + d.zeta * d.H) {}

  double operator()(double theta) const {
    const Ringing ringing = ring(beta_ * theta);
    const double half = std::sin(0.5 * theta);
    return -d_.G +
           (d_.H * (ringing.one_minus_cosine - 2.0 * half * half) + drive_ * ringing.sine) / std::sin(theta);
  }

 private:
  /// exp(-zeta u) times cos(s u) and sin(s u)/s at u = wn t.
  struct Ringing {
    double one_minus_cosine = 0.0;
    double sine = 0.0;
  };

  Ringing ring(double u) const {
    if (d_.zeta < 1.0) {
      const double s = std::sqrt((1.0 - d_.zeta) * (1.0 + d_.zeta));
      const double decay = std::exp(-d_.zeta * u);
      const double half = std::sin(0.5 * s * u);
      return {-std::expm1(-d_.zeta * u) + 2.0 * decay * half * half, decay * std::sin(s * u) / s};
    }
    const double sigma = std::sqrt((d_.zeta - 1.0) * (d_.zeta + 1.0));
    const double fast = d_.zeta + sigma;
    const double slow = 1.0 / fast;
    const double spread = sigma == 0.0 ? u : -std::expm1(-2.0 * sigma * u) / (2.0 * sigma);
    return {-0.5 * (std::expm1(-slow * u) + std::expm1(-fast * u)), std::exp(-slow * u) * spread};
  }

  const DenHartog& d_;
  double beta_;
  double drive_;
};

/// Samples that resolve every rate in b: at least 32 points in a period of the free vibration. For zeta >= 1, where
/// b is a sum of three slow curves and two exponentials, 16 points in a decade of the time constants.
std::vector<double> half_cycle_grid(const DenHartog& d) {
  std::vector<double> grid;
  const int uniform = 64 + (d.zeta < 1.0 ? static_cast<int>(std::ceil(16.0 / d.r)) : 0);
  if (d.zeta >= 1.0) {
    const double shortest = std::min(0.01, 0.01 * d.r / (2.0 * d.zeta));
    for (double theta = shortest; theta < pi / uniform; theta *= 1.1547819846894583) grid.push_back(theta);
  }
  for (int i = 1; i < uniform; ++i) grid.push_back(pi * i / uniform);
  return grid;
}

double positive_angle(double angle) {
  const double reduced = std::fmod(angle, core::two_pi);
  return reduced < 0.0 ? reduced + core::two_pi : reduced;
}

}  // namespace

DenHartog den_hartog(double zeta, double r) {
  assert(zeta >= 0.0 && std::isfinite(zeta) && r > 0.0 && std::isfinite(r));
  DenHartog d;
  d.zeta = zeta;
  d.r = r;
  d.q = std::hypot((1.0 - r) * (1.0 + r), 2.0 * zeta * r);
  // The two forms agree; each is accurate on its side. Near zeta = 1 the decay rates meet and their divided
  // difference cancels. Far above it the hyperbolic terms of the other form cancel.
  if (zeta > 1.02) {
    set_by_decay_rates(d);
  } else {
    set_by_squares(d);
  }
  return d;
}

DenHartogSlopes slopes(const DenHartog& d) {
  assert(d.zeta > 0.0 && d.zeta < 1.0);
  using Complex = std::complex<double>;
  const double s = std::sqrt((1.0 - d.zeta) * (1.0 + d.zeta));
  // With l = zeta + i s both functions are parts of T = tanh(pi l/(2 r)):  T = (G + zeta r H) + i s r H.
  const Complex l(d.zeta, s);
  const Complex T(d.G + d.zeta * d.r * d.H, s * d.r * d.H);
  const Complex rate = 0.5 * pi / d.r * (1.0 - T * T);
  const Complex T_zeta = rate * Complex(1.0, -d.zeta / s);
  const Complex T_r = -rate * l / d.r;
  DenHartogSlopes slopes;
  slopes.H_zeta = T_zeta.imag() / (d.r * s) + d.H * d.zeta / (s * s);
  slopes.G_zeta = T_zeta.real() - d.r * d.H - d.zeta * d.r * slopes.H_zeta;
  slopes.q_zeta = 4.0 * d.zeta * d.r * d.r / d.q;
  slopes.H_r = T_r.imag() / (d.r * s) - d.H / d.r;
  slopes.G_r = T_r.real() - d.zeta * d.H - d.zeta * d.r * slopes.H_r;
  slopes.q_r = 2.0 * d.r * (2.0 * d.zeta * d.zeta - (1.0 - d.r) * (1.0 + d.r)) / d.q;
  return slopes;
}

double approximate_G(double zeta) {
  assert(zeta > 0.0);
  return 1.0 / std::tanh(0.5 * pi * zeta);
}

double approximate_G_derivative(double zeta) {
  assert(zeta > 0.0);
  const double sinh = std::sinh(0.5 * pi * zeta);
  return -0.5 * pi / (sinh * sinh);
}

double turning_point_limit(const DenHartog& d) {
  if (d.singular) return infinity;
  return (1.0 + (1.0 - d.r) * (1.0 + d.r) * d.G + 2.0 * d.zeta * d.r * d.H) / (d.r * d.r);
}

double non_sticking_limit(const DenHartog& d) {
  if (d.singular) return infinity;
  // The other end point never decides: by symmetry the accelerations at the two turning points make its limit
  // smaller by 2/r^2.
  double greatest = turning_point_limit(d);
  const HalfCycleQuotient quotient(d);
  const std::vector<double> grid = half_cycle_grid(d);
  std::vector<double> values(grid.size());
  std::transform(grid.begin(), grid.end(), values.begin(), quotient);
  const auto negative = [&quotient](double theta) { return -quotient(theta); };
  constexpr int half_precision = std::numeric_limits<double>::digits / 2;
  // The last sample is next to the end point. The first interval is always searched, because a maximum may lie
  // between the turning point and the first sample.
  for (std::size_t i = 0; i + 1 < grid.size(); ++i) {
    if (i > 0 && (values[i] < values[i - 1] || values[i] < values[i + 1])) continue;
    const double from = i == 0 ? 1e-3 * grid[0] : grid[i - 1];
    const double to = grid[i + 1];
    const auto peak = boost::math::tools::brent_find_minima(negative, from, to, half_precision);
    greatest = std::max({greatest, values[i], -peak.second});
  }
  return greatest;
}

double non_sticking_boundary(const DenHartog& d) {
  if (d.singular) return 0.0;
  return 1.0 / (d.q * std::hypot(non_sticking_limit(d) + d.G, d.H));
}

std::optional<double> amplitude(const DenHartog& d, double Y, double x_f) {
  assert(Y > 0.0 && x_f >= 0.0);
  if (d.q == 0.0 || (d.singular && x_f > 0.0)) return std::nullopt;
  const double viscous = Y / d.q;
  if (x_f == 0.0) return viscous;
  const double reactive = d.H * x_f;
  const double largest = std::hypot(d.G, d.H) * x_f;  // size of the friction terms; x_o = 0 there
  if (!(viscous > largest) || !(viscous >= std::abs(reactive))) return std::nullopt;
  const double root = std::sqrt((viscous - reactive) * (viscous + reactive));
  // root - G x_f in a form that does not cancel for small x_o.
  return (viscous - largest) * (viscous + largest) / (d.G * x_f + root);
}

std::optional<NonStickingState> non_sticking_state(const DenHartog& d, double Y, double x_f) {
  return non_sticking_state(d, x_f > 0.0 ? non_sticking_limit(d) : 0.0, Y, x_f);
}

std::optional<NonStickingState> non_sticking_state(const DenHartog& d, double limit, double Y, double x_f) {
  const std::optional<double> x_o = amplitude(d, Y, x_f);
  if (!x_o || (x_f > 0.0 && !(*x_o > limit * x_f))) return std::nullopt;
  NonStickingState state;
  state.amplitude = *x_o;
  const double viscous_lag = std::atan2(2.0 * d.zeta * d.r, (1.0 - d.r) * (1.0 + d.r));
  const double friction_lag = x_f == 0.0 ? 0.0 : std::atan2(-d.H * x_f, *x_o + d.G * x_f);
  state.turning_phase = positive_angle(viscous_lag + friction_lag);
  // Fundamental of m x'' + c x' + k x = k y + F0 sgn(sin wt) with time from the turning point.
  const std::complex<double> drive = std::polar(Y, state.turning_phase) - std::complex<double>(0.0, 4.0 / pi * x_f);
  const std::complex<double> stiffness((1.0 - d.r) * (1.0 + d.r), 2.0 * d.zeta * d.r);
  const std::complex<double> fundamental = drive / stiffness;
  state.fundamental = std::abs(fundamental);
  state.phase = positive_angle(state.turning_phase - std::arg(fundamental));
  return state;
}

}  // namespace dualdamp::sim::analytic
