#pragma once
/// Reference values in 50 decimal digits, rounded to double at the very end. The parameters are doubles taken as
/// exact. Methods share nothing with the library: matrix exponentials by Taylor series with scaling and squaring.

#include <complex>
#include <span>
#include <vector>

namespace dualdamp::oracle {

using Complex = std::complex<double>;

/// Divided difference of z -> exp(z s) over `nodes`, equal ones allowed: the corner of the exponential of s times
/// the bidiagonal matrix with the nodes on its diagonal and ones above it (Opitz).
[[nodiscard]] Complex divided_exponential(std::span<const Complex> nodes, double s);

/// m x'' + C x' + K x = constant + ramp s + second s^2/2 + third s^3/6 + sum a_i exp(-d_i s) + Re sum p_j exp(i w_j
/// s)
struct LinearProblem {
  struct Harmonic {
    double frequency = 0.0;
    Complex phasor;
  };
  struct Transient {
    double decay = 0.0;
    double amplitude = 0.0;
  };

  double mass = 1.0;
  double damping = 0.0;
  double stiffness = 0.0;
  double constant = 0.0;
  double ramp = 0.0;
  double second = 0.0;
  double third = 0.0;
  std::vector<Harmonic> harmonics{};
  std::vector<Transient> transients{};
  double x0 = 0.0;
  double v0 = 0.0;
};

struct State {
  double x = 0.0;
  double v = 0.0;
};

/// The state at s, from the exponential of the matrix of (x, v, 1, s, s^2/2, s^3/6, transients, harmonics).
[[nodiscard]] State solve(const LinearProblem& problem, double s);

/// A mass that slips from rest at s = 0 under  m x'' + c x' + k x = Re sum p_j exp(i w_j s) - friction, with
/// x(0) = x0, x'(0) = 0. Its velocity as exponentials; no two exponents may be equal.
struct Exponential {
  std::complex<long double> exponent;
  std::complex<long double> coefficient;
};
[[nodiscard]] std::vector<Exponential> slip_velocity(const LinearProblem& problem);

}  // namespace dualdamp::oracle
