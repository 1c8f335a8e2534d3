#pragma once
/// LU factors with partial pivoting for the matrices of the implicit stepper. Most have two to four rows; for these
/// the size is a template argument (docs/decisions/016-radau-with-five-stages.md).

#include <array>
#include <complex>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace dualdamp::sim {

/// The template argument for a size that is known only at run time.
constexpr std::size_t any_size = 0;

/// A size as a function object: a constant for N > 0, else the number it was given.
template <std::size_t N>
struct Extent {
  constexpr std::size_t operator()() const { return N; }
};
template <>
struct Extent<any_size> {
  std::size_t size = 0;
  std::size_t operator()() const { return size; }
};
template <std::size_t N>
Extent<N> extent(std::size_t size) {
  if constexpr (N == any_size)
    return {size};
  else
    return {};
}

/// Without the checks for infinite parts that std::complex makes in each product and quotient.
inline double product(double a, double b) { return a * b; }
inline std::complex<double> product(std::complex<double> a, std::complex<double> b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}
inline double reciprocal(double a) { return 1.0 / a; }
inline std::complex<double> reciprocal(std::complex<double> a) { return std::conj(a) / std::norm(a); }

template <class Scalar, std::size_t N>
class LuFactors {
 public:
  explicit LuFactors(std::size_t n = N) : n_(extent<N>(n)) {
    if constexpr (N == any_size) {
      entries_.resize(n * n);
      pivots_.resize(n);
    }
  }

  /// Factors of shift I - matrix; `matrix` is given column by column. The factors of a singular matrix are not
  /// finite.
  void compute(Scalar shift, std::span<const double> matrix) {
    for (std::size_t k = 0; k < n_() * n_(); ++k) entries_[k] = -matrix[k];
    for (std::size_t k = 0; k < n_(); ++k) column(k)[k] += shift;
    for (std::size_t k = 0; k < n_(); ++k) eliminate(k);
  }

  /// Replaces b by the solution.
  void solve(Scalar* b) const {
    for (std::size_t k = 0; k < n_(); ++k) std::swap(b[k], b[pivots_[k]]);
    for (std::size_t k = 0; k < n_(); ++k)
      for (std::size_t i = k + 1; i < n_(); ++i) b[i] -= product(column(k)[i], b[k]);
    for (std::size_t k = n_(); k-- > 0;) {
      b[k] = product(b[k], column(k)[k]);
      for (std::size_t i = 0; i < k; ++i) b[i] -= product(column(k)[i], b[k]);
    }
  }

 private:
  [[nodiscard]] Scalar* column(std::size_t k) { return entries_.data() + k * n_(); }
  [[nodiscard]] const Scalar* column(std::size_t k) const { return entries_.data() + k * n_(); }

  /// The diagonal holds the reciprocals of the pivots.
  void eliminate(std::size_t k) {
    Scalar* const pivoted = column(k);
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n_(); ++i)
      if (std::norm(pivoted[i]) > std::norm(pivoted[pivot])) pivot = i;
    pivots_[k] = pivot;
    if (pivot != k)
      for (std::size_t j = 0; j < n_(); ++j) std::swap(column(j)[k], column(j)[pivot]);
    pivoted[k] = reciprocal(pivoted[k]);
    for (std::size_t i = k + 1; i < n_(); ++i) pivoted[i] = product(pivoted[i], pivoted[k]);
    for (std::size_t j = k + 1; j < n_(); ++j) {
      Scalar* const other = column(j);
      for (std::size_t i = k + 1; i < n_(); ++i) other[i] -= product(pivoted[i], other[k]);
    }
  }

  Extent<N> n_;
  std::conditional_t<N == any_size, std::vector<Scalar>, std::array<Scalar, N * N>> entries_{};
  std::conditional_t<N == any_size, std::vector<std::size_t>, std::array<std::size_t, N>> pivots_{};
};

}  // namespace dualdamp::sim
