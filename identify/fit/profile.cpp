#include "identify/fit/profile.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "sim/parallel.hpp"

namespace dualdamp::identify {

Profiler::Profiler(const FitProblem& problem, const Eigen::VectorXd& weights, const Eigen::VectorXd& q,
                   const Eigen::MatrixXd& rows, const Eigen::VectorXd& residuals)
    : problem_(problem),
      weights_(weights),
      q_(q),
      rows_(rows),
      residuals_(residuals),
      normal_(rows.transpose() * rows),
      squares_(residuals.squaredNorm()) {
  constexpr double least = 1e-100;
  unit_ = normal_.diagonal().cwiseMax(least).cwiseSqrt().cwiseInverse();
}

void Profiler::for_each(Eigen::Index count, const std::function<void(Eigen::Index)>& work) {
  sim::in_parts(static_cast<std::size_t>(count), 1, 0,
                [&](std::size_t i, std::size_t) { work(static_cast<Eigen::Index>(i)); });
}

std::optional<double> Profiler::growth(Eigen::Index i, double value) const {
  const Eigen::Index size = q_.size();
  Eigen::VectorXd q = q_;
  Eigen::VectorXd residuals = residuals_;
  std::optional<double> best;
  constexpr int most_steps = 4;
  constexpr double settled = 0.01;
  for (int round = 0; round < most_steps; ++round) {
    // Least squares with the value held, by Lagrange's multiplier.
    const Eigen::VectorXd row = unit_.cwiseProduct(problem_.slope(q).row(i).transpose());
    const double scale = row.norm();
    Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(size + 1, size + 1);
    bordered.topLeftCorner(size, size) = unit_.asDiagonal() * normal_ * unit_.asDiagonal();
    bordered.block(0, size, size, 1) = row / scale;
    bordered.block(size, 0, 1, size) = row.transpose() / scale;
    Eigen::VectorXd right(size + 1);
    right.head(size) = -unit_.cwiseProduct(rows_.transpose() * residuals);
    right[size] = (value - problem_.values(q)[i]) / scale;
    const Eigen::VectorXd step = bordered.completeOrthogonalDecomposition().solve(right);
    q += unit_.cwiseProduct(step.head(size));
    for (Eigen::Index j = 0; j < size; ++j) {
      const Coordinate& c = problem_.coordinates()[static_cast<std::size_t>(j)];
      q[j] = std::clamp(q[j], c.low, c.high);
    }
    Eigen::VectorXd outputs;
    if (!problem_.outputs(q, outputs)) return best;
    residuals = (outputs - problem_.measured()).cwiseProduct(weights_);
    const double found = std::sqrt(std::max(residuals.squaredNorm() - squares_, 0.0));
    if (best && !(found < *best)) return best;
    const bool is_settled = best && *best - found < settled * found;
    best = found;
    if (is_settled) break;
  }
  return best;
}

double Profiler::end(Eigen::Index i, const FittedParameter& fitted, double limit, double sign) const {
  const Coordinate& c = problem_.coordinates()[static_cast<std::size_t>(i)];
  const friction::Range& range = fitted.parameter.range;
  const auto at = [&](double way) {
    const double value =
        c.logarithmic ? fitted.value * std::exp(sign * way / fitted.value) : fitted.value + sign * way;
    return std::clamp(value, range.low, range.high);
  };
  double way = limit * fitted.std;
  if (std::isnan(fitted.std)) {
    const Eigen::VectorXd row = rows_.col(i);
    way = limit * problem_.slope(q_)(i, i) / std::max(row.norm(), 1e-300);
  }
  double inner = 0.0;
  double inner_growth = 0.0;
  double last = 0.0;
  constexpr int most_rounds = 7;
  constexpr double close = 0.02;
  for (int round = 0; round < most_rounds; ++round) {
    const double value = at(way);
    const std::optional<double> grown = growth(i, value);
    if (!grown) return unknown;
    last = *grown / limit;
    if (std::abs(last - 1.0) < close) return value;
    if (last < 1.0 && value == (sign < 0.0 ? range.low : range.high)) return value;
    // The root of the growth is nearly a straight line.
    const double rise = std::max(*grown - inner_growth, 1e-3 * limit);
    const double next = inner + (way - inner) * (limit - inner_growth) / rise;
    if (last < 1.0) {
      inner = way;
      inner_growth = *grown;
    }
    constexpr double farthest = 4.0;
    way = std::clamp(next, way / farthest, farthest * way);
  }
  constexpr double near = 0.1;
  return std::abs(last - 1.0) < near ? at(way) : unknown;
}

std::array<double, 2> Profiler::interval(Eigen::Index i, const FittedParameter& fitted, double limit) const {
  return {end(i, fitted, limit, -1.0), end(i, fitted, limit, 1.0)};
}

}  // namespace dualdamp::identify
