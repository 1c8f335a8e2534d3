#include "identify/methods/amplitudes/law_fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/least_squares.hpp"

namespace dualdamp::identify {

double sum_of_terms(const FundamentalLaw& law, const Eigen::VectorXd& p, const FundamentalLaw::Terms& terms) {
  double sum = 0.0;
  for (std::size_t j = 0; j < law.coefficients.size(); ++j) sum += p[static_cast<Eigen::Index>(j)] * terms[j];
  return sum;
}

double shape_of(const FundamentalLaw& law, const Eigen::VectorXd& p) {
  return law.shape ? p[static_cast<Eigen::Index>(law.coefficients.size())] : 0.0;
}

std::optional<LawOutput> output_of(const FundamentalLaw& law, const Eigen::VectorXd& p, const LawPoint& point) {
  const double shape = shape_of(law, p);
  LawOutput found{.X = point.x};
  constexpr int most_steps = 40;
  for (int i = 0; i < most_steps; ++i) {
    found.fundamentals = law.fundamentals(point.speed * found.X, found.X, shape);
    const double along = point.elastic * found.X;
    found.across = sum_of_terms(law, p, found.fundamentals.value);
    found.slope = point.elastic * along + found.across * sum_of_terms(law, p, found.fundamentals.slope) / found.X;
    if (!(found.slope > 0.0)) return std::nullopt;
    const double step = 0.5 * (along * along + found.across * found.across - point.Y * point.Y) / found.slope;
    found.X = std::max(found.X - step, 0.2 * found.X);
    if (std::abs(step) < 1e-8 * found.X) return found;  // the error after this step is of its square
  }
  return std::nullopt;
}

namespace {

/// Residuals in x and their derivatives, from the implicit equation.
bool evaluate(const FundamentalLaw& law, const std::vector<LawPoint>& points, const Eigen::VectorXd& p,
              Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) {
  residual.resize(static_cast<Eigen::Index>(points.size()));
  const auto size = static_cast<Eigen::Index>(law.coefficients.size());
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    const LawPoint& point = points[static_cast<std::size_t>(i)];
    const std::optional<LawOutput> found = output_of(law, p, point);
    if (!found) return false;
    residual[i] = found->X - point.x;
    if (jacobian == nullptr) continue;
    const double weight = -found->across / found->slope;
    for (Eigen::Index j = 0; j < size; ++j)
      (*jacobian)(i, j) = weight * found->fundamentals.value[static_cast<std::size_t>(j)];
    if (law.shape) (*jacobian)(i, size) = weight * sum_of_terms(law, p, found->fundamentals.by_shape);
  }
  return true;
}

/// Linear least squares in the force for each shape of a grid. The weights are those for errors of x under a law
/// that is linear in x.
Eigen::VectorXd starting_point(const FundamentalLaw& law, const std::vector<LawPoint>& points) {
  const auto count = static_cast<Eigen::Index>(points.size());
  const auto size = static_cast<Eigen::Index>(law.coefficients.size());
  Eigen::VectorXd best = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(law.parameters()));
  double least = core::infinity;
  constexpr int grid = 24;
  for (int g = 0; g < (law.shape ? grid : 1); ++g) {
    const double shape =
        law.shape ? law.shape->low * std::pow(law.shape->high / law.shape->low, (g + 0.5) / grid) : 0.0;
    Eigen::MatrixXd columns(count, size);
    Eigen::VectorXd values(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const LawPoint& point = points[static_cast<std::size_t>(i)];
      const double along = point.elastic * point.x;
      const double across = std::sqrt(std::max((point.Y - along) * (point.Y + along), 0.0));
      const double weight = across / (point.elastic * point.elastic * point.x + across);
      const FundamentalLaw::Terms terms = law.fundamentals(point.speed * point.x, point.x, shape).value;
      for (Eigen::Index j = 0; j < size; ++j) columns(i, j) = weight * terms[static_cast<std::size_t>(j)];
      values[i] = weight * across;
    }
    Eigen::VectorXd coefficients = pivoted_least_squares(columns, values);
    for (Eigen::Index j = 0; j < size; ++j)
      if (!law.coefficients[static_cast<std::size_t>(j)].signed_value)
        coefficients[j] = std::max(coefficients[j], 1e-3);
    const double squares = (values - columns * coefficients).squaredNorm();
    if (!(squares < least)) continue;
    least = squares;
    best.head(size) = coefficients;
    if (law.shape) best[size] = shape;
  }
  return best;
}

/// A shape that is a speed is fitted by its inverse, in which the law is nearly linear: for data of Coulomb and
/// viscous friction the speed itself would go to infinity in a hundred steps. The function is its own inverse.
void invert_shape(const FundamentalLaw& law, Eigen::VectorXd& p) {
  if (law.shape && law.shape->is_speed) p[p.size() - 1] = 1.0 / p[p.size() - 1];
}

}  // namespace

std::optional<LawFit> fit_law(const FundamentalLaw& law, const std::vector<LawPoint>& points) {
  const auto size = static_cast<Eigen::Index>(law.parameters());
  constexpr double unbounded = 1e6;
  LeastSquaresProblem problem;
  problem.residuals = static_cast<Eigen::Index>(points.size());
  problem.start = starting_point(law, points);
  problem.low = Eigen::VectorXd::Zero(size);
  problem.high = Eigen::VectorXd::Constant(size, unbounded);
  for (std::size_t j = 0; j < law.coefficients.size(); ++j)
    if (law.coefficients[j].signed_value) problem.low[static_cast<Eigen::Index>(j)] = -unbounded;
  if (law.shape) {
    const bool inverse = law.shape->is_speed;
    problem.low[size - 1] = inverse ? 1.0 / law.shape->high : law.shape->low;
    problem.high[size - 1] = inverse ? 1.0 / law.shape->low : law.shape->high;
  }
  problem.tolerance = 1e-6;  // far below the differences between laws
  problem.evaluate = [&](const Eigen::VectorXd& q, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian) {
    Eigen::VectorXd p = q;
    invert_shape(law, p);
    if (!evaluate(law, points, p, residual, jacobian)) return false;
    if (jacobian != nullptr && law.shape && law.shape->is_speed)
      jacobian->col(size - 1) *= -p[size - 1] * p[size - 1];
    return true;
  };
  // With a term of negative sign there may be no motion at all: begin with a smaller term.
  Eigen::VectorXd residual;
  constexpr int halvings = 6;
  for (int i = 0; i < halvings && !evaluate(law, points, problem.start, residual, nullptr); ++i)
    for (std::size_t j = 0; j < law.coefficients.size(); ++j)
      if (law.coefficients[j].signed_value) problem.start[static_cast<Eigen::Index>(j)] *= 0.5;
  invert_shape(law, problem.start);
  LeastSquaresFit found = fit(problem);
  if (!found.outcome.ok()) return std::nullopt;
  LawFit result{&law, std::move(found.parameters), std::move(found.residuals), std::move(found.jacobian)};
  invert_shape(law, result.p);
  if (law.shape && law.shape->is_speed) result.jacobian.col(size - 1) /= -result.p[size - 1] * result.p[size - 1];
  return result;
}

}  // namespace dualdamp::identify
