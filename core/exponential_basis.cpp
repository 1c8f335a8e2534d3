#include "core/exponential_basis.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>

namespace dualdamp::core {

namespace {

constexpr int max_nodes = 6;

/// Panel width times the fastest |z|: just over half a period, so that a resonant half period is one panel; the
/// remainder of the quintic interpolant is then 2 % of the amplitude, small against the arch between two zeros.
constexpr double panel_angle = 3.2;

/// Below this |z delta| ten Taylor terms of exp(z delta) - 1 are exact to rounding of exp.
constexpr double shift_limit = 0.1;

/// exp(rate s). Far down a decay the rounding of the exponent would cost as many roundings of the result: it is
/// given back.
double real_exponential(double rate, double s) {
  const double exponent = rate * s;
  const double result = std::exp(exponent);
  if (exponent > -8.0 || result == 0.0) return result;
  return result * (1.0 + std::fma(rate, s, -exponent));
}

Complex exponential(Complex z, double s) {
  const double size = z.real() == 0.0 ? 1.0 : real_exponential(z.real(), s);
  return z.imag() == 0.0 ? Complex(size) : std::polar(size, z.imag() * s);
}

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
/// s^n exp(z_0 s) sum_k h_k(w)/(n + k)!, h_k the complete homogeneous symmetric polynomials, built up column by
/// column of the bidiagonal matrix that has the nodes on its diagonal.
Complex close_nodes(const Nodes& nodes, double s) {
  const int n = nodes.count - 1;
  const Complex first = nodes.z[0];
  // power[i] = h_k of the first i + 1 nodes; starts as h_0 = 1.
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

/// Divided difference of z -> exp(z s). The farthest pair is taken apart as long as that loses no digits.
Complex divided_exponential(const Nodes& nodes, double s) {
  if (nodes.count == 1) return exponential(nodes.z[0], s);
  int far_a = 0;
  int far_b = 1;
  double spread = -1.0;
  for (int a = 0; a < nodes.count; ++a) {
    for (int b = a + 1; b < nodes.count; ++b) {
      const double distance = std::abs(nodes.z[static_cast<std::size_t>(a)] - nodes.z[static_cast<std::size_t>(b)]);
      if (distance > spread) {
        spread = distance;
        far_a = a;
        far_b = b;
      }
    }
  }
  if (spread * s <= 1.0) return close_nodes(nodes, s);
  const Complex gap = nodes.z[static_cast<std::size_t>(far_a)] - nodes.z[static_cast<std::size_t>(far_b)];
  return (divided_exponential(without(nodes, far_b), s) - divided_exponential(without(nodes, far_a), s)) / gap;
}

/// exp(w) - 1 for |w| < shift_limit; odd and even powers apart, which wait less for each other.
Complex small_exponential(Complex w, double size) {
  // w^3/6 adds nothing to 1.
  if (size < 5e-6) return w * (1.0 + 0.5 * w);
  const Complex square = w * w;
  if (size < 1e-3) return w * (1.0 + square * (1.0 / 6.0)) + square * (1.0 / 2.0 + square * (1.0 / 24.0));
  const Complex odd =
      1.0 + square * (1.0 / 6.0 + square * (1.0 / 120.0 + square * (1.0 / 5040.0 + square * (1.0 / 362880.0))));
  const Complex even =
      1.0 / 2.0 +
      square * (1.0 / 24.0 + square * (1.0 / 720.0 + square * (1.0 / 40320.0 + square * (1.0 / 3628800.0))));
  return w * odd + square * even;
}

}  // namespace

int ExponentialBasis::add(Complex exponent, int parent) {
  if (size_ >= capacity || parent >= size_)
    throw std::length_error("one mode holds at most " + std::to_string(capacity) + " exponentials");
  const std::size_t k = index(size_);
  re_[k] = exponent.real();
  im_[k] = exponent.imag();
  parent_[k] = parent;
  square_[k] = std::norm(exponent);
  fastest_ = std::max(fastest_, modulus_bound(exponent.real(), exponent.imag()));
  turning_ = std::max({turning_, exponent.real(), std::abs(exponent.imag())});
  has_chains_ = has_chains_ || parent != no_parent;
  return size_++;
}

void ExponentialBasis::finish(double expected) {
  panel_ = fastest_ > 0.0 ? panel_angle / fastest_ : 1.0;
  if (!has_chains_) evaluate(panel_, rotor_);
  even_ = !has_chains_;
  for (int k = 0; k < size_; ++k) {
    const double rate = modulus_bound(re_[index(k)], im_[index(k)]);
    even_ = even_ && growth(k) == 0.0 && (rate == 0.0 || 4.0 * rate >= fastest_);
  }
  if (!even_ || !(expected > 0.0)) return;
  expected_ = expected;
  evaluate(expected_, expected_values_);
}

Complex ExponentialBasis::chain_value(int k, double s) const {
  Nodes nodes;
  for (int i = k; i != no_parent; i = parent(i)) {
    assert(nodes.count < max_nodes);
    nodes.z[static_cast<std::size_t>(nodes.count++)] = exponent(i);
  }
  return divided_exponential(nodes, s);
}

void ExponentialBasis::evaluate(double s, Values& values) const {
  for (std::size_t k = 0; k < index(size_); ++k) {
    if (parent_[k] != no_parent) {
      const Complex value = chain_value(static_cast<int>(k), s);
      values.re[k] = value.real();
      values.im[k] = value.imag();
      continue;
    }
    const Complex value = exponential({re_[k], im_[k]}, s);
    values.re[k] = value.real();
    values.im[k] = value.imag();
  }
}

bool ExponentialBasis::shift(double delta, Values& values) const {
  const double angle = fastest_ * std::abs(delta);
  if (has_chains_ || !(angle < shift_limit)) return false;
  for (std::size_t k = 0; k < index(size_); ++k) {
    if (square_[k] == 0.0) continue;
    const Complex gain = small_exponential(Complex(re_[k], im_[k]) * delta, angle);
    const Complex old(values.re[k], values.im[k]);
    const Complex value = old + old * gain;
    values.re[k] = value.real();
    values.im[k] = value.imag();
  }
  return true;
}

void ExponentialBasis::step_panel(const Values& from, Values& to) const {
  for (std::size_t k = 0; k < index(size_); ++k) {
    to.re[k] = from.re[k] * rotor_.re[k] - from.im[k] * rotor_.im[k];
    to.im[k] = from.re[k] * rotor_.im[k] + from.im[k] * rotor_.re[k];
  }
}

namespace {

/// Bound of the chain element k. Two hold and the smaller is taken:
///   Hermite and Genocchi:  |E| <= s^n/n! max exp(Re z s) over the nodes, good while s is small;
///   E' = z E + E_parent:   |E| <= G |E(begin)| + max |E_parent| int exp(Re z u) du, good behind a fast decay.
double chain_bound(const ExponentialBasis& basis, int k, double at_begin, double parent_bound, double begin,
                   double width) {
  double slowest = basis.exponent(k).real();
  double power = 1.0;
  int n = 0;
  for (int p = basis.parent(k); p != ExponentialBasis::no_parent; p = basis.parent(p)) {
    slowest = std::max(slowest, basis.exponent(p).real());
    power *= (begin + width) / ++n;
  }
  const double by_nodes = power * std::exp(slowest * (slowest > 0.0 ? begin + width : begin));
  const double decay = -basis.exponent(k).real();
  const double gain = decay < 0.0 ? std::exp(-decay * width) : 1.0;
  const double memory = decay * width > 1.0 ? 1.0 / decay : width;
  return std::min(by_nodes, gain * (at_begin + memory * parent_bound));
}

}  // namespace

double bound(const ExponentialBasis& basis, const ModeFunction& f, const ExponentialBasis::Values& values,
             double begin, double width) {
  std::array<double, ExponentialBasis::capacity> element;
  double sum = 0.0;
  for (int k = 0; k < basis.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    element[i] = modulus_bound(values.re[i], values.im[i]);
    if (basis.parent(k) != ExponentialBasis::no_parent) {
      const double parent_bound = element[static_cast<std::size_t>(basis.parent(k))];
      element[i] = chain_bound(basis, k, element[i], parent_bound, begin, width);
    } else if (basis.growth(k) > 0.0) {
      element[i] *= std::exp(basis.growth(k) * width);
    }
    const double size = modulus_bound(f.re[i], f.im[i]);
    if (size > 0.0) sum += size * element[i];
  }
  return sum;
}

}  // namespace dualdamp::core
