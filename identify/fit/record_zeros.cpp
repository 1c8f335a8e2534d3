#include "identify/fit/record_zeros.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/coordinate.hpp"
#include "core/numbers.hpp"

namespace dualdamp::identify {

namespace {

bool has_zero(const Experiment& experiment, const SensorZero& zero) {
  return std::ranges::find(experiment.signals, zero.signal, &Signal::name) != experiment.signals.end() &&
         std::ranges::find(experiment.record_others, zero.which) != experiment.record_others.end();
}

const FittedParameter* find_zero(const Fit& fit, const RecordZero& zero) {
  return find_of_record(fit, zero.experiment, zero.which);
}

std::string text_of(const Rig& rig, const Experiment& experiment, const FittedParameter& zero, bool is_alone) {
  const core::Coordinate coordinate = rig.known.oscillator.coordinate;
  const auto with_unit = [&](double value, int digits, const std::string& unit) {
    return core::format_number(value, digits) + " " + core::unit_for(coordinate, unit);
  };
  constexpr int digits = 4;
  const RecordParameter which = zero.parameter.record_parameter;
  std::string text = is_alone ? "" : experiment.label + ": ";
  text += "the zero of " + std::string(std::ranges::find(sensor_zeros, which, &SensorZero::which)->signal) +
          " is fitted to this record, " + with_unit(zero.value, digits, zero.parameter.unit);
  if (!std::isnan(zero.std)) text += " with a standard error of " + with_unit(zero.std, 2, zero.parameter.unit);
  const double force = rig.known.oscillator.stiffness * zero.value;
  if (which == RecordParameter::offset && std::isfinite(force) && force != 0.0)
    text += " (a constant force on the mass of " + with_unit(force, 3, "N") + " would do the same)";
  return text;
}

}  // namespace

std::vector<FitParameter> parameters_of_records(const Rig& rig, const Experiments& experiments,
                                                const std::vector<RecordZero>& zeros) {
  std::vector<FitParameter> list;
  const bool placed = feels_position(rig, {});
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    std::vector<RecordParameter> sought = sought_of_record(*experiments[e], placed);
    for (const RecordZero& zero : zeros)
      if (zero.experiment == e && std::ranges::find(sought, zero.which) == sought.end())
        sought.push_back(zero.which);
    for (const RecordParameter each : sought)
      list.push_back(parameter_of_record(*experiments[e], e, each, experiments.size() == 1));
  }
  return list;
}

std::vector<RecordZero> zeros_sought_in(const std::vector<FitParameter>& parameters,
                                        const Experiments& experiments) {
  std::vector<RecordZero> zeros;
  for (std::size_t e = 0; e < experiments.size(); ++e)
    for (const SensorZero& zero : sensor_zeros)
      if (has_zero(*experiments[e], zero) && std::ranges::any_of(parameters, [&](const FitParameter& parameter) {
            return parameter.owner == Owner::record && parameter.record_parameter == zero.which;
          }))
        zeros.push_back({e, zero.which});
  return zeros;
}

std::vector<RecordZero> zeros_that_are_off(const Rig& rig, const Experiments& experiments, const Fit& held,
                                           const std::vector<RecordZero>& sought, const FitOptions& options) {
  std::vector<RecordZero> all = sought;
  for (std::size_t e = 0; e < experiments.size(); ++e)
    for (const SensorZero& zero : sensor_zeros)
      if (has_zero(*experiments[e], zero) && find_zero(held, {e, zero.which}) == nullptr &&
          std::ranges::find(all, RecordZero{e, zero.which}) == all.end())
        all.push_back({e, zero.which});
  if (all.size() == sought.size()) return {};
  const Fit shifted = fit_rig(rig, parameters_of_records(rig, experiments, all), experiments, options);
  constexpr double half = 0.5;
  if (!shifted.outcome.ok() || !(std::pow(relative_error(shifted) / relative_error(held), 2) < half)) return {};
  constexpr double least = 4.0;
  std::erase_if(all, [&](const RecordZero& zero) {
    const FittedParameter* found = find_zero(shifted, zero);
    return std::ranges::find(sought, zero) != sought.end() || found == nullptr ||
           !(std::abs(found->value) > least * found->std);
  });
  return all;
}

std::string text_of_zeros(const Rig& rig, const Experiments& experiments, const Fit& held,
                          const std::vector<RecordZero>& zeros, const FitOptions& options) {
  std::string text;
  for (const RecordZero& zero : zeros) {
    const FittedParameter* found = find_zero(held, zero);
    if (found == nullptr) continue;
    text += "; " + text_of(rig, *experiments[zero.experiment], *found, experiments.size() == 1);
  }
  if (text.empty()) return text;
  const Fit without = fit_rig(rig, parameters_of_records(rig, experiments, {}), experiments, options);
  if (!without.outcome.ok()) return text;
  text += "; with no zero but 0, the prediction misses by " + core::percent(relative_error(without), 3);
  if (!std::isnan(without.noise_units))
    text += ", " + core::format_number(without.noise_units, 3) + " times the noise";
  return text;
}

}  // namespace dualdamp::identify
