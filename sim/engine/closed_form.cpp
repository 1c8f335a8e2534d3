#include "sim/engine/closed_form.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/crossing/divided_exponential.hpp"

namespace dualdamp::sim {

using core::Complex;
using core::ModeFunction;

namespace {

constexpr std::size_t series_terms = 14;

/// 1/(n + 1)
constexpr std::array<double, series_terms + 1> reciprocals = [] {
  std::array<double, series_terms + 1> list{};
  for (std::size_t n = 0; n <= series_terms; ++n) list[n] = 1.0 / static_cast<double>(n + 1);
  return list;
}();

/// int_0^T exp(z s) ds from `end` = exp(z T).
Complex integral(Complex z, Complex end, double duration) {
  const Complex w = z * duration;
  if (std::norm(w) > 0.25) return (end - 1.0) / z;
  if (w == 0.0) return duration;
  // T sum w^n/(n + 1)!: for |w| <= 1/2 the fourteenth term is below rounding.
  Complex sum = 1.0;
  for (std::size_t n = series_terms; n > 0; --n) sum = 1.0 + sum * (w * reciprocals[n]);
  return duration * sum;
}

/// Exponents of an element: one, or the two of a chain.
struct Nodes {
  Complex first;
  Complex second;
  bool is_pair = false;

