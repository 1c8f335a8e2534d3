#include "identify/fit/compromise.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/constants.hpp"
#include "identify/fit/freedom.hpp"
#include "identify/fit/problem.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/least_squares.hpp"
#include "identify/statistics/scatter.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::identify {

namespace {

using core::infinity;

class Compromiser {
 public:
  /// `in_values`: the deviations from A's estimate are those of the values, not of the coordinates.
  Compromiser(const KnownRig& known, const Experiments& second, const Fit& held, const Fit& alone, bool in_values)
      : in_values_(in_values),
        is_open_(known.uncertainty.undetermined.cols() > 0),
        parameters_(with_own_parameters(known.parameters, held)),
        sizes_(sizes_of_stated(parameters_)),
        alone_(alone),
        problem_(known.rig, parameters_, second, sizes_, held.of_records) {
    Eigen::VectorXd at_held(size());
    for (Eigen::Index i = 0; i < size(); ++i) at_held[i] = parameters_[static_cast<std::size_t>(i)].stated;
    held_ = problem_.space().point(at_held);
    weigh(alone);
    whiten(known);
  }

  [[nodiscard]] Compromise run() const {
    Compromise found;
    if (whitening_.rows() == 0) return found;
    found.freedom = static_cast<double>(whitening_.rows());
    const double least = squares(end_of_alone(), false);
    const double one = least_of_both(least);
    if (!std::isfinite(least) || !std::isfinite(one)) return found;
    found.statistic = std::max(one - least, 0.0);
    found.p_value = chance_of(found.statistic);
    return found;
  }

 private:
  [[nodiscard]] double chance_of(double statistic) const {
    const auto freedom = static_cast<double>(whitening_.rows());
    return f_test_p_value(std::max(statistic, 0.0) / freedom, freedom, denominator_);
  }

  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(parameters_.size()); }

  [[nodiscard]] Eigen::VectorXd end_of_alone() const {
    Eigen::VectorXd values(size());
    for (Eigen::Index i = 0; i < size(); ++i) values[i] = alone_.parameters[static_cast<std::size_t>(i)].value;
    return problem_.space().point(values);
  }

  void weigh(const Fit& alone) {
    weights_.resize(problem_.readings().size());
    double independent = 0.0;
    bool all_stated = true;
    for (const FittedSignal& signal : alone.signals) {
      const Eigen::Index count = signal.rows.size();
      const double share = signal.independent / static_cast<double>(count);
      const double counted = problem_.readings().count(signal.rows);
      const double own = signal.rms * std::sqrt(counted / std::max(signal.freedom, least_freedom));
      // A stated noise is used unless the residuals are larger.
      const bool as_stated = problem_.readings().signal(signal.rows).is_stated && own < signal.noise;
      const double deviation = std::max(as_stated ? signal.noise : own, std::numeric_limits<double>::min());
      weights_.segment(signal.rows.begin, count).setConstant(std::sqrt(share) / deviation);
      independent += signal.independent;
      all_stated = all_stated && as_stated;
    }
    denominator_ = all_stated ? known_freedom : std::max(1.0, independent - static_cast<double>(size()));
  }

  /// Sets W with W^T W = C_A^-1, over what A determines of the parameters.
  void whiten(const KnownRig& known) {
    const auto shared = static_cast<Eigen::Index>(known.parameters.size());
    whitening_.resize(0, size());
    const Eigen::MatrixXd& of_values = known.uncertainty.covariance;
    if (shared == 0 || of_values.rows() != shared || !of_values.allFinite()) return;
    const Eigen::MatrixXd inverse = in_values_
                                        ? Eigen::MatrixXd::Identity(shared, shared)
                                        : inverse_of(problem_.space().slope(held_).topLeftCorner(shared, shared));
    const Eigen::MatrixXd covariance = propagated(inverse, of_values);
    std::vector<Eigen::Index> in;
    for (Eigen::Index i = 0; i < shared; ++i)
      if (of_values(i, i) > 0.0 && covariance(i, i) > 0.0) in.push_back(i);
    if (in.empty()) return;
    const Eigen::VectorXd scale = covariance.diagonal()(in).cwiseSqrt().cwiseInverse();
    Eigen::MatrixXd open(static_cast<Eigen::Index>(in.size()), 0);
    if (known.uncertainty.undetermined.rows() == shared)
      open = scale.asDiagonal() * product(inverse, known.uncertainty.undetermined)(in, Eigen::all);
    const Eigen::MatrixXd held = complement_of(open);
    if (held.cols() == 0) return;
    const Eigen::MatrixXd part = in_units(covariance(in, in), scale);
    const SymmetricSpectrum spectrum = symmetric_spectrum(product(product(held.transpose(), part), held));
    constexpr double rounding = 1e-10;
    const Eigen::VectorXd weights = spectrum.values.cwiseMax(rounding).cwiseSqrt().cwiseInverse();
    whitening_ = Eigen::MatrixXd::Zero(held.cols(), size());
    whitening_(Eigen::all, in) =
        product(weights.asDiagonal() * spectrum.vectors.transpose(), held.transpose()) * scale.asDiagonal();
  }

