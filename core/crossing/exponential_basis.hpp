#pragma once
/// The exponentials of which every quantity of one mode is a sum.
///
/// Within a mode the oscillator is linear with constant coefficients, so position, velocity and every guard are
///
///     f(s) = Re sum_k c_k E_k(s),      s = time since the mode began [s],
///
/// on one small set of complex functions that obey  E_k' = z_k E_k + E_parent(k):
///   * without a parent   E_k = exp(z_k s), E_k(0) = 1;
///   * with a parent      E_k = the divided difference of z -> exp(z s) at z_k and the exponents of its ancestors,
///                        E_k(0) = 0.
/// Chains represent what plain exponentials cannot: powers of s (all exponents 0), critical damping, resonance
/// without damping, a vanishing stiffness. They stay accurate if two exponents nearly coincide, because the two
/// exponentials are never subtracted (opitz1964; mccurdy1984 for the evaluation).
/// The set is closed under addition, scaling and differentiation.
///
/// A basis may have any number of elements. An element that grows may leave the range of double precision; it then
/// counts only in sums in which its coefficient is not zero.
///
/// Cost: one exp and one sincos for each plain element; a chain costs some tens of flops more. Cheaper are powers
/// of s (chains of zeros), and one chain on two exponents and zeros for times that are short for both
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

  /// Appends exp(exponent s), or a divided difference whose chain goes on from `parent`. Returns the index of the
  /// element. Throws std::length_error if the chain becomes too long.
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

  /// Changes E_k(s) to E_k(s + delta), exact to rounding, for |z_k delta| < 0.1. Returns false and leaves `values`
  /// as they are if delta is larger or the basis has chains.
  [[nodiscard]] bool shift(double delta, Values& values) const;

  /// The width [s] of a search panel that suits the fastest element. In a basis without chains step_panel() takes
  /// E_k(s) to E_k(s + panel()) by one complex product for each element.
  [[nodiscard]] double panel() const { return panel_; }
  /// Largest |z_k| [1/s].
  [[nodiscard]] double fastest() const { return fastest_; }
  /// The largest |Im z| or growth [1/s]: rounding of z s is an error of eps turning() s of an element's modulus.
  [[nodiscard]] double turning() const { return turning_; }
  void step_panel(const Values& from, Values& to) const;
  /// E_k(panel()), for a basis without chains.
  [[nodiscard]] const Values& over_panel() const { return rotor_; }

  /// Sets the width of the panel and finds the quick ways to evaluate; call once after the last add(). `expected`:
  /// the time [s] after which a guard that starts at zero most likely crosses, 0 for none. It saves work of the
  /// search and does not affect what the search proves.
  void finish(double expected = 0.0);
  /// `expected` of finish() on an even basis, else 0; and E_k at that time.
  [[nodiscard]] double expected() const { return expected_; }
  [[nodiscard]] const Values& at_expected() const { return expected_values_; }

  /// No chain, no growing element, and all nonzero exponents within a factor of four: one panel width and one
  /// derivative bound serve the whole mode.
  [[nodiscard]] bool even() const { return even_; }

  /// |z_k|^2, for derivative bounds.
  [[nodiscard]] double square(int k) const { return square_[index(k)]; }
  /// |z_k/fastest()|^2: powers of it stay in range.
  [[nodiscard]] double relative_square(int k) const { return relative_square_[index(k)]; }
  /// max(0, Re z_k): the rate at which the element can grow [1/s].
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
  std::vector<int> power_;        ///< n of s^n/n!; 0 for other elements
  std::vector<int> short_order_;  ///< in the short chain: 0 for exp(a s), m for G_m; else -1
  ShortChain short_chain_;
  double short_rate_ =
      std::numeric_limits<double>::infinity();  ///< the short chain is used while this times s is at most 1 [1/s]
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

/// Coefficients of one quantity on a basis; only the first size() entries are used.
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

/// Copies the entries that are used.
inline void copy(const ExponentialBasis& basis, const ExponentialBasis::Values& from,
                 ExponentialBasis::Values& to) {
  to.fit(static_cast<std::size_t>(basis.size()));
  for (int k = 0; k < basis.size(); ++k) {
    const auto i = static_cast<std::size_t>(k);
    to.re[i] = from.re[i];
    to.im[i] = from.im[i];
  }
}

/// df/ds on the same basis; f and the derivative must be two objects. E_k' contains one E_parent, so the child's
/// coefficient is added to that of its parent; parents stand before their children.
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

/// Whether the coefficient of element k in f differs from zero.
[[nodiscard]] inline bool takes_part(const ModeFunction& f, std::size_t k) {
  return f.re[k] != 0.0 || f.im[k] != 0.0;
}

/// The sum of `evaluate` over the elements that take part.
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

/// An upper bound of |re + i im|, sharp unless the squares underflow. std::abs of a complex number is sharp in that
/// case too, but costs more than the rest of a bound.
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
