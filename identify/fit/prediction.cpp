#include "identify/fit/prediction.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>

#include "core/numbers.hpp"
#include "identify/fit/record_zeros.hpp"
#include "identify/fit/residual_warnings.hpp"
#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

namespace {

/// Whether a change of the parameters along a direction that the fit does not determine has an effect.
bool shows_undetermined(const Eigen::MatrixXd& by_rig, const Eigen::MatrixXd& undetermined) {
  constexpr double least = 1e-4;  // of the signals, for a change of 100 %
  if (undetermined.rows() != by_rig.cols() || undetermined.cols() == 0) return false;
  const double readings = std::sqrt(static_cast<double>(by_rig.rows()));
  return (by_rig * undetermined).colwise().norm().maxCoeff() > least * readings;
}

/// rms error of the outputs from the uncertainty of the rig's parameters, relative to the signals. `shared`: these
/// parameters, each stated as the rig has it.
double uncertainty_of(const Fit& held, const Rig& rig, const std::vector<FitParameter>& shared,
                      const SharedUncertainty& known, const Experiments& experiments) {
  const auto count = static_cast<Eigen::Index>(shared.size());
  if (count == 0) return 0.0;
  if (known.covariance.rows() != count) return unknown;
  const std::vector<FitParameter> all = with_own_parameters(shared, held);
  Eigen::VectorXd values(static_cast<Eigen::Index>(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) values[static_cast<Eigen::Index>(i)] = all[i].stated;
  const FitProblem problem(rig, all, experiments, sizes_of_stated(all), held.of_records);
  const Eigen::VectorXd q = problem.space().point(values);
  Eigen::VectorXd outputs;
  Eigen::MatrixXd jacobian;
  if (!problem.derivatives(q, outputs, jacobian)) return unknown;
  jacobian = product(jacobian, inverse_of(problem.space().slope(q)));
  for (const FittedSignal& signal : held.signals)
    jacobian.middleRows(signal.rows.begin, signal.rows.size()) /= signal.range;
  Eigen::MatrixXd by_rig = jacobian.leftCols(count);
  // The record's own parameters are fitted, so the changes that they can compensate are no error.
  if (const Eigen::MatrixXd own = jacobian.rightCols(jacobian.cols() - count); own.cols() > 0) {
    const Eigen::MatrixXd basis = orthonormal_basis(own);
    by_rig -= product(basis, product(basis.transpose(), by_rig));
  }
  if (shows_undetermined(by_rig, known.undetermined)) return unknown;
  double sum = 0.0;
  for (Eigen::Index i = 0; i < by_rig.rows(); ++i) sum += variance_along(by_rig.row(i), known.covariance);
  return std::sqrt(std::max(sum, 0.0) / static_cast<double>(by_rig.rows()));
}

/// The error of the first sampled signal, in octaves of frequency.
std::vector<PredictionBand> bands_of(const Fit& held, const Experiments& experiments) {
  const auto sampled = std::ranges::find_if(
      held.signals, [&](const FittedSignal& signal) { return signal_of(experiments, signal).is_sampled; });
  if (sampled == held.signals.end()) return {};
  const Signal& signal = signal_of(experiments, *sampled);
  const Eigen::Index count = sampled->rows.size();
  constexpr Eigen::Index least = 64;
  if (count < least) return {};
  const double rate = static_cast<double>(count - 1) / (signal.at.back() - signal.at.front());
  Eigen::VectorXd residual(count);
  for (Eigen::Index i = 0; i < count; ++i)
    residual[i] = held.outputs[sampled->rows.begin + i] - signal.measured[static_cast<std::size_t>(i)];
  // Haar wavelets: the sums of neighbours have the lower half of the band, the differences the upper half. The
  // squares add up to those of the residual.
  std::vector<PredictionBand> bands;
  double upper = 0.5 * rate;
  const double total = residual.squaredNorm();
  const double whole = sampled->range * std::sqrt(static_cast<double>(count));
  const auto add = [&](double from, double to, double squares) {
    bands.push_back({from, to, std::sqrt(squares) / whole,
                     sampled->noise > 0.0 ? std::sqrt(squares / static_cast<double>(count)) / sampled->noise /
                                                std::sqrt((to - from) / (0.5 * rate))
                                          : unknown});
  };
  double left = total;
  constexpr std::size_t most = 6;
  while (residual.size() >= least && bands.size() + 1 < most) {
    const Eigen::Index half = residual.size() / 2;
    Eigen::VectorXd sums(half);
    double squares = 0.0;
    for (Eigen::Index i = 0; i < half; ++i) {
      sums[i] = (residual[2 * i] + residual[2 * i + 1]) / std::numbers::sqrt2;
      const double difference = (residual[2 * i] - residual[2 * i + 1]) / std::numbers::sqrt2;
      squares += difference * difference;
    }
    add(0.5 * upper, upper, squares);
    left -= squares;
    upper *= 0.5;
    residual = sums;
  }
  add(0.0, upper, std::max(left, 0.0));
  std::ranges::reverse(bands);
  return bands;
}

/// Whether residuals above the noise are correlated from sample to sample.
bool lasts(const Fit& fit) {
  constexpr double share = 0.5;
  return std::ranges::any_of(fit.signals, [](const FittedSignal& signal) {
    return signal.noise_units > 1.0 && signal.independent < share * signal.white;
  });
}

/// Residuals of a right law, over the noise.
constexpr double most_noise_units = 1.2;

void judge(Prediction& found, const Fit& attainable) {
  // The chance is small, and the error exceeds the attainable error by more than a tenth.
  constexpr double level = 1e-3;
  constexpr double share = 1.1;
  const bool does_not_carry_over = found.compromise.p_value < level && found.error > share * found.attainable;
  // Noise is not correlated from sample to sample; the residuals of a wrong law are.
  const bool cannot = attainable.noise_units > most_noise_units && lasts(attainable);
  found.is_wrong = does_not_carry_over || cannot;
  found.text = "the prediction misses by " + core::percent(found.error, 3) + " of the motion";
  if (!std::isnan(found.noise_units))
    found.text += ", " + core::format_number(found.noise_units, 3) + " times the noise";
  found.text += "; fitted to this record itself, the same laws miss by " + core::percent(found.attainable, 3);
  if (cannot)
    found.text +=
        ": the law is wrong here, or a stated constant, the drive or a sensor: even the fit to this record leaves " +
        core::format_number(attainable.noise_units, 3) + " times the noise";
  else if (does_not_carry_over)
    found.text +=
        ": the law is wrong, or the rig has changed: no single set of parameters agrees with both records "
        "(chance " +
        core::format_number(found.compromise.p_value, 2) + ")";
  else
    found.text += ": the law also describes this record" +
                  (found.error > share * found.attainable && found.uncertainty > 0.0
                       ? "; the standard errors of the fit make an error of " + core::percent(found.uncertainty, 3)
                       : std::string());
}

/// The load of the contacts of a record in a fit.
struct Load {
  std::optional<FitParameter> sought{};
  double travel = 0.0;

  [[nodiscard]] bool is_none() const { return !sought && travel == 0.0; }
};

Load load_of(const Fit& fit, std::size_t record) {
  Load load{.travel = fit.of_records[record][RecordParameter::travel]};
  if (const FittedParameter* fitted = find_of_record(fit, record, RecordParameter::travel)) {
    load.sought = fitted->parameter;
    load.sought->stated = load.travel;
  }
  return load;
}

/// Whether one fit seeks the load of the contacts at a first sample, and the other one does not.
bool loads_differ(const Fit& one, const Fit& other, std::size_t records) {
  for (std::size_t e = 0; e < records; ++e) {
    const Load a = load_of(one, e);
    const Load b = load_of(other, e);
    if (a.sought.has_value() != b.sought.has_value() || (!a.sought && a.travel != b.travel)) return true;
  }
  return false;
}

/// The loads for both fits: those of the prediction, or if it found none, those of the other fit.
struct Loads {
  std::vector<RecordValues> known;
  std::vector<FitParameter> sought;
};

Loads loads_of_both(const Fit& held, const Fit& alone, const Experiments& experiments) {
  Loads loads;
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    Load load = load_of(held, e);
    if (load.is_none()) load = load_of(alone, e);
    loads.known.push_back(experiments[e]->record_start);
    if (load.sought)
      loads.sought.push_back(*load.sought);
    else
      loads.known.back()[RecordParameter::travel] = load.travel;
  }
  return loads;
}

/// The parameters that belong to no record, each stated as the rig has it.
std::vector<FitParameter> at_values_of(const Rig& rig, const std::vector<FitParameter>& parameters) {
  std::vector<FitParameter> list;
  const std::vector<FitParameter> now = parameters_of(rig);
  for (const FitParameter& parameter : parameters) {
    if (parameter.owner == Owner::record) continue;
    std::string fault;
    const std::vector<FitParameter> same = named(now, parameter.name, fault);
    list.push_back(parameter);
    if (same.size() == 1) list.back().stated = same.front().stated;
  }
  return list;
}

/// Predicts records with one rig, for one set of zeros or another among their own parameters.
class RecordPredictor {
 public:
  /// `options` are those of each fit. The other arguments must outlive this.
  RecordPredictor(const Rig& rig, const std::vector<FitParameter>& parameters, const SharedUncertainty& known,
                  const Experiments& experiments, const FitOptions& options)
      : rig_(rig),
        shared_(at_values_of(rig, parameters)),
        known_(known),
        experiments_(experiments),
        options_(options) {}