  /// An orthonormal basis of all that is orthogonal to the columns.
  static Eigen::MatrixXd complement_of(const Eigen::MatrixXd& columns) {
    const Eigen::Index size = columns.rows();
    std::vector<Eigen::VectorXd> units;
    for (const auto& column : columns.colwise())
      if (column.norm() > 0.0) units.emplace_back(column.normalized());
    if (units.empty()) return Eigen::MatrixXd::Identity(size, size);
    Eigen::MatrixXd spanning(size, static_cast<Eigen::Index>(units.size()));
    for (std::size_t j = 0; j < units.size(); ++j) spanning.col(static_cast<Eigen::Index>(j)) = units[j];
    constexpr double dependent = 1e-6;
    const Eigen::MatrixXd basis = orthonormal_basis(spanning, dependent);
    const SymmetricSpectrum projector = symmetric_spectrum(projector_beside(basis));
    return projector.vectors.rightCols(size - basis.cols());
  }

  /// Deviations from A's estimate, in standard deviations of what A determines.
  [[nodiscard]] Eigen::VectorXd deviations(const Eigen::VectorXd& q) const {
    return whitening_ *
           (in_values_ ? Eigen::VectorXd(problem_.space().values(q) - problem_.space().values(held_)) : q - held_);
  }

  [[nodiscard]] double squares(const Eigen::VectorXd& q, bool both) const {
    Eigen::VectorXd outputs;
    if (!problem_.outputs(q, outputs)) return infinity;
    double sum = problem_.readings().misses(outputs).cwiseProduct(weights_).squaredNorm();
    if (both) sum += deviations(q).squaredNorm();
    return std::isfinite(sum) ? sum : infinity;
  }

  /// The smallest sum, from points between the two estimates. There are false minima near the compromise, one for
  /// each stick more or less.
  [[nodiscard]] double least_of_both(double least_of_two) const {
    const Eigen::VectorXd alone = end_of_alone();
    constexpr std::size_t points = 9;
    std::vector<std::pair<double, std::size_t>> order(points);
    const auto at = [&](std::size_t i) {
      const double share = static_cast<double>(i) / static_cast<double>(points - 1);
      return Eigen::VectorXd(held_ + share * (alone - held_));
    };
    sim::in_parts(points, 1, 0, [&](std::size_t i, std::size_t) { order[i] = {squares(at(i), true), i}; });
    const double at_held = order.front().first;
    std::ranges::sort(order);
    double least = at_held;
    constexpr std::size_t starts = 2;
    // A search can only reduce the sum, so none is needed if the chance is large already.
    constexpr double enough = 0.2;
    for (std::size_t s = 0; s < starts && std::isfinite(order[s].first); ++s)
      if (chance_of(std::min(least, order[s].first) - least_of_two) < enough)
        least = std::min({least, order[s].first, improved(at(order[s].second))});
      else
        least = std::min(least, order[s].first);
    return least;
  }

  [[nodiscard]] double improved(const Eigen::VectorXd& start) const {
    LeastSquaresProblem least;
    const Eigen::Index rows = problem_.readings().size();
    least.residuals = rows + whitening_.rows();
    least.start = start;
    least.low.resize(size());
    least.high.resize(size());
    for (Eigen::Index i = 0; i < size(); ++i) {
      least.low[i] = problem_.space()[i].low;
      least.high[i] = problem_.space()[i].high;
    }
    constexpr double fine = 1e-5;
    least.tolerance = fine;
    // Along a direction that A leaves open, the way is long, and bent by the logarithms.
    least.most_iterations = is_open_ ? 100 : 12;
    least.evaluate = [&](const Eigen::VectorXd& q, Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian) {
      Eigen::VectorXd outputs;
      Eigen::MatrixXd slopes;
      if (jacobian == nullptr ? !problem_.outputs(q, outputs) : !problem_.derivatives(q, outputs, slopes, true))
        return false;
      residuals.resize(least.residuals);
      residuals << problem_.readings().misses(outputs).cwiseProduct(weights_), deviations(q);
      if (jacobian == nullptr) return true;
      jacobian->resize(least.residuals, size());
      *jacobian << weights_.cwiseProduct(problem_.readings().counted()).asDiagonal() * slopes,
          in_values_ ? product(whitening_, problem_.space().slope(q)) : whitening_;
      return true;
    };
    const LeastSquaresFit found = fit(least);
    return found.parameters.size() == size() ? squares(found.parameters, true) : infinity;
  }

  bool in_values_;
  bool is_open_;
  std::vector<FitParameter> parameters_;  ///< those of the rig, then those of B itself
  std::vector<double> sizes_;
  const Fit& alone_;
  FitProblem problem_;
  Eigen::VectorXd held_;       ///< A's estimate, with the own parameters of B fitted to it
  Eigen::VectorXd weights_;    ///< of each reading of B
  Eigen::MatrixXd whitening_;  ///< W
  double denominator_ = 1.0;   ///< degrees of freedom of the estimated deviations
};

}  // namespace

std::vector<FitParameter> with_own_parameters(std::vector<FitParameter> shared, const Fit& held) {
  for (const FittedParameter& fitted : held.parameters) {
    shared.push_back(fitted.parameter);
    shared.back().stated = fitted.value;
  }
  return shared;
}

Compromise compromise_of(const KnownRig& known, const Experiments& second, const Fit& held, const Fit& alone) {
  if (alone.parameters.size() != known.parameters.size() + held.parameters.size()) return {};
  const Compromise found = Compromiser(known, second, held, alone, false).run();
  if (known.uncertainty.undetermined.cols() == 0 || std::isnan(found.statistic)) return found;
  const Compromise in_values = Compromiser(known, second, held, alone, true).run();
  return in_values.statistic < found.statistic ? in_values : found;
}

}  // namespace dualdamp::identify
