#pragma once
/// The exponentials that every quantity of one mode is made of.
///
/// Inside a mode the oscillator is linear with constant coefficients, so position, velocity and every guard are
///
///     f(s) = Re sum_k c_k E_k(s),      s = time since the mode began [s],
///
/// on one small set of complex functions that obey  E_k' = z_k E_k + E_parent(k):
///   * without a parent   E_k = exp(z_k s), E_k(0) = 1;
///   * with a parent      E_k = the divided difference of z -> exp(z s) at z_k and the exponents of its ancestors,
///                        E_k(0) = 0.
/// Chains cover what plain exponentials cannot: powers of s (all exponents 0), critical damping, resonance without
/// damping, a vanishing stiffness; and they stay accurate where two exponents nearly coincide, because the two
/// exponentials are never subtracted (opitz1964; mccurdy1984 for the evaluation).
/// The set is closed under addition, scaling and differentiation.
///
/// Any number of elements. Where some of them grow, one that has left the range of double precision has no part in
/// a sum unless its coefficient differs from zero.
///
/// Cost: one exp and one sincos a plain element; a chain costs some tens of flops more. Less: powers of s (chains
/// of zeros), and one chain on two exponents and zeros for times that are short beside both
/// (`core/crossing/short_chain.hpp`). No allocation for functions on up to 40 elements
/// (`core/crossing/element_numbers.hpp`).

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "core/crossing/element_numbers.hpp"
#include "core/crossing/short_chain.hpp"

namespace dualdamp::core {

using Complex = std::complex<double>;

class ExponentialBasis {
 public:
  static constexpr int no_parent = -1;

  /// One complex number for each element.
  struct Values : ElementNumbers {};

  /// Appends exp(exponent s), or a divided difference on top of `parent`; returns its index. Throws
  /// std::length_error where a chain becomes too long.
  int add(Complex exponent, int parent = no_parent);

  [[nodiscard]] int size() const { return size_; }
  [[nodiscard]] Complex exponent(int k) const { return {re_[index(k)], im_[index(k)]}; }
  [[nodiscard]] int parent(int k) const { return parent_[index(k)]; }
  [[nodiscard]] bool has_chains() const { return has_chains_; }
  /// Whether an element has an exponent with a positive real part.
  [[nodiscard]] bool grows() const { return grows_; }

  /// E_k(0) for all k.
  void start(Values& values) const;
  /// E_k(s) for all k; s >= 0.
  void evaluate(double s, Values& values) const;

  /// E_k(s + delta) from E_k(s), exact to rounding, for |z_k delta| < 0.1.
  /// Returns false, values untouched, when delta is larger or the basis has chains.
  [[nodiscard]] bool shift(double delta, Values& values) const;

  /// The width [s] of a search panel that suits the fastest element, and the step over it:
  /// E_k(s + panel()) from E_k(s) by one complex product each. For a basis without chains.
  [[nodiscard]] double panel() const { return panel_; }
  /// Largest |z_k| [1/s].
  [[nodiscard]] double fastest() const { return fastest_; }
  /// The largest |Im z| or growth: rounding of z s costs eps turning() s of an element's modulus.
  [[nodiscard]] double turning() const { return turning_; }
  void step_panel(const Values& from, Values& to) const;
  /// E_k(panel()), likewise.
  [[nodiscard]] const Values& over_panel() const { return rotor_; }

  /// Fixes the panel and finds the quick ways to evaluate; call once after the last add(). `expected`: the time [s]
  /// after which a guard that starts at zero most likely crosses, 0 for none. It saves the search work and has no
  /// part in what the search proves.
  void finish(double expected = 0.0);
  /// That time on an even basis, else 0; and E_k there.
  [[nodiscard]] double expected() const { return expected_; }
  [[nodiscard]] const Values& at_expected() const { return expected_values_; }

  /// No chain, no growing element, and all nonzero exponents within a factor of four: one panel width and one
  /// derivative bound serve the whole mode.
  [[nodiscard]] bool even() const { return even_; }

  /// |z_k|^2, for derivative bounds.
  [[nodiscard]] double square(int k) const { return square_[index(k)]; }
  /// |z_k/fastest()|^2: powers of it stay in range.
  [[nodiscard]] double relative_square(int k) const { return relative_square_[index(k)]; }
  /// max(0, Re z_k): how fast the element can grow [1/s].
  [[nodiscard]] double growth(int k) const { return re_[index(k)] > 0.0 ? re_[index(k)] : 0.0; }

 private:
  static std::size_t index(int k) { return static_cast<std::size_t>(k); }
  [[nodiscard]] Complex chain_value(int k, double s) const;
  void find_powers();
  void find_short_chain();

