#include "identify/ledger/amplitude_noise.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "core/constants.hpp"
#include "identify/record.hpp"
#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

Eigen::Index smooth_columns(bool several_frequencies, std::size_t states) {
  constexpr std::size_t many = 8;
  return !several_frequencies ? 3 : states < many ? 4 : 6;
}

namespace {

/// 1, 1/x, x at one frequency; r, r^2 and x^2 as well at several. Few states at several frequencies: 1, 1/x, r,
/// r^2, which plain friction needs whatever the constants are.
Eigen::MatrixXd curves(const std::vector<SteadyPoint>& points) {
  const bool several = std::ranges::any_of(
      points, [&](const SteadyPoint& point) { return !is_same_frequency(point.r, points.front().r); });
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(points.size()), smooth_columns(several, points.size()));
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    const auto& [Y, x, phase, r, sweep, number] = points[static_cast<std::size_t>(i)];
    const double s = r - 1.0;
    const std::array<double, 6> all{1.0, 1.0 / x, x, s, s * s, x * x};
    const std::array<double, 4> needed{1.0, 1.0 / x, s, s * s};
    for (Eigen::Index j = 0; j < columns.cols(); ++j)
      columns(i, j) = columns.cols() == 4 ? needed[static_cast<std::size_t>(j)] : all[static_cast<std::size_t>(j)];
  }
  return columns;
}

}  // namespace

Deviations largest_deviations(const std::vector<SteadyPoint>& points) {
  constexpr double margin = 4.0;
  std::vector<SteadyPoint> with_phase;
  std::ranges::copy_if(points, std::back_inserter(with_phase),
                       [](const SteadyPoint& point) { return !std::isnan(point.phase); });
  if (with_phase.empty()) return {core::infinity, core::infinity, core::infinity};
  const Eigen::MatrixXd columns = curves(with_phase);
  const Eigen::Index freedom = columns.rows() - columns.cols();
  if (freedom < 2) return {core::infinity, core::infinity, core::infinity};
  Eigen::VectorXcd drive(columns.rows());
  for (Eigen::Index i = 0; i < drive.size(); ++i) {
    const SteadyPoint& point = with_phase[static_cast<std::size_t>(i)];
    drive[i] = std::polar(point.Y / point.x, point.phase);
  }
  const Eigen::VectorXd real = drive.real();
  const Eigen::VectorXd imaginary = drive.imag();
  const Eigen::VectorXd left_real = left_beside(columns, real);
  const Eigen::VectorXd left_imaginary = left_beside(columns, imaginary);
  Deviations squares{0.0, 0.0, 0.0};
  for (Eigen::Index i = 0; i < drive.size(); ++i) {
    const SteadyPoint& point = with_phase[static_cast<std::size_t>(i)];
    const std::complex<double> relative = std::complex<double>(left_real[i], left_imaginary[i]) / drive[i];
    squares.x += std::pow(relative.real() * point.x, 2);
    squares.Y += std::pow(relative.real() * point.Y, 2);
    squares.phase += std::pow(relative.imag(), 2);
  }
  const auto largest = [&](double sum) { return margin * std::sqrt(sum / static_cast<double>(freedom)); };
  return {largest(squares.x), largest(squares.Y), largest(squares.phase)};
}

double mean_ratio(const std::vector<SteadyPoint>& points) {
  double Y = 0.0;
  double x = 0.0;
  for (const SteadyPoint& point : points) {
    Y += point.Y;
    x += point.x;
  }
  return Y / x;
}

void limit(Deviations& deviations, const Deviations& largest) {
  const double excess = std::max(deviations.x / largest.x, deviations.Y / largest.Y);
  if (excess > 1.0) deviations.x /= excess, deviations.Y /= excess;
  deviations.phase = std::min(deviations.phase, largest.phase);
}

}  // namespace dualdamp::identify
