#include "identify/fit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "identify/fit/residual_test.hpp"
#include "identify/fit/search.hpp"
#include "identify/fit/starts.hpp"
#include "identify/fit/uncertainty.hpp"

namespace dualdamp::identify {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double rms(const Eigen::VectorXd& part) { return std::sqrt(part.squaredNorm() / static_cast<double>(part.size())); }

void describe_signals(const FitProblem& problem, const Eigen::VectorXd& misses, Eigen::Index parameters,
                      Fit& result) {
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
    signal.p_value =
        noise_p_value(problem.signal(rows), misses.segment(rows.begin, size), static_cast<std::size_t>(parameters));
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
  const std::optional<SearchResult> found =
      search_parameters(problem, parameters, sizes,
                        {.points = result.starts, .most_starts = all_stated ? 2U : 3U, .robust = options.robust});
  if (!found) {
    result.outcome = {core::OutcomeKind::not_identifiable,
                      "the rig has no such motion with any of " + std::to_string(result.starts) + " starts"};
    return result;
  }
  const Eigen::VectorXd& q = found->coordinates;
  Eigen::MatrixXd jacobian;
  if (!problem.derivatives(q, result.outputs, jacobian)) {
    result.outcome = {core::OutcomeKind::not_identifiable, "the motion has no derivative at the estimate"};
    return result;
  }
  const Eigen::VectorXd values = problem.values(q);
  result.rig = with_values(rig, parameters, values).value_or(rig);
  result.own = problem.own(values);
  const Eigen::VectorXd misses = result.outputs - problem.measured();
  describe_signals(problem, misses, q.size(), result);
  warn_of_residuals(experiments, result);
  for (std::size_t i = 0; i < parameters.size(); ++i)
    result.parameters.push_back({.parameter = parameters[i], .value = values[static_cast<Eigen::Index>(i)]});
  add_uncertainty({problem, found->weights, q, misses, jacobian, options.profile, options.robust}, result);
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
