#include "tests/support/oracle.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace dualdamp::oracle {

namespace {

namespace mp = boost::multiprecision;
using Digits50 = mp::number<mp::cpp_bin_float<50>, mp::et_off>;

/// std::complex is defined for the built-in types only.
struct Wide {
  Digits50 re = 0;
  Digits50 im = 0;

  Wide() = default;
  Wide(Digits50 real) : re(std::move(real)) {}
  Wide(Digits50 real, Digits50 imaginary) : re(std::move(real)), im(std::move(imaginary)) {}
  explicit Wide(Complex z) : re(z.real()), im(z.imag()) {}

  friend Wide operator+(const Wide& a, const Wide& b) { return {a.re + b.re, a.im + b.im}; }
  friend Wide operator-(const Wide& a, const Wide& b) { return {a.re - b.re, a.im - b.im}; }
  friend Wide operator*(const Wide& a, const Wide& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend Wide operator/(const Wide& a, const Wide& b) {
    const Digits50 norm = b.re * b.re + b.im * b.im;
    return {(a.re * b.re + a.im * b.im) / norm, (a.im * b.re - a.re * b.im) / norm};
  }
};

Digits50 size(const Wide& a) { return abs(a.re) + abs(a.im); }
Digits50 size(const Digits50& a) { return abs(a); }
bool is_zero(const Wide& a) { return a.re == 0 && a.im == 0; }
bool is_zero(const Digits50& a) { return a == 0; }

template <class T>
struct Matrix {
  explicit Matrix(std::size_t order) : n(order), entries(order * order) {}
  T& operator()(std::size_t i, std::size_t j) { return entries[i * n + j]; }
  const T& operator()(std::size_t i, std::size_t j) const { return entries[i * n + j]; }

  friend Matrix operator*(const Matrix& a, const Matrix& b) {
    Matrix c(a.n);
    for (std::size_t i = 0; i < a.n; ++i) {
      for (std::size_t k = 0; k < a.n; ++k) {
        if (is_zero(a(i, k))) continue;
        for (std::size_t j = 0; j < a.n; ++j) {
          if (!is_zero(b(k, j))) c(i, j) = c(i, j) + a(i, k) * b(k, j);
        }
      }
    }
    return c;
  }

  std::size_t n;
  std::vector<T> entries;
};

/// exp(a s): Taylor series of a s/2^k with norm below 1/2, to 60 digits, then k squarings.
template <class T>
Matrix<T> exponential(Matrix<T> a, const Digits50& s) {
  Digits50 norm = 0;
  for (std::size_t i = 0; i < a.n; ++i) {
    Digits50 row = 0;
    for (std::size_t j = 0; j < a.n; ++j) row += size(a(i, j)) * s;
    norm = std::max(norm, row);
  }
  int squarings = 0;
  for (; norm > 0.5; norm /= 2) ++squarings;
  const Digits50 h = ldexp(s, -squarings);
  for (T& entry : a.entries) entry = entry * T(h);
  Matrix<T> sum(a.n);
  Matrix<T> term(a.n);
  for (std::size_t i = 0; i < a.n; ++i) sum(i, i) = term(i, i) = T(Digits50(1));
  for (int k = 1; k < 36; ++k) {
    term = term * a;
    const T inverse(Digits50(1) / k);
    for (std::size_t i = 0; i < a.entries.size(); ++i) {
      if (is_zero(term.entries[i])) continue;
      term.entries[i] = term.entries[i] * inverse;
      sum.entries[i] = sum.entries[i] + term.entries[i];
    }
  }
  for (int k = 0; k < squarings; ++k) sum = sum * sum;
  return sum;
}

Complex rounded(const Wide& a) { return {a.re.convert_to<double>(), a.im.convert_to<double>()}; }
std::complex<long double> long_rounded(const Wide& a) {
  return {a.re.convert_to<long double>(), a.im.convert_to<long double>()};
}

Wide root(const Digits50& a) { return a >= 0 ? Wide(sqrt(a)) : Wide(0, sqrt(-a)); }

}  // namespace

Complex divided_exponential(std::span<const Complex> nodes, double s) {
  Matrix<Wide> a(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    a(i, i) = Wide(nodes[i]);
    if (i + 1 < nodes.size()) a(i, i + 1) = Wide(Digits50(1));
  }
  return rounded(exponential(a, s)(0, nodes.size() - 1));
}

State solve(const LinearProblem& p, double s) {
  // z = (x, v, 1, s, s^2/2, s^3/6, transients..., (cos, sin)...); z' = A z.
  const std::size_t n = 6 + p.transients.size() + 2 * p.harmonics.size();
  const Digits50 mass = p.mass;
  Matrix<Digits50> a(n);
  std::vector<Digits50> z(n);
  z[0] = p.x0;
  z[1] = p.v0;
  z[2] = 1;
  a(0, 1) = 1;
  a(1, 0) = -Digits50(p.stiffness) / mass;
  a(1, 1) = -Digits50(p.damping) / mass;
  a(1, 2) = Digits50(p.constant) / mass;
  a(1, 3) = Digits50(p.ramp) / mass;
  a(1, 4) = Digits50(p.second) / mass;
  a(1, 5) = Digits50(p.third) / mass;
  a(3, 2) = a(4, 3) = a(5, 4) = 1;
  std::size_t i = 6;
  for (const auto& transient : p.transients) {
    a(i, i) = -Digits50(transient.decay);
    a(1, i) = Digits50(transient.amplitude) / mass;
    z[i++] = 1;
  }
  for (const auto& harmonic : p.harmonics) {
    a(i, i + 1) = -Digits50(harmonic.frequency);
    a(i + 1, i) = harmonic.frequency;
    a(1, i) = Digits50(harmonic.phasor.real()) / mass;
    a(1, i + 1) = -Digits50(harmonic.phasor.imag()) / mass;
    z[i] = 1;
    i += 2;
  }
  const Matrix<Digits50> e = exponential(a, s);
  Digits50 x = 0;
  Digits50 v = 0;
  for (std::size_t k = 0; k < n; ++k) {
    x += e(0, k) * z[k];
    v += e(1, k) * z[k];
  }
  return {x.convert_to<double>(), v.convert_to<double>()};
}

std::vector<Exponential> slip_velocity(const LinearProblem& p) {
  const Digits50 mass = p.mass;
  const Digits50 half = Digits50(p.damping) / (2 * mass);
  const Wide beat = root(half * half - Digits50(p.stiffness) / mass);
  const Wide first = Wide(-half) + beat;
  const Wide second = Wide(-half) - beat;
  // x = constant/k + sum P_j exp(i w_j s) + A exp(first s) + B exp(second s), Re understood.
  std::vector<Exponential> terms;
  Wide position = Wide(Digits50(p.x0) - Digits50(p.constant) / Digits50(p.stiffness));
  Wide velocity = Wide(Digits50(p.v0));
  for (const auto& harmonic : p.harmonics) {
    const Wide z(0, harmonic.frequency);
    const Wide response = Wide(harmonic.phasor) / (Wide(mass) * (z - first) * (z - second));
    terms.push_back({long_rounded(z), long_rounded(response * z)});
    position = position - Wide(response.re);
    velocity = velocity - Wide((response * z).re);
  }
  const Wide b = (velocity - first * position) / (second - first);
  const Wide a = position - b;
  terms.push_back({long_rounded(first), long_rounded(a * first)});
  terms.push_back({long_rounded(second), long_rounded(b * second)});
  return terms;
}

}  // namespace dualdamp::oracle
