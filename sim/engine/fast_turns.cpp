#include "sim/engine/fast_turns.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sim/engine/eigenvalues.hpp"
#include "sim/steppers/radau_collocation.hpp"

namespace dualdamp::sim {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr auto stage_count = static_cast<Index>(radau_stages);

/// By this the second term may change a column: an error of the third order in the length of the part. What the
/// fifth order leaves is about its power 5/3.
constexpr double second_term = 1e-5;
/// Of a column as it was: below that nothing is left of a perturbation that has decayed.
constexpr double nothing_left = 1e-10;
/// A change of an entry of J by less than this part of it is rounding: J is known from differences.
constexpr double rounding_of_entry = 1e-7;
/// The exponential of a matrix of this size has an error of 1e-8.
constexpr double largest_size = 1e8;
/// Taylor's series of ten terms is exact to rounding for matrices of this size.
constexpr double small_size = 0.125;
constexpr int taylor_terms = 10;

/// Of what the stages tell as a polynomial of fourth degree in s: `moments` are the integrals of 1 and s - 1/2 over
/// its parts, `derivatives` those of it at s = 0, each a row of weights.
struct Weights {
  Eigen::Matrix<double, 2, stage_count> moments;
  Eigen::Matrix<double, stage_count, stage_count> derivatives;
};

Weights make_weights() {
  const RadauCollocation& radau = RadauCollocation::once();
  Eigen::Matrix<double, stage_count, stage_count> powers;  // s^k at the stages
  for (Index i = 0; i < stage_count; ++i)
    for (Index k = 0; k < stage_count; ++k)
      powers(i, k) = std::pow(radau.nodes[static_cast<std::size_t>(i)], static_cast<double>(k));
  Weights weights;
  weights.derivatives = powers.inverse();  // the coefficients of s^k
  weights.moments.setZero();
  double factorial = 1.0;
  for (Index k = 0; k < stage_count; ++k) {
    const auto degree = static_cast<double>(k);
    weights.moments.row(0) += weights.derivatives.row(k) / (degree + 1.0);
    weights.moments.row(1) += weights.derivatives.row(k) * (1.0 / (degree + 2.0) - 0.5 / (degree + 1.0));
  }
  for (Index k = 1; k < stage_count; ++k) {
    factorial *= static_cast<double>(k);
    weights.derivatives.row(k) *= factorial;
  }
  return weights;
}

const Weights& stage_weights() {
  static const Weights weights = make_weights();
  return weights;
}

double size_of(const MatrixXd& matrix) {
  return matrix.size() == 0 ? 0.0 : matrix.cwiseAbs().colwise().sum().maxCoeff();
}

}  // namespace

/// Less one: so a slow perturbation keeps its digits beside a fast one.
MatrixXd FastTurns::exponential(const MatrixXd& matrix) {
  const int halvings = std::max(0, static_cast<int>(std::ceil(std::log2(size_of(matrix) / small_size))));
  const MatrixXd part = std::ldexp(1.0, -halvings) * matrix;
  MatrixXd result = part / taylor_terms;
  for (int k = taylor_terms - 1; k > 0; --k) result = ((part + part * result) / k).eval();
  for (int k = 0; k < halvings; ++k) result = (result * result + 2.0 * result).eval();
  operations_ += (taylor_terms + halvings) * matrix.rows() * matrix.rows() * matrix.rows();
  return result;
}

/// The forcing is a part of the linear system, driven by the powers s^k/k!, of which each is the derivative of the
/// next.
std::optional<MatrixXd> FastTurns::pass(const Stages& stages, const MatrixXd& perturbations) {
  const Weights& weights = stage_weights();
  const Index n = perturbations.rows();
  MatrixXd mean = MatrixXd::Zero(n, n);
  MatrixXd skew = MatrixXd::Zero(n, n);
  for (Index i = 0; i < stage_count; ++i) {
    mean += weights.moments(0, i) * stages.jacobians[static_cast<std::size_t>(i)];
    skew += weights.moments(1, i) * stages.jacobians[static_cast<std::size_t>(i)];
  }
  skew = (skew.array().abs() > rounding_of_entry * mean.array().abs()).select(skew, 0.0).eval();
  const Eigen::VectorXd scales = balance(mean);
  const auto in_scales = scales.cwiseInverse().asDiagonal();
  skew = (in_scales * skew * scales.asDiagonal()).eval();
  const double size = size_of(mean);
  if (!(size > 0.0 && size < largest_size)) return std::nullopt;
  MatrixXd forcing = in_scales * stages.forcing * weights.derivatives.transpose();
  const double strength = forcing.cwiseAbs().maxCoeff();
  if (!std::isfinite(strength)) return std::nullopt;
  // Linear in the forcing, which may have any size.
  const double unit = strength > 0.0 ? std::exp2(std::round(std::log2(strength / size))) : 1.0;

  MatrixXd whole = MatrixXd::Zero(n + stage_count, n + stage_count);
  whole.topLeftCorner(n, n) = mean;
  whole.topRightCorner(n, stage_count) = forcing / unit;
  for (Index k = 1; k < stage_count; ++k) whole(n + k, n + k - 1) = 1.0;
  MatrixXd before = MatrixXd::Zero(n + stage_count, perturbations.cols());
  before.topRows(n) = in_scales * perturbations;
  before(n, perturbations.cols() - 1) = unit;

  const MatrixXd first = before + exponential(whole) * before;
  MatrixXd turning = MatrixXd::Zero(n + stage_count, n + stage_count);
  turning.topLeftCorner(n, n) = skew;
  const MatrixXd bracket = turning * whole - whole * turning;
  MatrixXd after = first;
  if (!bracket.isZero(0.0)) after = before + exponential(whole + bracket) * before;
  if (!after.allFinite()) return std::nullopt;
  for (Index c = 0; c < after.cols(); ++c) {
    const double kept = after.col(c).head(n).cwiseAbs().maxCoeff();
    const double was = before.col(c).head(n).cwiseAbs().maxCoeff();
    const double change = (after.col(c) - first.col(c)).head(n).cwiseAbs().maxCoeff();
    if (!(change <= second_term * std::max(kept, nothing_left * was))) return std::nullopt;
  }
  return MatrixXd(scales.asDiagonal() * after.topRows(n));
}

}  // namespace dualdamp::sim
