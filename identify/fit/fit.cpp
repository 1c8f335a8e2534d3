#include "identify/fit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/cancellation.hpp"
#include "identify/fit/starts.hpp"
#include "identify/fit/uncertainty.hpp"
#include "identify/statistics/least_squares.hpp"
#include "identify/statistics/median.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::identify {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double rms(const Eigen::VectorXd& part) { return std::sqrt(part.squaredNorm() / static_cast<double>(part.size())); }

/// The search: weights, starts, steps.
class Search {
 public:
  Search(const FitProblem& problem, const FitOptions& options)
      : problem_(problem), options_(options), weights_(Eigen::VectorXd::Ones(problem.rows())) {
    for (const SignalRows& rows : problem.signals()) deviations_.push_back(first_deviation(rows));
    spread();
  }

  [[nodiscard]] const Eigen::VectorXd& weights() const { return weights_; }

  /// Sum of squares; infinite where there is no motion.
  [[nodiscard]] double squares(const Eigen::VectorXd& q) const {
    Eigen::VectorXd outputs;
    if (!problem_.outputs(q, outputs)) return infinity;
    const double sum = (outputs - problem_.measured()).cwiseProduct(weights_).squaredNorm();
    return std::isfinite(sum) ? sum : infinity;
  }

  [[nodiscard]] LeastSquaresFit improve(const Eigen::VectorXd& start, double tolerance, int most_iterations) const {
    LeastSquaresProblem least;
    least.residuals = problem_.rows();
    least.start = start;
    least.low.resize(start.size());
    least.high.resize(start.size());
    for (Eigen::Index i = 0; i < start.size(); ++i) {
      least.low[i] = problem_.coordinates()[static_cast<std::size_t>(i)].low;
      least.high[i] = problem_.coordinates()[static_cast<std::size_t>(i)].high;
    }
    least.tolerance = tolerance;
    least.most_iterations = most_iterations;
    least.evaluate = [&](const Eigen::VectorXd& q, Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian) {
      Eigen::VectorXd outputs;
      if (jacobian == nullptr ? !problem_.outputs(q, outputs) : !problem_.derivatives(q, outputs, *jacobian))
        return false;
      residuals = (outputs - problem_.measured()).cwiseProduct(weights_);
      if (jacobian != nullptr) *jacobian = weights_.asDiagonal() * *jacobian;
      return true;
    };
    return fit(least);
  }

  /// Weights from the residuals of a fit; how much the largest change of a deviation is, relative.
  double reweight(const Eigen::VectorXd& outputs, Eigen::Index parameters) {
    const Eigen::VectorXd misses = outputs - problem_.measured();
    const double spent = static_cast<double>(parameters) / static_cast<double>(problem_.rows());
    double change = 0.0;
    for (std::size_t s = 0; s < deviations_.size(); ++s) {
      const SignalRows& rows = problem_.signals()[s];
      const Eigen::VectorXd part = misses.segment(rows.begin, rows.end - rows.begin);
      const double own = options_.robust ? robust_deviation(part) : rms(part);
      const double found =
          problem_.signal(rows).is_stated ? deviations_[s] : own / std::sqrt(1.0 - std::min(spent, 0.9));
      if (!(found > 0.0)) continue;
      change = std::max(change, std::abs(std::log(found / deviations_[s])));
      deviations_[s] = found;
    }
    spread();
    if (options_.robust) bound(misses);
    return change;
  }

 private:
  /// Noise where it is known; else a share of the signal, for weights alone.
  [[nodiscard]] double first_deviation(const SignalRows& rows) const {
    const Signal& signal = problem_.signal(rows);
    if (signal.noise > 0.0) return signal.noise;
    if (signal.unit == "rad") return 0.01;
    const Eigen::VectorXd part = problem_.measured().segment(rows.begin, rows.end - rows.begin);
    const double size = (part.array() - part.mean()).matrix().norm() / std::sqrt(static_cast<double>(part.size()));
    return size > 0.0 ? 0.01 * size : 1.0;
  }

  static double robust_deviation(const Eigen::VectorXd& part) {
    std::vector<double> sizes(part.data(), part.data() + part.size());
    for (double& size : sizes) size = std::abs(size);
    constexpr double to_deviation = 1.4826;
    return to_deviation * upper_median(sizes);
  }

