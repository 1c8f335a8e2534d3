#include "identify/fit/search/weighted_search.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "identify/fit/freedom.hpp"
#include "identify/statistics/huber.hpp"

namespace dualdamp::identify {

WeightedSearch::WeightedSearch(const FitProblem& problem, const SearchOptions& options)
    : problem_(problem), options_(options), weights_(Eigen::VectorXd::Ones(problem.readings().size())) {
  deviations_ = options.deviations;
  if (deviations_.size() != problem.readings().signals().size()) {
    deviations_.clear();
    for (const SignalRows& rows : problem.readings().signals()) deviations_.push_back(first_deviation(rows));
  }
  spread();
}

double WeightedSearch::squares(const Eigen::VectorXd& q) const {
  Eigen::VectorXd outputs;
  if (!problem_.outputs(q, outputs)) return core::infinity;
  const Eigen::VectorXd sizes = problem_.readings().misses(outputs).cwiseProduct(weights_);
  const double sum = options_.robust ? huber_sum(sizes) : sizes.squaredNorm();
  return std::isfinite(sum) ? sum : core::infinity;
}

LeastSquaresFit WeightedSearch::improve(const Eigen::VectorXd& start, double tolerance, int most_iterations) const {
  LeastSquaresProblem least;
  least.residuals = problem_.readings().size();
  least.start = start;
  least.low.resize(start.size());
  least.high.resize(start.size());
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    least.low[i] = problem_.space()[i].low;
    least.high[i] = problem_.space()[i].high;
  }
  least.tolerance = tolerance;
  least.most_iterations = most_iterations;
  least.slopes_along_steps = true;
  Last last;
  least.evaluate = [&](const Eigen::VectorXd& q, Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian) {
    if (!evaluate(q, jacobian != nullptr, last)) return false;
    residuals = problem_.readings().misses(last.outputs).cwiseProduct(weights_);
    if (jacobian != nullptr) *jacobian = weights_.asDiagonal() * last.jacobian;
    return true;
  };
  return fit(least);
}

double WeightedSearch::reweight(const Eigen::VectorXd& outputs, const Eigen::MatrixXd& rows_of_fit) {
  const Eigen::VectorXd misses = problem_.readings().misses(outputs);
  const std::vector<double> freedoms = freedoms_of(problem_, rows_of_fit);
  const Eigen::VectorXd before = weights_;
  double change = 0.0;
  for (std::size_t s = 0; s < deviations_.size(); ++s) {
    const SignalRows& rows = problem_.readings().signals()[s];
    const double count = problem_.readings().count(rows);
    if (problem_.readings().signal(rows).is_stated || freedoms[s] < least_freedom) continue;
    const double found = options_.robust
                             ? robust_deviation(problem_.readings().counted(misses, rows), freedoms[s]).deviation
                             : problem_.readings().rms(misses, rows) * std::sqrt(count / freedoms[s]);
    if (!(found > 0.0)) continue;
    change = std::max(change, std::abs(std::log(found / deviations_[s])));
    deviations_[s] = found;
  }
  spread();
  if (options_.robust) bound(misses);
  for (Eigen::Index i = 0; i < before.size(); ++i)
    if (weights_[i] > 0.0) change = std::max(change, std::abs(std::log(weights_[i] / before[i])));
  return change;
}

bool WeightedSearch::evaluate(const Eigen::VectorXd& q, bool with_jacobian, Last& last) const {
  const bool is_first = last.q.size() == 0;  // the solver asks for the derivatives next
  const bool is_same = last.is_known && last.q == q;
  if (is_same && (last.has_jacobian || !with_jacobian)) return true;
  with_jacobian = with_jacobian || is_first;
  last.q = q;
  last.is_known = with_jacobian ? problem_.derivatives(q, last.outputs, last.jacobian, true, &last.last)
                                : problem_.outputs(q, last.outputs, &last.last);
  last.has_jacobian = with_jacobian && last.is_known;
  return last.is_known;
}

double WeightedSearch::first_deviation(const SignalRows& rows) const {
  const Signal& signal = problem_.readings().signal(rows);
  if (signal.noise > 0.0) return signal.noise;
  if (signal.unit == "rad") return 0.01;
  const Eigen::VectorXd part = problem_.readings().measured().segment(rows.begin, rows.size());
  const double size = std::sqrt((part.array() - part.mean()).square().mean());
  return size > 0.0 ? 0.01 * size : 1.0;
}

void WeightedSearch::spread() {
  for (std::size_t s = 0; s < deviations_.size(); ++s) {
    const SignalRows& rows = problem_.readings().signals()[s];
    weights_.segment(rows.begin, rows.size()).setConstant(1.0 / deviations_[s]);
  }
  weights_ = weights_.cwiseProduct(problem_.readings().counted());
  unbounded_ = weights_;
}

void WeightedSearch::bound(const Eigen::VectorXd& misses) {
  for (Eigen::Index i = 0; i < misses.size(); ++i) {
    const double size = std::abs(misses[i]) * weights_[i];
    if (size > huber_bound) weights_[i] *= std::sqrt(huber_bound / size);
  }
}

}  // namespace dualdamp::identify
