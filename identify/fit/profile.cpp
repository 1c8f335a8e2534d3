#include "identify/fit/profile.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/parallel.hpp"

namespace dualdamp::identify {

Profiler::Profiler(const FitProblem& problem, const Eigen::VectorXd& weights, const Eigen::VectorXd& q,
                   const Eigen::MatrixXd& rows, const Eigen::VectorXd& residuals)
    : problem_(problem),
      weights_(weights),
      q_(q),
      rows_(rows),
      residuals_(residuals),
      squares_(residuals.squaredNorm()) {}

void Profiler::for_each(Eigen::Index count, const std::function<void(Eigen::Index)>& work) {
  sim::in_parts(static_cast<std::size_t>(count), 1, 0,
                [&](std::size_t i, std::size_t) { work(static_cast<Eigen::Index>(i)); });
}

Profiler::Way Profiler::at(const Eigen::VectorXd& q, const Eigen::VectorXd& residuals,
                           const Eigen::MatrixXd& rows) const {
  Way way{q, residuals, rows, rows.transpose() * rows, Eigen::VectorXd::Ones(q.size())};
  for (Eigen::Index j = 0; j < q.size(); ++j)
    if (way.normal(j, j) > 0.0) way.unit[j] = 1.0 / std::sqrt(way.normal(j, j));
  return way;
}

Eigen::VectorXd Profiler::step(Eigen::Index i, double value, const Way& way) const {
  // Lagrange's multiplier, in units of `way.unit`. A parameter that would leave its range is held at the end of the
  // range, and the step of the others is computed again.
  const Eigen::Index size = q_.size();
  const Eigen::VectorXd row = way.unit.cwiseProduct(problem_.slope(way.q).row(i).transpose());
  const double scale = row.norm();
  Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(size + 1, size + 1);
  bordered.topLeftCorner(size, size) = way.unit.asDiagonal() * way.normal * way.unit.asDiagonal();
  bordered.block(0, size, size, 1) = row / scale;
  bordered.block(size, 0, 1, size) = row.transpose() / scale;
  Eigen::VectorXd right(size + 1);
  right.head(size) = -way.unit.cwiseProduct(way.rows.transpose() * way.residuals);
  right[size] = (value - problem_.values(way.q)[i]) / scale;
  for (Eigen::Index held = 0;; ++held) {
    const Eigen::VectorXd found = bordered.completeOrthogonalDecomposition().solve(right);
    Eigen::VectorXd q = way.q + way.unit.cwiseProduct(found.head(size));
    Eigen::Index leaving = -1;
    for (Eigen::Index j = 0; j < size; ++j) {
      const Coordinate& c = problem_.coordinates()[static_cast<std::size_t>(j)];
      const double inside = std::clamp(q[j], c.low, c.high);
      constexpr double rounding = 1e-12;
      const bool may_be_held = j != i || other_of(i, way.q) >= 0;
      if (std::abs(inside - q[j]) > rounding * (1.0 + std::abs(inside)) && may_be_held && leaving < 0) leaving = j;
      q[j] = inside;
    }
    if (leaving < 0 || held == size) return other_of(i, q) < 0 ? q : placed(i, value, q);
    const double shift = (q[leaving] - way.q[leaving]) / way.unit[leaving];
    right -= shift * bordered.col(leaving);
    bordered.row(leaving).setZero();
    bordered.col(leaving).setZero();
    bordered(leaving, leaving) = 1.0;
    right[leaving] = shift;
  }
}

Eigen::Index Profiler::other_of(Eigen::Index i, const Eigen::VectorXd& q) const {
  const Eigen::MatrixXd slope = problem_.slope(q);
  for (Eigen::Index j = 0; j < q.size(); ++j)
    if (j != i && slope(i, j) != 0.0) return j;
  return -1;
}

Eigen::VectorXd Profiler::placed(Eigen::Index i, double value, const Eigen::VectorXd& q) const {
  Eigen::VectorXd values = problem_.values(q);
  values[i] = value;
  if (const Eigen::Index other = other_of(i, q); other >= 0) values[other] = std::min(values[other], value);
  return problem_.coordinates(values);
}

double Profiler::growth_of(const Eigen::VectorXd& residuals) const {
  return std::sqrt(std::max(residuals.squaredNorm() - squares_, 0.0));
}

std::optional<double> Profiler::alone(Eigen::Index i, double value, Way& way) const {
  Eigen::VectorXd q = placed(i, value, way.q);
  Eigen::VectorXd outputs;
  if (!problem_.outputs(q, outputs)) return std::nullopt;
  way.q = std::move(q);
  way.residuals = problem_.misses(outputs).cwiseProduct(weights_);
  return growth_of(way.residuals);
}

std::optional<double> Profiler::growth(Eigen::Index i, double value, double limit, Way& way) const {
  const Way before = way;
  std::optional<double> best = followed(i, value, way);
  if (best && *best <= limit) return best;
  // The others may have moved across a jump of the sum of squares, such as that of one stick more.
  Way beside = before;
  const std::optional<double> unfollowed = alone(i, value, beside);
  if (!unfollowed || (best && *unfollowed >= *best)) return best;
  way = std::move(beside);
  return unfollowed;
}

bool Profiler::take(const Eigen::VectorXd& q, Way& way, double& best) const {
  Eigen::VectorXd outputs;
  if (!problem_.outputs(q, outputs)) return false;
  Eigen::VectorXd residuals = problem_.misses(outputs).cwiseProduct(weights_);
  const double found = growth_of(residuals);
  if (!(found < best)) return true;
  best = found;
  way.q = q;
  way.residuals = std::move(residuals);
  note_lower(way);
  return true;
}

void Profiler::note_lower(const Way& way) const {
  // In units of the variance of a reading. A smaller gain only means that the search ended near enough to the
  // minimum.
  constexpr double margin = 0.05;
  const double squares = way.residuals.squaredNorm();
  const std::lock_guard lock(mutex_);
  // The smallest of all, so that the order of the threads does not matter.
  const double limit = lower_ ? lower_->second : squares_ * (1.0 - margin / static_cast<double>(residuals_.size()));
  if (squares < limit) lower_ = {way.q, squares};
}

std::optional<double> Profiler::followed(Eigen::Index i, double value, Way& way) const {
  double best = std::numeric_limits<double>::infinity();
  const auto result = [&] { return std::isfinite(best) ? std::optional<double>(best) : std::nullopt; };
  // A bent valley needs many sets of derivatives; elsewhere, the first set suffices.
  constexpr int most_derivatives = 12;
  constexpr int most_steps = 4;
  constexpr double settled = 0.01;
  for (int derivative = 0;; ++derivative) {
    const double begun = best;
    bool is_settled = false;
    for (int round = 0; round < most_steps && !is_settled; ++round) {
      const double before = best;
      const Eigen::VectorXd q = step(i, value, way);
      const Eigen::VectorXd from = way.q;
      if (!take(q, way, best)) return result();
      // A step out of the range of the derivatives is tried again with a shorter length.
      constexpr double shorter = 0.3;
      if (!(best < before) && std::isfinite(before) && !take(from + shorter * (q - from), way, best))
        return result();
      if (!(best < before)) break;
      is_settled = before - best <= settled * best;
    }
    if (is_settled || derivative == most_derivatives) return result();
    if (derivative > 1 && !(begun - best > settled * best)) return result();
    Eigen::VectorXd outputs;
    Eigen::MatrixXd jacobian;
    if (!problem_.derivatives(way.q, outputs, jacobian)) return result();
    way = at(way.q, way.residuals, weights_.asDiagonal() * jacobian);
  }
}

double Profiler::end(Eigen::Index i, const FittedParameter& fitted, double limit, double sign) const {
  const Coordinate& c = problem_.coordinates()[static_cast<std::size_t>(i)];
  const friction::Range& range = fitted.parameter.range;
  const auto value_at = [&](double way) {
    const double value =
        c.logarithmic ? fitted.value * std::exp(sign * way / fitted.value) : fitted.value + sign * way;
    return std::clamp(value, range.low, range.high);
  };
  double way = limit * fitted.std;
  if (std::isnan(fitted.std)) {
    // A parameter without an effect near the estimate may have one further off.
    const double norm = rows_.col(i).norm();
    constexpr double near = 1e-3;
    way = norm > 0.0 ? limit * problem_.slope(q_)(i, i) / norm : near * std::abs(problem_.slope(q_)(i, i));
  }
  Way others = at(q_, residuals_, rows_);
  double inner = 0.0;
  double inner_growth = 0.0;
  double outer = std::numeric_limits<double>::infinity();
  double last = 0.0;
  constexpr int most_rounds = 12;
  constexpr double close = 0.02;
  for (int round = 0; round < most_rounds; ++round) {
    const double value = value_at(way);
    const std::optional<double> grown = growth(i, value, limit, others);
    if (!grown) return unknown;
    last = *grown / limit;
    if (std::abs(last - 1.0) < close) return value;
    if (last < 1.0 && value == (sign < 0.0 ? range.low : range.high)) return value;
    // The root of the growth is nearly linear, except at a jump, which is bracketed.
    const double rise = std::max(*grown - inner_growth, 1e-3 * limit);
    const double next = inner + (way - inner) * (limit - inner_growth) / rise;
    if (last < 1.0) {
      inner = way;
      inner_growth = *grown;
    } else {
      outer = way;
    }
    if (outer - inner < close * outer) return value_at(outer);
    constexpr double farthest = 4.0;
    const double margin = std::isfinite(outer) ? 0.1 * (outer - inner) : 0.0;
    way = std::clamp(next, std::max(inner + margin, way / farthest), std::min(outer - margin, farthest * way));
  }
  constexpr double near = 0.1;
  return std::abs(last - 1.0) < near ? value_at(way) : unknown;
}

Interval Profiler::interval(Eigen::Index i, const FittedParameter& fitted, double limit) const {
  return {end(i, fitted, limit, -1.0), end(i, fitted, limit, 1.0)};
}

}  // namespace dualdamp::identify
