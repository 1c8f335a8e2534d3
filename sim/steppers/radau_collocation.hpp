#pragma once
/// Radau IIA with s stages as collocation at the Radau points c_i of (0, 1] (hairer1996, IV.5 and IV.8).
///
/// The motion of a step of length h is x + u(c) at t + c h, where u is the polynomial of degree s with u(0) = 0 and
/// u'(c_i) = h f(x + u(c_i), t + c_i h). It is kept as its values z_i = u(c_i). Order 2s - 1 at the end of the
/// step, where c_s = 1, and s inside it. The coefficients are computed, not copied from a table.

#include <array>
#include <complex>
#include <cstddef>

namespace dualdamp::sim {

inline constexpr std::size_t radau_stages = 5;

struct RadauCollocation {
  static constexpr std::size_t stages = radau_stages;
  static constexpr std::size_t pairs = stages / 2;  ///< of complex eigenvalues; the remaining one is real
  static_assert(stages % 2 == 1);
  using Row = std::array<double, stages>;
  using Matrix = std::array<Row, stages>;

  RadauCollocation();

  /// The coefficients, computed at the first call.
  static const RadauCollocation& once();

  /// u(c) = sum_j basis(c)_j z_j.
  [[nodiscard]] Row basis(double c) const;

  Row nodes{};
  Row scale{};        ///< basis(c)_j = scale_j c prod_(k != j) (c - c_k)
  Row start_slope{};  ///< u'(0) = sum_j start_slope_j z_j
  Matrix slopes{};    ///< u'(c_i) = sum_j slopes_ij z_j: the inverse of Butcher's matrix

  /// slopes = to_stages D from_stages. D multiplies the first row by the real eigenvalue. It reads each following
  /// pair of rows as real and imaginary part of one row, and multiplies this by one eigenvalue of a pair. Ten
  /// digits or more are correct, which is enough for an iteration.
  double real_eigenvalue = 0.0;
  std::array<std::complex<double>, pairs> eigenvalues{};
  Matrix from_stages{};
  Matrix to_stages{};

 private:
  void differentiate();
  void diagonalise();
};

}  // namespace dualdamp::sim
