#include <algorithm>
#include <cmath>

#include "identify/fit/fit.hpp"

namespace dualdamp::identify {

namespace {

/// Sums over signals, of all residuals relative to their signal.
struct RelativeSquare {
  double sum = 0.0;
  double count = 0.0;

  void add(const FittedSignal& signal) {
    const auto size = static_cast<double>(signal.rows.size());
    const double share = signal.rms / signal.range;
    sum += size * share * share;
    count += size;
  }
  [[nodiscard]] double root_mean() const { return std::sqrt(sum / count); }
};

}  // namespace

const FittedParameter* find_of_record(const Fit& fit, std::size_t record, RecordParameter which) {
  const auto found = std::ranges::find_if(
      fit.parameters, [&](const FittedParameter& fitted) { return fitted.parameter.is_of_record(record, which); });
  return found == fit.parameters.end() ? nullptr : &*found;
}

double relative_error(const Fit& fit) {
  RelativeSquare all;
  for (const FittedSignal& signal : fit.signals) all.add(signal);
  return all.root_mean();
}

std::vector<double> relative_errors(const Fit& fit, std::size_t experiments) {
  std::vector<RelativeSquare> of_each(experiments);
  for (const FittedSignal& signal : fit.signals) of_each[signal.rows.experiment].add(signal);
  std::vector<double> errors;
  for (const RelativeSquare& one : of_each) errors.push_back(one.root_mean());
  return errors;
}

SharedUncertainty shared_uncertainty(const Fit& fit) {
  std::vector<Eigen::Index> shared;
  for (std::size_t i = 0; i < fit.parameters.size(); ++i)
    if (fit.parameters[i].parameter.owner != Owner::record) shared.push_back(static_cast<Eigen::Index>(i));
  return {fit.covariance(shared, shared), fit.undetermined(shared, Eigen::all)};
}

}  // namespace dualdamp::identify