  void spread() {
    for (std::size_t s = 0; s < deviations_.size(); ++s) {
      const SignalRows& rows = problem_.signals()[s];
      weights_.segment(rows.begin, rows.end - rows.begin).setConstant(1.0 / deviations_[s]);
    }
  }

  /// Huber's weights: a residual beyond the bound pulls like one at it.
  void bound(const Eigen::VectorXd& misses) {
    constexpr double huber = 1.345;
    for (Eigen::Index i = 0; i < misses.size(); ++i) {
      const double size = std::abs(misses[i]) * weights_[i];
      if (size > huber) weights_[i] *= std::sqrt(huber / size);
    }
  }

  const FitProblem& problem_;
  const FitOptions& options_;
  std::vector<double> deviations_;  ///< of each signal
  Eigen::VectorXd weights_;
};

/// The best starts of many, in coordinates.
std::vector<Eigen::VectorXd> best_starts(const FitProblem& problem, const Search& search,
                                         const std::vector<FitParameter>& parameters,
                                         const std::vector<double>& sizes, int count, std::size_t wanted) {
  std::vector<std::pair<double, Eigen::VectorXd>> starts(static_cast<std::size_t>(count));
  sim::in_parts(starts.size(), 1, 0, [&](std::size_t i, std::size_t) {
    const Eigen::VectorXd q = problem.coordinates(start_of(parameters, sizes, static_cast<int>(i)));
    starts[i] = {search.squares(q), q};
  });
  std::ranges::stable_sort(starts, {}, [](const auto& start) { return start.first; });
  std::vector<Eigen::VectorXd> best;
  for (const auto& [squares, q] : starts)
    if (std::isfinite(squares) && best.size() < wanted) best.push_back(q);
  return best;
}

std::optional<LeastSquaresFit> search_from(const std::vector<Eigen::VectorXd>& starts, Search& search,
                                           const FitProblem& problem, bool several_weights) {
  constexpr double rough = 1e-3;
  constexpr int few = 12;
  std::optional<LeastSquaresFit> best;
  for (const Eigen::VectorXd& start : starts) {
    LeastSquaresFit found = search.improve(start, rough, starts.size() > 1 ? few : 100);
    if (!std::isfinite(found.sum_of_squares) || found.jacobian.rows() != problem.rows()) continue;
    if (!best || found.sum_of_squares < best->sum_of_squares) best = std::move(found);
  }
  if (!best) return std::nullopt;
  constexpr double fine = 1e-8;
  constexpr int most_rounds = 12;
  constexpr double settled = 1e-3;
  for (int round = 0; round < most_rounds; ++round) {
    Eigen::VectorXd outputs;
    LeastSquaresFit next = search.improve(best->parameters, fine, 100);
    if (next.jacobian.rows() == problem.rows() && next.jacobian.allFinite()) best = std::move(next);
    if (!problem.outputs(best->parameters, outputs)) return std::nullopt;
    const double change = search.reweight(outputs, best->parameters.size());
    if (!several_weights || change < settled) break;
  }
  return best;
}

void describe_signals(const FitProblem& problem, const Eigen::VectorXd& misses, Fit& result) {
  double sum = 0.0;
  double count = 0.0;
  for (const SignalRows& rows : problem.signals()) {
    const Eigen::Index size = rows.end - rows.begin;
    const Eigen::VectorXd measured = problem.measured().segment(rows.begin, size);
    FittedSignal signal{.rows = rows, .rms = rms(misses.segment(rows.begin, size))};
    signal.range = rms(measured.array() - measured.mean());
    if (problem.signal(rows).noise > 0.0) {
      signal.noise = problem.signal(rows).noise;
      signal.noise_units = signal.rms / signal.noise;
      sum += signal.noise_units * signal.noise_units * static_cast<double>(size);
      count += static_cast<double>(size);
    }
    signal.independent = independent_samples(misses.segment(rows.begin, size), problem.signal(rows).is_sampled);
    result.log_likelihood_count += signal.independent;
    const double deviation = problem.signal(rows).is_stated ? problem.signal(rows).noise : signal.rms;
    constexpr double least = 1e-12;  // of exact data only rounding is left
    const double safe = std::max(deviation, least * signal.range + std::numeric_limits<double>::min());
    result.deviance +=
        static_cast<double>(size) * (2.0 * std::log(safe / signal.range) + signal.rms * signal.rms / (safe * safe));
    result.signals.push_back(signal);
  }
  result.deviance /= static_cast<double>(problem.rows());
  if (count > 0.0) result.noise_units = std::sqrt(sum / count);
}

}  // namespace

