#include "sim/steppers/radau_collocation.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/constants.hpp"
#include "sim/steppers/lu_factors.hpp"

namespace dualdamp::sim {
namespace {

using Complex = std::complex<double>;
using ComplexRow = std::array<Complex, radau_stages>;

/// Newton's correction for a zero of P_s - P_(s-1) (Legendre polynomials) in (-1, 1).
double radau_correction(double x) {
  double before = 1.0;  // P_(n-1)
  double value = x;     // P_n
  for (std::size_t k = 1; k + 1 < radau_stages; ++k) {
    const auto n = static_cast<double>(k);
    before = std::exchange(value, ((2.0 * n + 1.0) * x * value - n * before) / (n + 1.0));
  }
  // Now P_(s-1) and P_(s-2). The derivatives: (x^2 - 1) P_n' = n (x P_n - P_(n-1)).
  const auto s = static_cast<double>(radau_stages);
  const double next = ((2.0 * s - 1.0) * x * value - (s - 1.0) * before) / s;
  const double slope = (s * (x * next - value) - (s - 1.0) * (x * value - before)) / (x * x - 1.0);
  return (next - value) / slope;
}

RadauCollocation::Row radau_points() {
  RadauCollocation::Row points{};
  for (std::size_t k = 0; k + 1 < radau_stages; ++k) {
    // Asymptotic zeros of Jacobi's polynomial P^(1,0), to which the quotient by x - 1 is proportional.
    const auto from_above = static_cast<double>(radau_stages - 1 - k);
    double x = std::cos((2.0 * from_above + 0.5) * std::numbers::pi / (2.0 * static_cast<double>(radau_stages)));
    for (int iteration = 0; iteration < 10; ++iteration) x -= radau_correction(x);
    points[k] = 0.5 * (x + 1.0);
  }
  points[radau_stages - 1] = 1.0;
  return points;
}

/// The eigenvalues of Butcher's inverse matrix: the poles of the stability function, which is Pade's approximation
/// of exp(z) with degrees s - 1 and s. Found together by Weierstrass' (Durand and Kerner's) iteration.
ComplexRow poles() {
  std::array<double, radau_stages + 1> coefficients{};  // of the denominator, highest first, the highest 1
  coefficients[0] = 1.0;
  for (std::size_t k = 0; k < radau_stages; ++k) {
    const auto j = static_cast<double>(radau_stages - k);
    const auto s = static_cast<double>(radau_stages);
    coefficients[k + 1] = -coefficients[k] * (2.0 * s - j) * j / (s - j + 1.0);
  }
  ComplexRow zeros{};
  const Complex turn = std::polar(1.0, 0.4 + core::two_pi / static_cast<double>(radau_stages));
  zeros[0] = Complex(static_cast<double>(radau_stages));
  for (std::size_t k = 1; k < radau_stages; ++k) zeros[k] = zeros[k - 1] * turn;
  for (int iteration = 0; iteration < 100; ++iteration) {
    for (std::size_t k = 0; k < radau_stages; ++k) {
      Complex correction = 0.0;
      for (const double coefficient : coefficients) correction = correction * zeros[k] + coefficient;
      for (std::size_t j = 0; j < radau_stages; ++j)
        if (j != k) correction /= zeros[k] - zeros[j];
      zeros[k] -= correction;
    }
  }
  return zeros;
}

/// The eigenvector of a matrix, given column by column, by inverse iteration.
ComplexRow eigenvector(const std::array<double, radau_stages * radau_stages>& matrix, Complex eigenvalue) {
  constexpr double offset = 1e-9;  // keeps the matrix regular
  LuFactors<Complex, radau_stages> factors;
  factors.compute(eigenvalue * (1.0 + offset), matrix);
  ComplexRow vector{};
  vector.fill(1.0);
  for (int iteration = 0; iteration < 4; ++iteration) {
    factors.solve(vector.data());
    double size = 0.0;
    for (const Complex& entry : vector) size = std::hypot(size, std::abs(entry));
    for (Complex& entry : vector) entry /= size;
  }
  return vector;
}

}  // namespace

RadauCollocation::RadauCollocation() : nodes(radau_points()) {
  differentiate();
  diagonalise();
}

const RadauCollocation& RadauCollocation::once() {
  static const RadauCollocation computed;
  return computed;
}

RadauCollocation::Row RadauCollocation::basis(double c) const {
  Row values{};
  double before = c;
  for (std::size_t j = 0; j < radau_stages; ++j) {
    values[j] = scale[j] * before;
    before *= c - nodes[j];
  }
  double after = 1.0;
  for (std::size_t j = radau_stages; j-- > 0;) {
    values[j] *= after;
    after *= c - nodes[j];
  }
  return values;
}

void RadauCollocation::differentiate() {
  for (std::size_t j = 0; j < radau_stages; ++j) {
    double product = 1.0;
    for (std::size_t k = 0; k < radau_stages; ++k)
      if (k != j) product *= nodes[j] - nodes[k];
    scale[j] = 1.0 / (nodes[j] * product);
    start_slope[j] = scale[j];
    for (std::size_t k = 0; k < radau_stages; ++k)
      if (k != j) start_slope[j] *= -nodes[k];
  }
  for (std::size_t i = 0; i < radau_stages; ++i) {
    slopes[i][i] = 1.0 / nodes[i];
    for (std::size_t j = 0; j < radau_stages; ++j) {
      if (j == i) continue;
      slopes[i][i] += 1.0 / (nodes[i] - nodes[j]);
      slopes[i][j] = scale[j] / (scale[i] * (nodes[i] - nodes[j]));
    }
  }
}

void RadauCollocation::diagonalise() {
  std::array<double, radau_stages * radau_stages> matrix{};
  std::array<double, radau_stages * radau_stages> transposed{};
  for (std::size_t i = 0; i < radau_stages; ++i)
    for (std::size_t j = 0; j < radau_stages; ++j)
      matrix[j * radau_stages + i] = transposed[i * radau_stages + j] = slopes[i][j];

  std::size_t pair = 0;
  for (const Complex& eigenvalue : poles()) {
    const bool real = std::abs(eigenvalue.imag()) < 1e-6;
    if (!real && eigenvalue.imag() < 0.0) continue;  // its conjugate gives the same pair
    const ComplexRow right = eigenvector(matrix, eigenvalue);
    const ComplexRow left = eigenvector(transposed, eigenvalue);
    Complex product = 0.0;
    for (std::size_t i = 0; i < radau_stages; ++i) product += left[i] * right[i];
    const std::size_t row = real ? 0 : 1 + 2 * pair;
    for (std::size_t i = 0; i < radau_stages; ++i) {
      const Complex from = left[i] / product;
      from_stages[row][i] = from.real();
      to_stages[i][row] = (real ? 1.0 : 2.0) * right[i].real();
      if (real) continue;
      from_stages[row + 1][i] = from.imag();
      to_stages[i][row + 1] = -2.0 * right[i].imag();
    }
    if (real)
      real_eigenvalue = eigenvalue.real();
    else
      eigenvalues[pair++] = eigenvalue;
  }
}

}  // namespace dualdamp::sim
