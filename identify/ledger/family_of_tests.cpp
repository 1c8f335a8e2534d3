#include "identify/ledger/family_of_tests.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/constants.hpp"
#include "core/random.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/ties.hpp"

namespace dualdamp::identify {

namespace {

/// Unit columns in at most `most` coordinates of what they span, a row each: Cholesky's decomposition of their
/// products. Unlike the vectors of a QR decomposition these coordinates do not depend on the order of the rows of
/// the columns, and the draws that are made along them do not either. The column that tells most of all others
/// comes next, so that few coordinates hold nearly all, and of those equal but for rounding the first.
Eigen::MatrixXd coordinates_of(const Eigen::MatrixXd& unit, Eigen::Index most) {
  constexpr double dependent = 1e-8;  // of the square of a length
  const Eigen::Index count = unit.cols();
  Eigen::MatrixXd left = gram(unit);
  Eigen::MatrixXd coordinates = Eigen::MatrixXd::Zero(count, std::min(count, most));
  Eigen::Index rank = 0;
  for (; rank < coordinates.cols(); ++rank) {
    Eigen::Index pivot = 0;
    double best = 0.0;
    for (Eigen::Index j = 0; j < count; ++j) {
      const double told = left(j, j) > dependent ? left.col(j).squaredNorm() / left(j, j) : 0.0;
      if (told <= best || is_tie(told, best)) continue;
      pivot = j;
      best = told;
    }
    if (best == 0.0) break;
    coordinates.col(rank) = left.col(pivot) / std::sqrt(left(pivot, pivot));
    left -= coordinates.col(rank) * coordinates.col(rank).transpose();
  }
  // What is left of a column beyond these coordinates does not make its statistic smaller.
  coordinates.conservativeResize(count, rank);
  for (Eigen::Index j = 0; j < count; ++j) coordinates.row(j).normalize();  // zero stays zero
  return coordinates;
}

/// t statistics of unit columns beside residuals with `freedom`.
Eigen::VectorXd statistics_of(const Eigen::VectorXd& along, double squares, double freedom) {
  return along.array() / variances_beside(along, squares, freedom).sqrt();
}

}  // namespace

Eigen::ArrayXd variances_beside(const Eigen::VectorXd& along, double squares, double freedom) {
  return (squares - along.array().square()).max(1e-12 * squares) / (freedom - 1.0);
}

double two_sided_p_value(double t, double freedom) { return f_test_p_value(t * t, 1.0, freedom); }

FamilyOfTests::FamilyOfTests(FamilySetting setting) : setting_(std::move(setting)) { draw(); }

double FamilyOfTests::score(Eigen::Index j, double t) const {
  const double freedom = setting_.freedom;
  return freedom * std::log1p(t * t / (freedom - 1.0)) + 2.0 * std::log(setting_.weights[j]);
}

double FamilyOfTests::t_for(Eigen::Index j, double score) const {
  const double gain = std::max(0.0, score - 2.0 * std::log(setting_.weights[j]));
  return std::sqrt((setting_.freedom - 1.0) * std::expm1(gain / setting_.freedom));
}

double FamilyOfTests::largest_score(const Eigen::VectorXd& t) const {
  double most = -core::infinity;
  for (Eigen::Index j = 0; j < t.size(); ++j) {
    const int sign = setting_.signs[static_cast<std::size_t>(j)];
    if (sign == 0 || sign * t[j] > 0.0) most = std::max(most, score(j, t[j]));
  }
  return most;
}

void FamilyOfTests::draw() {
  constexpr std::size_t draws = 2000;
  const Eigen::MatrixXd coordinates = coordinates_of(setting_.unit, static_cast<Eigen::Index>(setting_.freedom));
  const Eigen::Index rank = coordinates.cols();
  const double beside = std::max(0.0, setting_.freedom - static_cast<double>(rank));
  // A fixed seed, so that a record has the same p-values each time.
  constexpr core::RandomStream stream{20261122, 1};
  std::uint64_t drawn = 0;
  largest_.reserve(draws);
  Eigen::VectorXd z(rank);
  for (std::size_t i = 0; i < draws; ++i) {
    for (double& value : z) value = stream.normal(drawn++);
    double squares = z.squaredNorm();
    // Chi-square of the residuals outside the span of the columns, by Wilson and Hilferty's cube.
    if (beside > 0.0) {
      const double width = 2.0 / (9.0 * beside);
      const double root = 1.0 - width + std::sqrt(width) * stream.normal(drawn++);
      squares += beside * std::max(0.0, root * root * root);
    }
    largest_.push_back(largest_score(statistics_of(coordinates * z, squares, setting_.freedom)));
  }
  std::ranges::sort(largest_);
}

double FamilyOfTests::p_value(Eigen::Index j, double t) const {
  const auto above = largest_.end() - std::ranges::lower_bound(largest_, score(j, t));
  constexpr int enough = 20;  // fewer draws do not give a p-value
  const auto draws = static_cast<double>(largest_.size());
  if (above >= enough) return static_cast<double>(above) / draws;
  // Beyond these draws the tail falls like that of a single test.
  const double freedom = setting_.freedom - 1.0;
  const double last = t_for(j, largest_[largest_.size() - enough]);
  return enough / draws * std::min(1.0, two_sided_p_value(t, freedom) / two_sided_p_value(last, freedom));
}

}  // namespace dualdamp::identify
