#include "core/crossing/exponential_basis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/crossing/divided_exponential.hpp"

namespace dualdamp::core {

namespace {

/// Panel width times the fastest |z|: just over half a period, so that a resonant half period is one panel. The
/// remainder of the quintic interpolant is then 2 % of the amplitude, small beside the arch between two zeros.
constexpr double panel_angle = 3.2;

/// Below this |z delta| ten Taylor terms give exp(z delta) - 1 to the rounding of exp.
constexpr double shift_limit = 0.1;

/// exp(w) - 1 for |w| < shift_limit. Odd and even powers are summed separately: the processor then works on both at
/// once.
Complex small_exponential(Complex w, double size) {
  // Beside 1 the term w^3/6 is lost.
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
  int nodes = 1;
  for (int i = parent; i != no_parent; i = parent_[index(i)]) ++nodes;
  if (nodes > static_cast<int>(max_nodes))
    throw std::length_error("a divided difference takes at most " + std::to_string(max_nodes) + " exponents");
  re_.push_back(exponent.real());
  im_.push_back(exponent.imag());
  parent_.push_back(parent);
  square_.push_back(std::norm(exponent));
  fastest_ = std::max(fastest_, modulus_bound(exponent.real(), exponent.imag()));
  turning_ = std::max({turning_, exponent.real(), std::abs(exponent.imag())});
  has_chains_ = has_chains_ || parent != no_parent;
  grows_ = grows_ || exponent.real() > 0.0;
  return size_++;
}

/// Finds the elements s^n/n!, which are chains of zeros.
void ExponentialBasis::find_powers() {
  power_.assign(index(size_), 0);
  for (int k = 0; k < size_; ++k) {
    const int p = parent(k);
    if (p == no_parent || exponent(k) != 0.0 || exponent(p) != 0.0) continue;
    const bool is_first = parent(p) == no_parent;
    if (is_first || power_[index(p)] > 0) power_[index(k)] = is_first ? 1 : power_[index(p)] + 1;
  }
}

/// Finds a chain of two exponents, whose sum and product are real, followed by zeros.
void ExponentialBasis::find_short_chain() {
  short_order_.assign(index(size_), -1);
  for (int k = 0; k < size_; ++k) {
    const int root = parent(k);
    if (root == no_parent || parent(root) != no_parent || exponent(k) == 0.0) continue;
    const Complex sum = exponent(root) + exponent(k);
    const Complex product = exponent(root) * exponent(k);
    if (sum.imag() != 0.0 || product.imag() != 0.0) continue;
    std::size_t count = 1;
    for (int child = k + 1, last = k; child < size_ && count < ShortChain::most; ++child) {
      if (parent(child) != last || exponent(child) != 0.0) continue;
      short_order_[index(child)] = static_cast<int>(++count);
      last = child;
    }
    if (count == 1) continue;
    short_order_[index(root)] = 0;
    short_order_[index(k)] = 1;
    short_chain_ = ShortChain(sum.real(), product.real(), count);
    short_rate_ = std::max(modulus_bound(exponent(root).real(), exponent(root).imag()),
                           modulus_bound(exponent(k).real(), exponent(k).imag()));
    return;
  }
}

void ExponentialBasis::finish(double expected) {
  find_powers();
  find_short_chain();
  panel_ = fastest_ > 0.0 ? panel_angle / fastest_ : 1.0;
  if (!has_chains_) evaluate(panel_, rotor_);
  relative_square_.clear();
  for (int k = 0; k < size_; ++k)
    relative_square_.push_back(fastest_ > 0.0 ? std::norm(exponent(k) / fastest_) : 0.0);
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
  std::array<Complex, max_nodes> nodes;
  std::size_t count = 0;
  for (int i = k; i != no_parent; i = parent(i)) nodes[count++] = exponent(i);
  return divided_exponential({nodes.data(), count}, s);
}

void ExponentialBasis::start(Values& values) const {
  values.fit(index(size_));
  for (std::size_t k = 0; k < index(size_); ++k) {
    values.re[k] = parent_[k] == no_parent ? 1.0 : 0.0;
    values.im[k] = 0.0;
  }
}

void ExponentialBasis::evaluate(double s, Values& values) const {
  values.fit(index(size_));
  const bool is_short = short_rate_ * s <= 1.0;
  std::array<double, ShortChain::most> responses{};
  if (is_short) responses = short_chain_.at(s);
  for (std::size_t k = 0; k < index(size_); ++k) {
    Complex value;
    if (is_short && short_order_[k] >= 0) {
      const int order = short_order_[k];
      value =
          order > 0 ? responses[index(order - 1)] : short_chain_.exponential(Complex(re_[k], im_[k]), responses);
    } else if (parent_[k] == no_parent) {
      value = exponential({re_[k], im_[k]}, s);
    } else if (!power_.empty() && power_[k] > 0) {
      value = values.re[index(parent_[k])] * s / power_[k];
    } else {
      value = chain_value(static_cast<int>(k), s);
    }
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
  to.fit(index(size_));
  for (std::size_t k = 0; k < index(size_); ++k) {
    to.re[k] = from.re[k] * rotor_.re[k] - from.im[k] * rotor_.im[k];
    to.im[k] = from.re[k] * rotor_.im[k] + from.im[k] * rotor_.re[k];
  }
}

namespace {

/// Bound of the chain element k, the smaller of two bounds:
///   Hermite and Genocchi:  |E| <= s^n/n! max exp(Re z s) over the nodes, sharp while s is small;
///   E' = z E + E_parent:   |E| <= G |E(begin)| + max |E_parent| int exp(Re z u) du, sharp after a fast decay.
double chain_bound(const ExponentialBasis& basis, int k, double at_begin, double parent_bound, double begin,
                   double width) {
  double slowest = basis.exponent(k).real();
  double power = 1.0;
  int n = 0;
  for (int p = basis.parent(k); p != ExponentialBasis::no_parent; p = basis.parent(p)) {
    slowest = std::max(slowest, basis.exponent(p).real());
    power *= (begin + width) / ++n;
  }
  const double largest = slowest == 0.0 ? 1.0 : std::exp(slowest * (slowest > 0.0 ? begin + width : begin));
  const double by_nodes = power * largest;
  const double decay = -basis.exponent(k).real();
  const double gain = decay < 0.0 ? std::exp(-decay * width) : 1.0;
  const double memory = decay * width > 1.0 ? 1.0 / decay : width;
  return std::min(by_nodes, gain * (at_begin + memory * parent_bound));
}

}  // namespace

double evaluate_with_growth(const ExponentialBasis& basis, const ModeFunction& f,
                            const ExponentialBasis::Values& values) {
  double sum = 0.0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(basis.size()); ++k) {
    if (takes_part(f, k)) sum += f.re[k] * values.re[k] - f.im[k] * values.im[k];
  }
  return sum;
}

void bound_elements(const ExponentialBasis& basis, const ExponentialBasis::Values& values, double begin,
                    double width, ElementNumbers& bounds) {
  bounds.fit(static_cast<std::size_t>(basis.size()));
  for (int k = 0; k < basis.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double modulus = modulus_bound(values.re[i], values.im[i]);
    if (basis.parent(k) != ExponentialBasis::no_parent) {
      const double parent_bound = bounds.re[static_cast<std::size_t>(basis.parent(k))];
      bounds.re[i] = chain_bound(basis, k, modulus, parent_bound, begin, width);
    } else {
      bounds.re[i] = basis.growth(k) > 0.0 ? modulus * std::exp(basis.growth(k) * width) : modulus;
    }
  }
}

double bound(const ExponentialBasis& basis, const ModeFunction& f, const ElementNumbers& bounds) {
  double sum = 0.0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(basis.size()); ++k) {
    if (takes_part(f, k)) sum += modulus_bound(f.re[k], f.im[k]) * bounds.re[k];
  }
  return sum;
}

double bound(const ExponentialBasis& basis, const ModeFunction& f, const ExponentialBasis::Values& values,
             double begin, double width) {
  ElementNumbers bounds;
  bound_elements(basis, values, begin, width, bounds);
  return bound(basis, f, bounds);
}

}  // namespace dualdamp::core
