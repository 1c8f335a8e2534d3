#include "identify/fit/residual_warnings.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "identify/fit/residual_test.hpp"
#include "identify/records/spikes.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/median.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

namespace {

/// The SI unit of a signal: of an angle, if the coordinate of the rig is one.
std::string unit_of(const Signal& signal, const Fit& fit) {
  return core::unit_for(fit.rig.known.oscillator.coordinate, signal.unit);
}

std::string stated_noise_warning(const FittedSignal& fitted, const std::string& unit, const std::string& subject) {
  const double ratio = std::sqrt(fitted.chi2_per_freedom);
  const auto with_unit = [&](double value) { return core::format_number(value, 2) + " " + unit; };
  return subject + " are " + core::format_number(ratio, 2) + " times the stated noise (they scatter by " +
         with_unit(ratio * fitted.noise) + ", and " + with_unit(fitted.noise) + " is stated; chi-square " +
         core::format_number(fitted.chi2_per_freedom, 2) + " per degree of freedom): the stated noise is too " +
         (scatter_beside_stated(fitted) == ScatterBesideStated::less ? "large"
                                                                     : "small, or the law is not that of the rig");
}

std::string residuals_of(const Experiments& experiments, const FittedSignal& fitted) {
  return experiments[fitted.rows.experiment]->label + ": the residuals of " + signal_of(experiments, fitted).name;
}

/// Whether samples of a sensor drive the motion.
bool has_recorded_drive(const Experiment& experiment, const Fit& fit) {
  if (experiment.kind != ExperimentKind::history) return false;
  return drive_of(experiment, fit.rig).samples != nullptr;
}

/// Whether nothing drives a history.
bool is_undriven(const Experiment& experiment, const Fit& fit) {
  return experiment.kind == ExperimentKind::history &&
         drive_of(experiment, fit.rig).type == sim::ExcitationType::none;
}

/// Where noise that the residuals hold and their signal does not may come from, and what helps.
std::pair<std::string, std::string> foreign_noise(const Experiment& experiment, const Fit& fit) {
  if (experiment.kind != ExperimentKind::loop)
    return has_recorded_drive(experiment, fit)
               ? std::pair{"that of the measured drive", "measure the drive with less noise"}
               : std::pair{"", ""};
  const std::string source = "that of other signals of the record, which the law and the derivatives pass on";
  if (experiment.derived.empty()) return {source, "measure the motion with less noise"};
  const std::string& last = experiment.derived.back();
  if (experiment.derived.size() > 1) return {source, "measure v and a rather than x"};
  return {source, last + " is a derivative of " + (last == "a" ? "v" : "x") + ": measure " + last + " too, or " +
                      (last == "a" ? "v" : "x") + " with less noise"};
}

/// White residuals far above the noise of their signal come from somewhere else; the fit takes them for its noise.
std::string foreign_noise_warning(const Experiment& experiment, const FittedSignal& fitted, const Fit& fit,
                                  const std::string& subject) {
  const auto [source, help] = foreign_noise(experiment, fit);
  const auto before = [](const std::string& text, const char* joint) { return text.empty() ? "" : text + joint; };
  return subject + " are " + core::format_number(fitted.noise_units, 3) +
         " times the noise of that signal, though they look like noise: " + before(source, ", or ") +
         "outliers, or a search that missed the best fit. The estimates may be off by more than the intervals say; " +
         before(help, ", or ") + "try more starts, or 'robust' for outliers";
}

/// The mean of the residuals, in its standard errors, from which on a zero is off.
constexpr double most_mean_errors = 4.0;

/// The zero of a signal of a history, or of the force of a loop. Nothing if it is sought.
std::optional<RecordParameter> open_zero(const Experiments& experiments, const FittedSignal& fitted,
                                         const Fit& fit) {
  const ExperimentKind kind = experiments[fitted.rows.experiment]->kind;
  if (kind != ExperimentKind::history && kind != ExperimentKind::loop) return std::nullopt;
  const auto zero = std::ranges::find(sensor_zeros, signal_of(experiments, fitted).name, &SensorZero::signal);
  const bool is_sought =
      zero != sensor_zeros.end() && find_of_record(fit, fitted.rows.experiment, zero->which) != nullptr;
  return zero == sensor_zeros.end() || is_sought ? std::nullopt : std::optional(zero->which);
}

/// The zero of a signal of a history or a loop that its residuals speak of; nothing if they do not, or if it is
/// sought. `gain`: of this zero.
std::optional<RecordParameter> zero_off(const Experiments& experiments, const FittedSignal& fitted, double gain,
                                        const Fit& fit) {
  constexpr double third = 1.0 / 3.0;
  const bool is_mean =
      std::abs(fitted.mean_score) >= most_mean_errors &&
      (is_noise(fitted.p_value) || 2.0 * fitted.mean * fitted.mean >= fitted.rms_within * fitted.rms_within);
  if (!is_mean && (is_noise(fitted.p_value) || gain < third)) return std::nullopt;
  return open_zero(experiments, fitted, fit);
}

std::string zero_warning(const FittedSignal& fitted, RecordParameter zero, double gain,
                         const std::string& subject) {
  return subject + " have a mean of " + core::format_number(fitted.mean, 3) + " in SI units, " +
         (std::abs(fitted.mean_score) >= most_mean_errors
              ? core::format_number(std::abs(fitted.mean_score), 2) + " standard errors"
              : "and another zero would take away " + core::percent(gain, 2) + " of their sum of squares at once") +
         ": the zero of the sensor is off, or the law differs between the directions. Seek the zero: "
         "'free' with " +
         name_of(zero);
}

/// Correlation of each residual with the next one.
double lag_one_correlation(const Eigen::VectorXd& residuals) {
  const Eigen::Index count = residuals.size() - 1;
  if (count < 1 || residuals.squaredNorm() == 0.0) return 0.0;
  return residuals.head(count).dot(residuals.tail(count)) / residuals.squaredNorm();
}

/// Whether the residuals of samples change slowly at frequencies that the signal lacks, as a harmonic of it does.
/// The test for noise does not look there. Noise that has passed a filter is correlated as well.
bool is_slow(const Signal& signal, const FittedSignal& fitted) {
  constexpr double half = 0.5;
  return signal.is_sampled && !signal.filter && lag_one_correlation(fitted.misses) > half;
}

/// A drift of the force of a loop, in its unit over the record, if a line through the residuals takes away a third
/// of their sum of squares; else zero.
double drift_of(const Experiment& experiment, const FittedSignal& fitted) {
  const Eigen::Index count = fitted.misses.size();
  if (experiment.kind != ExperimentKind::loop || count < least_test_samples) return 0.0;
  const Eigen::VectorXd line = Eigen::VectorXd::LinSpaced(count, -0.5, 0.5);
  const Eigen::VectorXd rest = fitted.misses.array() - fitted.misses.mean();
  const double slope = -line.dot(rest) / line.squaredNorm();
  constexpr double third = 1.0 / 3.0;
  return slope * slope * line.squaredNorm() >= third * rest.squaredNorm() ? slope : 0.0;
}

std::string drift_warning(double drift, const std::string& unit, const std::string& subject) {
  return subject + " lie along a line that changes by " + core::format_number(drift, 3) + " " + unit +
         " in the record: the zero of the sensor drifts, or the friction does (modifier 'drift'). Take the drift out "
         "of the force, or fit parts of the record";
}

/// The zero among the possible causes; empty if it is sought.
std::string open_zero_cause(const Experiments& experiments, const FittedSignal& fitted, const Fit& fit) {
  if (drift_of(*experiments[fitted.rows.experiment], fitted) != 0.0) return "the zero of the sensor drifts, ";
  const std::optional<RecordParameter> zero = open_zero(experiments, fitted, fit);
  if (!zero) return {};
  return "the zero of the sensor is off ('free' with " + name_of(*zero) + " seeks it), ";
}

/// The forces that a fit to a loop takes as zero, because nothing states or seeks them; empty if there are none.
std::string open_forces_cause(const Experiment& experiment, const Fit& fit) {
  if (experiment.kind != ExperimentKind::loop) return {};
  const sim::Oscillator& known = fit.rig.known.oscillator;
  std::vector<std::string> names;
  for (const auto& [name, value] :
       {std::pair{"mass", known.mass}, {"stiffness", known.stiffness}, {"damping", known.damping}})
    if (std::isnan(value)) names.emplace_back(name);
  if (names.empty()) return {};
  const std::string list = core::joined(names);
  return "the force has a part of " + core::joined(names, " or ") +
         (names.size() == 1 ? ", which is" : ", which are") + " neither stated nor sought ('free' with " + list +
         " seeks " + (names.size() == 1 ? "it" : "them") + "), ";
}

}  // namespace