  std::vector<double> re_;
  std::vector<double> im_;
  std::vector<int> parent_;
  std::vector<double> square_;
  std::vector<double> relative_square_;
  std::vector<int> power_;        ///< n of s^n/n!, 0 for all else
  std::vector<int> short_order_;  ///< in the short chain: 0 of exp(a s), m of G_m; else -1
  ShortChain short_chain_;
  double short_rate_ =
      std::numeric_limits<double>::infinity();  ///< it serves while this times s is at most 1 [1/s]
  Values rotor_;
  Values expected_values_;
  double panel_ = 0.0;
  double expected_ = 0.0;
  double fastest_ = 0.0;
  double turning_ = 0.0;
  int size_ = 0;
  bool has_chains_ = false;
  bool grows_ = false;
  bool even_ = false;
};

/// Coefficients of one quantity on a basis; the first size() entries count.
struct ModeFunction : ElementNumbers {};

/// f = factor g.
inline void assign(const ExponentialBasis& basis, double factor, const ModeFunction& g, ModeFunction& f) {
  f.fit(static_cast<std::size_t>(basis.size()));
  for (int k = 0; k < basis.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    f.re[i] = factor * g.re[i];
    f.im[i] = factor * g.im[i];
  }
}

/// f += factor g.
inline void accumulate(const ExponentialBasis& basis, double factor, const ModeFunction& g, ModeFunction& f) {
  for (int k = 0; k < basis.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    f.re[i] += factor * g.re[i];
    f.im[i] += factor * g.im[i];
  }
}

/// f = 0.
inline void clear(const ExponentialBasis& basis, ModeFunction& f) {
  f.fit(static_cast<std::size_t>(basis.size()));
  for (int k = 0; k < basis.size(); ++k)
    f.re[static_cast<std::size_t>(k)] = f.im[static_cast<std::size_t>(k)] = 0.0;
}

/// Copies the entries that count.
inline void copy(const ExponentialBasis& basis, const ExponentialBasis::Values& from,
                 ExponentialBasis::Values& to) {
  to.fit(static_cast<std::size_t>(basis.size()));
  for (int k = 0; k < basis.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    to.re[i] = from.re[i];
    to.im[i] = from.im[i];
  }
}

/// df/ds on the same basis; not in place. E_k' holds one E_parent, so a parent's coefficient gains its child's;
/// parents stand before their children.
inline void differentiate(const ExponentialBasis& basis, const ModeFunction& f, ModeFunction& derivative) {
  derivative.fit(static_cast<std::size_t>(basis.size()));
  for (int k = 0; k < basis.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Complex z = basis.exponent(k);
    derivative.re[i] = f.re[i] * z.real() - f.im[i] * z.imag();
    derivative.im[i] = f.re[i] * z.imag() + f.im[i] * z.real();
    if (basis.parent(k) != ExponentialBasis::no_parent) {
      const auto p = static_cast<std::size_t>(basis.parent(k));
      derivative.re[p] += f.re[i];
      derivative.im[p] += f.im[i];
    }
  }
}

/// Whether element k has a part in f.
[[nodiscard]] inline bool takes_part(const ModeFunction& f, std::size_t k) {
  return f.re[k] != 0.0 || f.im[k] != 0.0;
}

/// The sum of `evaluate` without elements that take no part.
[[nodiscard]] double evaluate_with_growth(const ExponentialBasis& basis, const ModeFunction& f,
                                          const ExponentialBasis::Values& values);

/// Re sum c_k E_k for values of the elements.
[[nodiscard]] inline double evaluate(const ExponentialBasis& basis, const ModeFunction& f,
                                     const ExponentialBasis::Values& values) {
  if (basis.grows()) [[unlikely]]
    return evaluate_with_growth(basis, f, values);
  double sum = 0.0;
  for (int k = 0; k < basis.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    sum += f.re[i] * values.re[i] - f.im[i] * values.im[i];
  }
  return sum;
}

/// f(0): the plain elements' coefficients summed.
[[nodiscard]] inline double at_start(const ExponentialBasis& basis, const ModeFunction& f) {
  double sum = 0.0;
  for (int k = 0; k < basis.size(); ++k) {
    if (basis.parent(k) == ExponentialBasis::no_parent) sum += f.re[static_cast<std::size_t>(k)];
  }
  return sum;
}

/// An upper bound of |re + i im|, sharp but where squares get lost. std::abs of a complex number is sharp there
/// too, but costs more than the rest of a bound.
[[nodiscard]] inline double modulus_bound(double re, double im) {
  const double square = re * re + im * im;
  return square > 1e-290 && square < 1e300 ? std::sqrt(square) : std::abs(re) + std::abs(im);
}

/// Bounds of max |E_k| over [begin, begin + width] in `bounds.re`; `values` = E_k(begin).
void bound_elements(const ExponentialBasis& basis, const ExponentialBasis::Values& values, double begin,
                    double width, ElementNumbers& bounds);

/// sum |c_k| bounds_k.
[[nodiscard]] double bound(const ExponentialBasis& basis, const ModeFunction& f, const ElementNumbers& bounds);

/// sum |c_k| max |E_k| over [begin, begin + width], a bound of |f| there; `values` = E_k(begin).
[[nodiscard]] double bound(const ExponentialBasis& basis, const ModeFunction& f,
                           const ExponentialBasis::Values& values, double begin, double width);

}  // namespace dualdamp::core
