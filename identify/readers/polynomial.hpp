#pragma once
/// The polynomial through a few points, in Lagrange's form.

#include <array>
#include <cstddef>

namespace dualdamp::identify {

/// The value at `at` of the polynomial of degree N - 1 through the points (t_i, x_i).
template <std::size_t N>
[[nodiscard]] double polynomial(const std::array<double, N>& t, const std::array<double, N>& x, double at) {
  double value = 0.0;
  for (std::size_t i = 0; i < N; ++i) {
    double weight = 1.0;
    for (std::size_t k = 0; k < N; ++k)
      if (k != i) weight *= (at - t[k]) / (t[i] - t[k]);
    value += weight * x[i];
  }
  return value;
}

}  // namespace dualdamp::identify