std::vector<std::string> contradictions_of_stated(const Experiments& experiments, const Fit& fit) {
  std::vector<std::string> texts;
  for (const FittedSignal& fitted : fit.signals)
    if (scatter_beside_stated(fitted) != ScatterBesideStated::as_stated)
      texts.push_back(stated_noise_warning(fitted, unit_of(signal_of(experiments, fitted), fit),
                                           residuals_of(experiments, fitted)));
  return texts;
}

std::vector<double> zero_gains_of(const FitProblem& problem, const Eigen::VectorXd& weights,
                                  const Eigen::VectorXd& misses, const Eigen::MatrixXd& jacobian) {
  const Eigen::MatrixXd basis = orthonormal_basis(weights.asDiagonal() * jacobian);
  const Eigen::VectorXd residuals = weights.cwiseProduct(misses);
  std::vector<double> gains;
  for (const SignalRows& rows : problem.readings().signals()) {
    const Eigen::Index size = rows.size();
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(residuals.size());
    shift.segment(rows.begin, size) =
        weights.segment(rows.begin, size).cwiseProduct(problem.readings().counted().segment(rows.begin, size));
    const double whole = shift.squaredNorm();
    shift -= basis * (basis.transpose() * shift);
    const double left = shift.squaredNorm();
    const double squares = residuals.segment(rows.begin, size).squaredNorm();
    constexpr double nothing = 1e-6;  // of a shift that the other parameters make up for
    gains.push_back(left > nothing * whole && squares > 0.0
                        ? std::min(1.0, std::pow(shift.dot(residuals), 2) / left / squares)
                        : 0.0);
  }
  return gains;
}