  [[nodiscard]] Prediction with(const std::vector<RecordZero>& zeros, const Refusal& refuses) const {
    Prediction found;
    const std::vector<FitParameter> of_records = parameters_of_records(rig_, experiments_, zeros);
    found.fit = fit_rig(rig_, of_records, experiments_, options_);
    if (!found.fit.outcome.ok()) {
      found.outcome = found.fit.outcome;
      found.text = found.outcome.reason;
      return found;
    }
    found.error = relative_error(found.fit);
    if (std::isnan(found.error)) {
      found.text = "the record holds no motion to predict";
      return found;
    }
    if (std::string refusal = refuses ? refuses(found.fit) : std::string(); !refusal.empty()) {
      found.outcome = {core::OutcomeKind::not_identifiable, std::move(refusal)};
      found.text = found.outcome.reason;
      return found;
    }
    describe(found);
    Fit attainable = fit_rig(rig_, beside_shared(of_records), experiments_, options_);
    if (!attainable.outcome.ok()) {
      found.text = "the record alone does not determine the rig: " + attainable.outcome.reason;
      return found;
    }
    if (loads_differ(found.fit, attainable, experiments_.size()))
      fit_with_same_loads(of_records, found, attainable);
    // If the search ended at a worse place than the prediction, the prediction itself is the best fit.
    const Fit& best = relative_error(attainable) < found.error ? attainable : found.fit;
    found.attainable = relative_error(best);
    found.warnings = contradictions_of_stated(experiments_, best);
    found.attainable_noise_units = best.noise_units;
    found.compromise = compromise_of({rig_, shared_, known_}, experiments_, found.fit, attainable);
    judge(found, best);
    return found;
  }

