#include "sim/engine/closed_form.hpp"

#include <cassert>
#include <cmath>

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
  // T sum w^n/(n + 1)!: behind |w| = 1/2 the fourteenth term has sunk below rounding.
  Complex sum = 1.0;
  for (std::size_t n = series_terms; n > 0; --n) sum = 1.0 + sum * (w * reciprocals[n]);
  return duration * sum;
}

Complex coefficient(const ModeFunction& f, std::size_t k) { return {f.re[k], f.im[k]}; }

}  // namespace

ClosedIntegrals::ClosedIntegrals(const ClosedForm& form)
    : form_(form), size_(static_cast<std::size_t>(form.basis->size())) {
  assert(ClosedForm::covers(*form.basis));
  for (std::size_t j = 0; j < size_; ++j) {
    const Complex first = form.basis->exponent(static_cast<int>(j));
    for (std::size_t k = j; k < size_; ++k) {
      const Complex second = form.basis->exponent(static_cast<int>(k));
      plain_[pair(j, k)] = integral(first + second, end(j) * end(k), form.duration);
      conjugate_[pair(j, k)] = integral(first + std::conj(second), end(j) * std::conj(end(k)), form.duration);
    }
  }
}

double ClosedIntegrals::product(const ModeFunction& f, const ModeFunction& g) const {
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

Complex integral_against_turn(const ClosedForm& form, const ModeFunction& f, double omega) {
  const Complex shift(0.0, omega);
  const Complex turn = std::polar(1.0, -omega * form.duration);
  Complex sum = 0.0;
  for (int element = 0; element < form.basis->size(); ++element) {
    const auto k = static_cast<std::size_t>(element);
    const Complex c = coefficient(f, k);
    if (c == 0.0) continue;
    const Complex z = form.basis->exponent(element);
    const Complex end(form.end.re[k], form.end.im[k]);
    sum += c * integral(z - shift, end * turn, form.duration) +
           std::conj(c) * integral(std::conj(z) - shift, std::conj(end) * turn, form.duration);
  }
  return 0.5 * sum;
}

}  // namespace dualdamp::sim
