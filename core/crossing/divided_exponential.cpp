#include "core/crossing/divided_exponential.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace dualdamp::core {

namespace {

/// exp(rate s). For a large negative exponent, its rounding would be |exponent| roundings of the result; the last
/// line corrects this.
double real_exponential(double rate, double s) {
  const double exponent = rate * s;
  const double result = std::exp(exponent);
  if (exponent > -8.0 || result == 0.0) return result;
  return result * (1.0 + std::fma(rate, s, -exponent));
}

}  // namespace

Complex exponential(Complex z, double s) {
  const double size = z.real() == 0.0 ? 1.0 : real_exponential(z.real(), s);
  return z.imag() == 0.0 ? Complex(size) : std::polar(size, z.imag() * s);
}

namespace {

/// Nodes of one divided difference of z -> exp(z s).
struct Nodes {
  std::array<Complex, max_nodes> z;
  int count = 0;
};

Nodes without(const Nodes& nodes, int removed) {
  Nodes rest;
  for (int i = 0; i < nodes.count; ++i) {
    if (i != removed) rest.z[static_cast<std::size_t>(rest.count++)] = nodes.z[static_cast<std::size_t>(i)];
  }
  return rest;
}

/// Close nodes: Taylor series about the first one. With w_i = (z_i - z_0) s the divided difference is
/// s^n exp(z_0 s) sum_k h_k(w)/(n + k)!. The complete homogeneous symmetric polynomials h_k are formed column by
/// column of the bidiagonal matrix that has the nodes on its diagonal.
Complex close_nodes(const Nodes& nodes, double s) {
  const int n = nodes.count - 1;
  const Complex first = nodes.z[0];
  // power[i] = h_k of the first i + 1 nodes, at first h_0 = 1.
  std::array<Complex, max_nodes> power;
  power.fill(1.0);
  double factorial = 1.0;
  for (int i = 1; i <= n; ++i) factorial *= i;
  Complex sum = 0.0;
  for (int k = 0; k < 26; ++k) {
    sum += power[static_cast<std::size_t>(n)] / factorial;
    factorial *= n + k + 1;
    Complex before = 0.0;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(n); ++i) {
      before += (nodes.z[i] - first) * s * power[i];
      power[i] = before;
    }
  }
  return sum * exponential(first, s) * std::pow(s, n);
}

/// exp(w) - 1, with an error of a few roundings of |w|.
Complex exponential_less_one(Complex w) {
  if (w.imag() == 0.0) return std::expm1(w.real());
  const double half = std::sin(0.5 * w.imag());
  const double growth = std::expm1(w.real());
  return {growth * std::cos(w.imag()) - 2.0 * half * half, (growth + 1.0) * std::sin(w.imag())};
}

/// Two nodes: exp(a s) (exp((b - a) s) - 1)/(b - a), where a is the slower decay.
Complex divided_pair(Complex a, Complex b, double s) {
  if (a.real() < b.real()) std::swap(a, b);
  const Complex gap = b - a;
  // The gap is lost beside 1: take the limit.
  if (std::norm(gap * s) < 1e-34) return exponential(a, s) * s;
  return exponential(a, s) * (exponential_less_one(gap * s) / gap);
}

/// The recursion of divided differences over the farthest pair, while the difference loses no digits; else the
/// series.
Complex divided(const Nodes& nodes, double s) {
  if (nodes.count == 1) return exponential(nodes.z[0], s);
  if (nodes.count == 2) return divided_pair(nodes.z[0], nodes.z[1], s);
  int far_a = 0;
  int far_b = 1;
  double spread = -1.0;
  for (int a = 0; a < nodes.count; ++a) {
    for (int b = a + 1; b < nodes.count; ++b) {
      const double distance =
          std::norm(nodes.z[static_cast<std::size_t>(a)] - nodes.z[static_cast<std::size_t>(b)]);
      if (distance > spread) {
        spread = distance;
        far_a = a;
        far_b = b;
      }
    }
  }
  if (spread * s * s <= 1.0) return close_nodes(nodes, s);
  const Complex gap = nodes.z[static_cast<std::size_t>(far_a)] - nodes.z[static_cast<std::size_t>(far_b)];
  return (divided(without(nodes, far_b), s) - divided(without(nodes, far_a), s)) / gap;
}

}  // namespace

Complex divided_exponential(std::span<const Complex> nodes, double s) {
  if (nodes.size() > max_nodes)
    throw std::length_error("a divided difference takes at most " + std::to_string(max_nodes) + " exponents");
  Nodes list;
  list.count = static_cast<int>(nodes.size());
  std::copy(nodes.begin(), nodes.end(), list.z.begin());
  return divided(list, s);
}

}  // namespace dualdamp::core