  [[nodiscard]] bool is_real() const { return first.imag() == 0.0 && second.imag() == 0.0; }
};

Nodes nodes_of(const core::ExponentialBasis& basis, int k, bool conjugate) {
  Nodes nodes{.first = basis.exponent(k)};
  if (basis.parent(k) != core::ExponentialBasis::no_parent) {
    nodes.is_pair = true;
    nodes.second = basis.exponent(basis.parent(k));
  }
  if (conjugate) nodes = {std::conj(nodes.first), std::conj(nodes.second), nodes.is_pair};
  return nodes;
}

/// int_0^T E F ds of elements one of which is a divided difference. Let g(z) = int_0^T exp(z s) ds, which is a
/// divided difference of exp over zero and z. The integral is the divided difference of g(x + y) over the nodes of
/// both.
Complex integral_with_chain(const Nodes& e, const Nodes& f, double duration) {
  const auto over = [&](Complex a, Complex b, Complex c) {
    const std::array<Complex, 4> nodes = {0.0, a, b, c};
    return core::divided_exponential(nodes, duration);
  };
  if (e.is_pair && f.is_pair) {
    const Complex low = e.first + f.first;
    const Complex high = e.second + f.second;
    return over(low, e.second + f.first, high) + over(low, e.first + f.second, high);
  }
  const Nodes& pair = e.is_pair ? e : f;
  const Complex plain = e.is_pair ? f.first : e.first;
  const std::array<Complex, 3> nodes = {0.0, pair.first + plain, pair.second + plain};
  return core::divided_exponential(nodes, duration);
}

Complex coefficient(const ModeFunction& f, std::size_t k) { return {f.re[k], f.im[k]}; }

}  // namespace

bool ClosedForm::covers(const core::ExponentialBasis& basis) {
  if (static_cast<std::size_t>(basis.size()) > largest) return false;
  for (int k = 0; basis.has_chains() && k < basis.size(); ++k) {
    const int parent = basis.parent(k);
    if (parent != core::ExponentialBasis::no_parent && basis.parent(parent) != core::ExponentialBasis::no_parent)
      return false;
  }
  return true;
}

double ClosedForm::terms(const core::ModeFunction& f) const {
  double sum = 0.0;
  for (int k = 0; k < basis->size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (!core::takes_part(f, i)) continue;
    const double begin = basis->parent(k) == core::ExponentialBasis::no_parent ? 1.0 : 0.0;
    sum += std::hypot(f.re[i], f.im[i]) * std::max(begin, std::hypot(end.re[i], end.im[i]));
  }
  return sum;
}

ClosedIntegrals::ClosedIntegrals(const ClosedForm& form)
    : form_(form), size_(static_cast<std::size_t>(form.basis->size())) {
  if (!ClosedForm::covers(*form.basis)) throw std::length_error("too many exponentials for a closed form");
  for (std::size_t j = 0; j < size_; ++j) {
    for (std::size_t k = j; k < size_; ++k) {
      if (form.basis->has_chains() && (is_chain(j) || is_chain(k))) {
        set_with_chain(j, k);
        continue;
      }
      const Complex first = form.basis->exponent(static_cast<int>(j));
      const Complex second = form.basis->exponent(static_cast<int>(k));
      plain_[pair(j, k)] = integral(first + second, end(j) * end(k), form.duration);
      conjugate_[pair(j, k)] = integral(first + std::conj(second), end(j) * std::conj(end(k)), form.duration);
    }
  }
}

/// Sets int E_j E_k and int E_j conj(E_k); if an element is real, one follows from the other.
void ClosedIntegrals::set_with_chain(std::size_t j, std::size_t k) {
  const Nodes first = nodes_of(*form_.basis, static_cast<int>(j), false);
  const Nodes second = nodes_of(*form_.basis, static_cast<int>(k), false);
  const Complex plain = integral_with_chain(first, second, form_.duration);
  plain_[pair(j, k)] = plain;
  if (second.is_real()) {
    conjugate_[pair(j, k)] = plain;
  } else if (first.is_real()) {
    conjugate_[pair(j, k)] = std::conj(plain);
  } else {
    conjugate_[pair(j, k)] =
        integral_with_chain(first, nodes_of(*form_.basis, static_cast<int>(k), true), form_.duration);
  }
}

double ClosedIntegrals::product(const ModeFunction& f, const ModeFunction& g) const {
  if (form_.basis->grows()) return product_with_growth(f, g);
  double sum = 0.0;
  for (std::size_t j = 0; j < size_; ++j) {
    const Complex fj = coefficient(f, j);
    const Complex gj = coefficient(g, j);
    sum += (fj * gj * plain_[pair(j, j)] + fj * std::conj(gj) * conjugate_[pair(j, j)]).real();
    for (std::size_t k = j + 1; k < size_; ++k) {
      const Complex fk = coefficient(f, k);
      const Complex gk = coefficient(g, k);
      sum += ((fj * gk + fk * gj) * plain_[pair(j, k)] +
              (fj * std::conj(gk) + gj * std::conj(fk)) * conjugate_[pair(j, k)])
                 .real();
    }
  }
  return 0.5 * sum;
}

/// Elements that have left the range of double precision count only if a function contains them.
double ClosedIntegrals::product_with_growth(const ModeFunction& f, const ModeFunction& g) const {
  double sum = 0.0;
  for (std::size_t j = 0; j < size_; ++j) {
    for (std::size_t k = 0; k < size_; ++k) {
      if (!core::takes_part(f, j) || !core::takes_part(g, k)) continue;
      const Complex gk = coefficient(g, k);
      const std::size_t at = pair(std::min(j, k), std::max(j, k));
      const Complex conjugate = j <= k ? conjugate_[at] : std::conj(conjugate_[at]);
      sum += (coefficient(f, j) * (gk * plain_[at] + std::conj(gk) * conjugate)).real();
    }
  }
  return 0.5 * sum;
}

Complex integral_against_turn(const ClosedForm& form, const ModeFunction& f, double omega) {
  const Complex shift(0.0, omega);
  const Complex turn = std::polar(1.0, -omega * form.duration);
  Complex sum = 0.0;
  for (int element = 0; element < form.basis->size(); ++element) {
    const auto k = static_cast<std::size_t>(element);
    const Complex c = coefficient(f, k);
    if (c == 0.0) continue;
    const Nodes nodes = nodes_of(*form.basis, element, false);
    if (nodes.is_pair) {
      const Nodes mirrored = nodes_of(*form.basis, element, true);
      sum += c * integral_with_chain(nodes, {.first = -shift}, form.duration) +
             std::conj(c) * integral_with_chain(mirrored, {.first = -shift}, form.duration);
      continue;
    }
    const Complex end(form.end.re[k], form.end.im[k]);
    sum += c * integral(nodes.first - shift, end * turn, form.duration) +
           std::conj(c) * integral(std::conj(nodes.first) - shift, std::conj(end) * turn, form.duration);
  }
  return 0.5 * sum;
}

}  // namespace dualdamp::sim