namespace {

/// Readings further from the fit than any noise, in their order: spikes of samples; of other readings one in ten.
std::vector<std::size_t> outliers_of(const Signal& signal, const Eigen::VectorXd& misses) {
  constexpr Eigen::Index fewest = 8;
  if (misses.size() < fewest || misses.size() != std::ssize(signal.measured)) return {};
  constexpr double far = 10.0;
  const Eigen::VectorXd sizes = misses.cwiseAbs();
  const double bound = far * median_deviation({sizes.begin(), sizes.end()});
  std::vector<std::size_t> found;
  if (signal.is_sampled) {
    for (const Spike& spike : spikes_of(signal.measured))
      if (sizes[static_cast<Eigen::Index>(spike.sample)] > bound) found.push_back(spike.sample);
    return found;
  }
  for (std::size_t i = 0; i < signal.measured.size(); ++i)
    if (sizes[static_cast<Eigen::Index>(i)] > bound) found.push_back(i);
  constexpr std::size_t one_in = 10;
  return one_in * found.size() > signal.measured.size() ? std::vector<std::size_t>{} : found;
}

std::string outlier_warning(const Signal& signal, const std::vector<std::size_t>& outliers,
                            const std::string& label, bool robust) {
  constexpr std::size_t most = 3;
  std::vector<std::string> places;
  for (const std::size_t i : outliers) {
    if (places.size() == most) break;
    places.push_back(core::format_number(signal.at[i], 4) + (signal.at_unit.empty() ? "" : " " + signal.at_unit));
  }
  const bool is_one = outliers.size() == 1;
  return label + ": " + std::to_string(outliers.size()) + (is_one ? " reading of " : " readings of ") +
         signal.name + (is_one ? " is an outlier" : " are outliers") + ", far from the fit beside all others (" +
         signal.at_name + " = " + core::joined(places) + (outliers.size() > most ? " and more" : "") +
         (robust
              ? std::string("); 'robust' limits the influence on the estimates")
              : std::string("), and move the estimates: correct or remove ") + (is_one ? "it" : "them") +
                    ", or limit the influence with 'robust'. Until then the residuals do not tell whether the law "
                    "is that of the rig");
}

/// Residuals of samples that hold motion, or of other readings that are too large or too similar.
std::string not_noise_warning(const Experiment& experiment, const Experiments& experiments,
                              const FittedSignal& fitted, const Fit& fit, const std::string& subject) {
  std::string text = subject;
  if (fitted.noise_units > 1.0) text += ", " + core::format_number(fitted.noise_units, 3) + " times the noise,";
  return text +
         (signal_of(experiments, fitted).is_sampled
              ? " are not noise: they hold motion that the fitted rig does not have."
              : " are not noise: they are too large or too similar from reading to reading.") +
         " The law is not that of the rig, a constant is wrong, " +
         (has_recorded_drive(experiment, fit) ? "the measured drive has noise, to which the rig responds, " : "") +
         (is_undriven(experiment, fit)
              ? "the mass was held or pushed at first, while the fit takes all samples for free motion, "
              : "") +
         open_forces_cause(experiment, fit) + open_zero_cause(experiments, fitted, fit) +
         "or the search missed the best fit (try more starts, bounds, stated values); the intervals hold only for "
         "the right law";
}

/// The noise by the roughness of a signal, if the fit did not use it: the residuals are far below it.
std::string coarse_samples_warning(const Signal& signal, const FittedSignal& fitted, const std::string& subject) {
  return subject + " are " + core::format_number(fitted.rms_within / signal.noise, 2) +
         " times the noise that the roughness of the samples shows: this is the motion between too few samples of a "
         "period, and 'noise_units' is left out. State the noise (sigma_" +
         signal.name + ")";
}

/// Few readings of a noise that is not known may pass every test although the fit is far from them. How much of the
/// amplitudes or extremes, or of a turn of phase, the fit misses, if that is more than a measurement would; else
/// empty.
std::string unexplained_part(const Signal& signal, const FittedSignal& fitted, const Eigen::VectorXd& measured) {
  constexpr double much = 0.05;
  constexpr double much_phase = 0.1;  // rad
  if (signal.is_sampled || signal.noise > 0.0) return {};
  if (signal.name == "phase" && fitted.rms_within > much_phase)
    return core::format_number(fitted.rms_within * 180.0 / std::numbers::pi, 2) + " deg";
  const double share = fitted.rms_within / std::sqrt(measured.squaredNorm() / static_cast<double>(measured.size()));
  return signal.name == "x" && share > much ? core::percent(share, 2) + " of the readings" : "";
}

std::string unexplained_warning(const std::string& part, const Signal& signal, const std::string& subject) {
  return subject + " are " + part +
         ": if the readings are more exact than that, the law is not that of the rig, a constant is wrong, or "
         "the search missed the best fit (try more starts, bounds, stated values). State the noise (sigma_" +
         signal.name + ")";
}

void warn_of_signal(const Experiments& experiments, bool robust, double zero_gain, const FittedSignal& fitted,
                    Fit& fit) {
  const Experiment& experiment = *experiments[fitted.rows.experiment];
  const Signal& signal = signal_of(experiments, fitted);
  const std::string subject = residuals_of(experiments, fitted);
  const ScatterBesideStated scatter = scatter_beside_stated(fitted);
  if (scatter != ScatterBesideStated::as_stated)
    fit.warnings.push_back(stated_noise_warning(fitted, unit_of(signal, fit), subject) +
                           (scatter == ScatterBesideStated::less
                                ? "; the intervals use it and are too wide by up to the same factor"
                                : "; the intervals are widened in proportion to the residuals"));
  const Eigen::VectorXd measured =
      Eigen::Map<const Eigen::VectorXd>(signal.measured.data(), static_cast<Eigen::Index>(signal.measured.size()));
  if (signal.noise > 0.0 && std::isnan(fitted.noise) && !is_rounding(fitted.misses, measured))
    fit.warnings.push_back(coarse_samples_warning(signal, fitted, subject));
  if (const auto outliers = outliers_of(signal, fitted.misses); !outliers.empty()) {
    fit.warnings.push_back(outlier_warning(signal, outliers, experiment.label, robust));
    if (!robust) return;
  }
  const double drift = drift_of(experiment, fitted);
  const std::optional<RecordParameter> zero =
      drift == 0.0 ? zero_off(experiments, fitted, zero_gain, fit) : std::nullopt;
  if (drift != 0.0) fit.warnings.push_back(drift_warning(drift, unit_of(signal, fit), subject));
  if (zero) fit.warnings.push_back(zero_warning(fitted, *zero, zero_gain, subject));
  constexpr double far = 2.0;
  const bool is_far = is_noise(fitted.p_value) && scatter == ScatterBesideStated::as_stated && signal.is_sampled &&
                      !robust && fitted.noise_units > far && !zero && drift == 0.0;
  if (is_far && !is_slow(signal, fitted))
    fit.warnings.push_back(foreign_noise_warning(experiment, fitted, fit, subject));
  // For readings that are not samples, `stated_noise_warning` has already reported residuals above the stated
  // noise.
  const bool is_told = !signal.is_sampled && scatter == ScatterBesideStated::more;
  if ((!is_noise(fitted.p_value) && !is_told) || (is_far && is_slow(signal, fitted)))
    fit.warnings.push_back(not_noise_warning(experiment, experiments, fitted, fit, subject));
  else if (const std::string part = unexplained_part(signal, fitted, measured); !part.empty())
    fit.warnings.push_back(unexplained_warning(part, signal, subject));
}

}  // namespace

void warn_of_residuals(const Experiments& experiments, bool robust, const std::vector<double>& zero_gains,
                       Fit& fit) {
  for (std::size_t s = 0; s < fit.signals.size(); ++s)
    warn_of_signal(experiments, robust, zero_gains[s], fit.signals[s], fit);
}

}  // namespace dualdamp::identify
