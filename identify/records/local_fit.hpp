#pragma once
/// A fit of a few samples about a place, with columns of the caller's choice.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

/// Of a signal about one of its samples.
struct LocalFit {
  double value = 0.0;  ///< at the centre
  double std = 0.0;
  double sum_of_squares = 0.0;
  double slope = 0.0;  ///< the second coefficient
  double slope_std = 0.0;
};

/// Least squares on samples [first, last) over u = (i - centre)/width. `fill(u, row)` writes the columns; the first
/// column must be 1.
template <typename Fill>
LocalFit local_fit(std::span<const double> x, std::size_t first, std::size_t last, double centre, double width,
                   Eigen::Index columns, Fill fill) {
  const auto n = static_cast<Eigen::Index>(last - first);
  Eigen::MatrixXd design(n, columns);
  Eigen::VectorXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::size_t sample = first + static_cast<std::size_t>(i);
    fill((static_cast<double>(sample) - centre) / width, design.row(i));
    values(i) = x[sample];
  }
  const LinearFit found = linear_fit(design, values);
  LocalFit fit;
  fit.value = found.coefficients(0);
  fit.slope = found.coefficients(1);
  fit.sum_of_squares = (values - design * found.coefficients).squaredNorm();
  const double variance = fit.sum_of_squares / static_cast<double>(std::max<Eigen::Index>(n - columns - 1, 1));
  fit.std = std::sqrt(variance) * found.deviations(0);
  fit.slope_std = std::sqrt(variance) * found.deviations(1);
  return fit;
}

}  // namespace dualdamp::identify