 private:
  [[nodiscard]] std::vector<FitParameter> beside_shared(const std::vector<FitParameter>& of_records) const {
    std::vector<FitParameter> all = shared_;
    std::ranges::copy(of_records, std::back_inserter(all));
    return all;
  }

  void describe(Prediction& found) const {
    found.error = relative_error(found.fit);
    found.noise_units = found.fit.noise_units;
    found.bands = bands_of(found.fit, experiments_);
    found.uncertainty = uncertainty_of(found.fit, rig_, shared_, known_, experiments_);
  }

  /// Fits the prediction and the rig again, now with the same loads of contacts; both stay if one cannot be fitted.
  void fit_with_same_loads(std::vector<FitParameter> of_records, Prediction& found, Fit& attainable) const {
    const Loads loads = loads_of_both(found.fit, attainable, experiments_);
    std::ranges::copy(loads.sought, std::back_inserter(of_records));
    FitOptions options = options_;
    options.seeks_loads = false;
    options.known = loads.known;
    Fit held = fit_rig(rig_, of_records, experiments_, options);
    Fit alone = fit_rig(rig_, beside_shared(of_records), experiments_, options);
    if (!held.outcome.ok() || !alone.outcome.ok()) return;
    found.fit = std::move(held);
    attainable = std::move(alone);
    describe(found);
  }

  const Rig& rig_;
  std::vector<FitParameter> shared_;  ///< that belong to no record, each stated as the rig has it
  const SharedUncertainty& known_;
  const Experiments& experiments_;
  const FitOptions& options_;
};

/// Whether a prediction leaves more than noise.
bool leaves_more(const Prediction& found) {
  return found.outcome.ok() && !std::isnan(found.error) &&
         (found.is_wrong || (found.noise_units > most_noise_units && lasts(found.fit)));
}

}  // namespace

Prediction predict_records(const Rig& rig, const std::vector<FitParameter>& parameters,
                           const SharedUncertainty& known, const Experiments& experiments,
                           const FitOptions& options, const Refusal& refuses) {
  FitOptions quick = options;
  quick.profile = false;
  std::vector<RecordZero> zeros = zeros_sought_in(parameters, experiments);
  const RecordPredictor predictor(rig, parameters, known, experiments, quick);
  Prediction found = predictor.with(zeros, refuses);
  if (leaves_more(found)) {
    const std::vector<RecordZero> off = zeros_that_are_off(rig, experiments, found.fit, zeros, quick);
    if (!off.empty()) {
      std::ranges::copy(off, std::back_inserter(zeros));
      Prediction shifted = predictor.with(zeros, refuses);
      if (shifted.outcome.ok() && shifted.error < found.error) found = std::move(shifted);
    }
  }
  if (found.outcome.ok() && !std::isnan(found.error))
    found.text += text_of_zeros(rig, experiments, found.fit, zeros, quick);
  return found;
}

}  // namespace dualdamp::identify
