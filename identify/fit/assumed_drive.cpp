#include "identify/fit/assumed_drive.hpp"

#include <vector>

namespace dualdamp::identify {

std::optional<UndrivenRecord> undriven_record(const Rig& rig, const Fit& held, const Experiments& data) {
  constexpr double part = 0.5;   // of the error under the drive
  constexpr double good = 0.25;  // of the motion: a rig at rest misses by all of it
  Rig undriven = rig;
  undriven.known.excitation = {};
  std::vector<FitParameter> of_records;
  for (std::size_t e = 0; e < data.size(); ++e)
    for (const RecordParameter each : data[e]->record_free)
      of_records.push_back(parameter_of_record(*data[e], e, each, data.size() == 1));
  const Fit fit = fit_rig(undriven, of_records, data, {.profile = false});
  if (!fit.outcome.ok()) return std::nullopt;
  const std::vector<double> with = relative_errors(held, data.size());
  const std::vector<double> without = relative_errors(fit, data.size());
  for (std::size_t e = 0; e < data.size(); ++e)
    if (without[e] < good && without[e] < part * with[e]) return UndrivenRecord{e, with[e], without[e]};
  return std::nullopt;
}

std::optional<std::size_t> record_with_unknown_drive(const Fit& held, const Experiments& data) {
  constexpr double part = 0.5;
  const auto size_of = [](const Eigen::VectorXd& values) {
    return (values.array() - values.mean()).matrix().norm();
  };
  for (const FittedSignal& fitted : held.signals) {
    const Experiment& experiment = *data[fitted.rows.experiment];
    const Eigen::Index quarter = fitted.rows.size() / 4;
    if (experiment.kind != ExperimentKind::history || quarter < 2) continue;
    const std::vector<double>& values = experiment.signals[fitted.rows.signal].measured;
    const Eigen::Map<const Eigen::VectorXd> measured(values.data(), static_cast<Eigen::Index>(values.size()));
    const double last = size_of(measured.tail(quarter));
    const double predicted = size_of(held.outputs.segment(fitted.rows.end - quarter, quarter));
    if (last > part * size_of(measured.head(quarter)) && predicted < part * last) return fitted.rows.experiment;
  }
  return std::nullopt;
}

}  // namespace dualdamp::identify