Fit fit_rig(const Rig& rig, std::vector<FitParameter> parameters, const Experiments& experiments,
            const FitOptions& options) {
  Fit result;
  result.rig = rig;
  const DataScale scale = scale_of(rig, experiments);
  std::vector<double> sizes;
  for (const FitParameter& parameter : parameters) sizes.push_back(size_of(parameter, scale));
  const FitProblem problem(rig, parameters, experiments, sizes);
  if (problem.rows() <= static_cast<Eigen::Index>(parameters.size())) {
    result.outcome = {core::OutcomeKind::not_identifiable, std::to_string(parameters.size()) +
                                                               " parameters need more than " +
                                                               std::to_string(problem.rows()) + " readings"};
    return result;
  }
  const bool all_stated =
      std::ranges::none_of(parameters, [](const FitParameter& parameter) { return std::isnan(parameter.stated); });
  result.starts = options.starts > 0 ? options.starts : all_stated ? 8 : 40;
  Search search(problem, options);
  const std::vector<Eigen::VectorXd> starts =
      parameters.empty() ? std::vector<Eigen::VectorXd>{Eigen::VectorXd(0)}
                         : best_starts(problem, search, parameters, sizes, result.starts, all_stated ? 2 : 5);
  const std::optional<LeastSquaresFit> found =
      starts.empty() ? std::nullopt
                     : search_from(starts, search, problem, options.robust || problem.signals().size() > 1);
  if (!found) {
    result.outcome = {core::OutcomeKind::not_identifiable,
                      "the rig has no such motion with any of " + std::to_string(result.starts) + " starts"};
    return result;
  }
  const Eigen::VectorXd& q = found->parameters;
  Eigen::MatrixXd jacobian;
  if (!problem.derivatives(q, result.outputs, jacobian)) {
    result.outcome = {core::OutcomeKind::not_identifiable, "the motion has no derivative at the estimate"};
    return result;
  }
  const Eigen::VectorXd values = problem.values(q);
  result.rig = with_values(rig, parameters, values).value_or(rig);
  result.own = problem.own(values);
  const Eigen::VectorXd misses = result.outputs - problem.measured();
  describe_signals(problem, misses, result);
  for (std::size_t i = 0; i < parameters.size(); ++i)
    result.parameters.push_back({.parameter = parameters[i], .value = values[static_cast<Eigen::Index>(i)]});
  add_uncertainty({problem, search.weights(), q, misses, jacobian, options.profile, options.robust}, result);
  return result;
}

Eigen::MatrixXd shared_covariance(const Fit& fit) {
  std::vector<Eigen::Index> shared;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    if (fit.parameters[i].parameter.owner != Owner::record) shared.push_back(static_cast<Eigen::Index>(i));
  const auto count = static_cast<Eigen::Index>(shared.size());
  Eigen::MatrixXd part(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j < count; ++j)
      part(i, j) = fit.covariance(shared[static_cast<std::size_t>(i)], shared[static_cast<std::size_t>(j)]);
  return part;
}

void compare_fits(std::vector<Fit>& fits) {
  const auto least =
      std::ranges::min_element(fits, {}, [](const Fit& fit) { return fit.outcome.ok() ? fit.deviance : infinity; });
  if (least == fits.end()) return;
  const double count = least->log_likelihood_count;
  for (Fit& fit : fits) {
    const double K = static_cast<double>(fit.parameters.size() + fit.signals.size());
    if (fit.outcome.ok() && count - K - 1.0 > 0.5)
      fit.AICc = count * fit.deviance + 2.0 * K + 2.0 * K * (K + 1.0) / (count - K - 1.0);
  }
}

}  // namespace dualdamp::identify
