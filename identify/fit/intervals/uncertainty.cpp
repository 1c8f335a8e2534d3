#include "identify/fit/intervals/uncertainty.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/constants.hpp"
#include "identify/fit/freedom.hpp"
#include "identify/fit/intervals/profile.hpp"
#include "identify/fit/intervals/rivals.hpp"
#include "identify/fit/intervals/signal_variance.hpp"
#include "identify/fit/intervals/trade_offs.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/huber.hpp"
#include "identify/statistics/residual_covariance.hpp"

namespace dualdamp::identify {

namespace {

using core::infinity;

class Uncertainty {
 public:
  Uncertainty(const FitEnd& end, Fit& fit) : end_(end), fit_(fit), size_(end.q.size()) {}

  /// Coordinates with a smaller sum of squares, if a profile found any.
  [[nodiscard]] const std::optional<Eigen::VectorXd>& lower() const { return lower_; }

  void run() {
    scale_rows();
    for (Eigen::Index i = 0; i < size_; ++i) judge_bound(i);
    measure_variance();
    decompose();
    slope_ = end_.problem.space().slope(end_.q);
    fit_.covariance = propagated(slope_, covariance_);
    fit_.slopes = product(end_.jacobian, inverse_of(slope_));
    for (Eigen::Index i = 0; i < size_; ++i) quantiles_.push_back(quantile95(freedom_along(scaled_row(i))));
    for (Eigen::Index i = 0; i < size_; ++i) add_interval(i);
    for (FittedParameter& fitted : fit_.parameters) end_above_other(fitted);
    if (end_.profile || end_.problem.has_stepped()) add_profiles();
    for (Eigen::Index i = 0; i < size_; ++i) judge_profile(i);
    const auto limit = [this](Eigen::Index i) { return limit_of(i); };
    if (!end_.rivals.empty()) add_rivals(end_, Eigen::VectorXd::NullaryExpr(size_, limit), mean_variance(), fit_);
    add_trade_offs();
    add_undetermined();
    for (Eigen::Index i = 0; i < size_; ++i)
      if (needs_noise(scaled_row(i))) fit_.covariance.row(i).setZero(), fit_.covariance.col(i).setZero();
  }

 private:
  void scale_rows() {
    rows_ = end_.unbounded.asDiagonal() * end_.jacobian;
    residuals_ = end_.unbounded.cwiseProduct(end_.misses);
    if (end_.robust) residuals_ = huber_scores(residuals_);
    if (size_ > 0) strongest_ = effects(full_changes()).maxCoeff();
  }

  /// Whether a parameter is at a bound, and whether it counts among those with an effect.
  void judge_bound(Eigen::Index i) {
    const SearchCoordinate& c = end_.problem.space()[i];
    const bool low = c.is_low_end(end_.q[i]);
    const bool high = c.is_high_end(end_.q[i]);
    fit_.parameters[static_cast<std::size_t>(i)].at_bound = low || high;
    // At the end of a logarithmic range, most parameters have no effect any more: up to the largest value of the
    // search they change the readings by less than their noise. One with an effect widens the intervals of the
    // others.
    const double effect = rows_.col(i).norm();
    if (!(c.logarithmic && (low || high)) || effect * judged_change(i) >= 1.0) free_.push_back(i);
    if (effect * full_change(i) >= 1.0) warn_of_end(i, low, high);
  }

  /// The search goes no further than a number of decades from the size that the data suggest. An end that the law
  /// or the caller sets is no limit of the search: a force of zero says that there is none.
  void warn_of_end(Eigen::Index i, bool low, bool high) {
    const FittedParameter& fitted = fit_.parameters[static_cast<std::size_t>(i)];
    const friction::Range& range = fitted.parameter.range;
    const SearchCoordinate& c = end_.problem.space()[i];
    const bool low_of_search = c.logarithmic ? !(range.low > 0.0) : std::isinf(range.low);
    if (!(low && low_of_search) && !(high && std::isinf(range.high))) return;
    fit_.warnings.push_back(fitted.parameter.name +
                            " reached the limit of the search and still affects the fit "
                            "there: set 'bounds' or state a value");
  }

  /// A change of 100 % of a parameter, in coordinates.
  [[nodiscard]] double full_change(Eigen::Index i) const {
    const SearchCoordinate& c = end_.problem.space()[i];
    return c.logarithmic ? 1.0 : std::max(std::abs(end_.q[i]), small);
  }

  /// The change of a parameter, in coordinates, in which its part of a direction is judged: 100 %, or more if the
  /// effect of that is small, up to the largest value of the search. Within it a spring that is nearly zero makes
  /// up for all of a mass, which a factor e of it does not show.
  [[nodiscard]] double judged_change(Eigen::Index i) const {
    const SearchCoordinate& c = end_.problem.space()[i];
    if (!c.logarithmic) return full_change(i);
    constexpr double least = 0.1;
    const double effect = rows_.col(i).norm();
    const double wanted = effect > 0.0 ? least * strongest_ / effect : 1.0;
    return std::clamp(wanted, 1.0, std::max(1.0, std::exp(c.high - end_.q[i])));
  }

  /// A parameter that is so small that its own value is no measure of it.
  [[nodiscard]] bool is_near_zero(Eigen::Index i) const {
    const SearchCoordinate& c = end_.problem.space()[i];
    return (c.logarithmic ? std::exp(end_.q[i]) : std::abs(end_.q[i])) < small;
  }

  void measure_variance() {
    for (std::size_t s = 0; s < end_.problem.readings().signals().size(); ++s) {
      const SignalVariance found = signal_variance(end_, fit_.signals[s]);
      variances_.push_back(found.variance);
      freedoms_.push_back(found.freedom);
      is_open_.push_back(found.is_open);
    }
  }

  /// A parameter as a direction in parts of the judged changes.
  [[nodiscard]] Eigen::VectorXd scaled_row(Eigen::Index i) const {
    return slope_.row(i).transpose().cwiseProduct(judged_changes());
  }

  /// The part of each signal in the variance along a direction.
  [[nodiscard]] std::vector<double> variances_along(const Eigen::VectorXd& direction) const {
    std::vector<double> parts;
    for (const Eigen::MatrixXd& part : parts_) {
      const Eigen::VectorXd moved = part * direction;
      parts.push_back(std::max(0.0, direction.dot(moved)));
    }
    return parts;
  }

  [[nodiscard]] double freedom_along(const Eigen::VectorXd& direction) const {
    const std::vector<double> variances = variances_along(direction);
    const bool has_any = std::ranges::any_of(variances, [](double variance) { return variance > 0.0; });
    return has_any ? joint_freedom(variances, freedoms_) : *std::ranges::min_element(freedoms_);
  }

  /// Whether the variance along a direction has a part of signals whose noise is neither stated nor shown.
  [[nodiscard]] bool needs_noise(const Eigen::VectorXd& direction) const {
    constexpr double part = 1e-3;
    const std::vector<double> variances = variances_along(direction);
    double open = 0.0;
    for (std::size_t s = 0; s < variances.size(); ++s) open += is_open_[s] ? variances[s] : 0.0;
    return open > part * std::accumulate(variances.begin(), variances.end(), 0.0);
  }

  void decompose() {
    const auto free = static_cast<Eigen::Index>(free_.size());
    covariance_ = Eigen::MatrixXd::Zero(size_, size_);
    classical_ = covariance_;
    scaled_covariance_ = covariance_;
    if (free == 0) return;
    const Eigen::MatrixXd all_scaled = rows_ * judged_changes().asDiagonal();
    const Eigen::MatrixXd scaled = all_scaled(Eigen::all, free_);
    const SymmetricSpectrum normal = symmetric_spectrum(gram(scaled));
    for (Eigen::Index j = 0; j < free; ++j)
      if (!(normal.values[j] > singular * normal.values[free - 1]))
        lost_.push_back(vector_among_all(normal.vectors.col(j)));
    const Eigen::MatrixXd bread = regular_inverse(normal);
    Eigen::MatrixXd plain = Eigen::MatrixXd::Zero(free, free);
    for (std::size_t s = 0; s < variances_.size(); ++s) {
      const SignalRows& rows = end_.problem.readings().signals()[s];
      const Eigen::MatrixXd part = scaled.middleRows(rows.begin, rows.size());
      const Eigen::MatrixXd scores =
          score_covariance(part, residuals_.segment(rows.begin, rows.size()), variances_[s],
                           end_.problem.readings().signal(rows).is_sampled);
      parts_.push_back(matrix_among_all(
          product(product(bread, scores + doubt_of_weights(gram(part), bread, freedoms_[s])), bread)));
      scaled_covariance_ += parts_.back();
      plain += variances_[s] * gram(part);
    }
    const Eigen::VectorXd all = judged_changes();
    covariance_ = in_units(scaled_covariance_, all);
    classical_ =
        in_units(matrix_among_all(end_.robust ? bounded_inverse() : product(product(bread, plain), bread)), all);
  }

  /// The inverse of a normal matrix without its directions that are lost.
  [[nodiscard]] static Eigen::MatrixXd regular_inverse(const SymmetricSpectrum& normal) {
    const double least = singular * normal.values[normal.values.size() - 1];
    const Eigen::VectorXd inverse = (normal.values.array() > least).select(normal.values.cwiseInverse(), 0.0);
    return normal.matrix_with(inverse);
  }

  /// What takes the place of the classical covariance for the profiles of a robust fit, which keep the weights of
  /// its end: the sum of squares grows by these.
  [[nodiscard]] Eigen::MatrixXd bounded_inverse() const {
    const auto free = static_cast<Eigen::Index>(free_.size());
    Eigen::MatrixXd scaled = end_.weights.asDiagonal() * end_.jacobian(Eigen::all, free_);
    for (Eigen::Index j = 0; j < free; ++j) scaled.col(j) *= judged_change(free_[static_cast<std::size_t>(j)]);
    return mean_variance() * regular_inverse(symmetric_spectrum(gram(scaled)));
  }

  [[nodiscard]] Eigen::VectorXd full_changes() const {
    return Eigen::VectorXd::NullaryExpr(size_, [this](Eigen::Index i) { return full_change(i); });
  }

  [[nodiscard]] Eigen::VectorXd judged_changes() const {
    return Eigen::VectorXd::NullaryExpr(size_, [this](Eigen::Index i) { return judged_change(i); });
  }

  /// What belongs to the parameters with an effect, among all; zero elsewhere.
  [[nodiscard]] Eigen::VectorXd vector_among_all(const Eigen::VectorXd& part) const {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(size_);
    for (Eigen::Index j = 0; j < part.size(); ++j) all[free_[static_cast<std::size_t>(j)]] = part[j];
    return all;
  }

  [[nodiscard]] Eigen::MatrixXd matrix_among_all(const Eigen::MatrixXd& part) const {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(size_, size_);
    for (Eigen::Index a = 0; a < part.rows(); ++a)
      for (Eigen::Index b = 0; b < part.cols(); ++b)
        all(free_[static_cast<std::size_t>(a)], free_[static_cast<std::size_t>(b)]) = part(a, b);
    return all;
  }

  /// A parameter takes part in a direction with a part of its own, or with a part of the effects that cancel there.
  [[nodiscard]] bool is_lost(Eigen::Index i) const {
    constexpr double part = 0.01;
    return std::ranges::any_of(lost_, [&](const Eigen::VectorXd& direction) {
      const Eigen::VectorXd effect = effects(judged_changes().cwiseProduct(direction));
      const double least = std::max(rounding * strongest_, part * effect.maxCoeff());
      const auto takes_part = [&](Eigen::Index j) { return std::abs(direction[j]) > part || effect[j] > least; };
      for (Eigen::Index j = 0; j < size_; ++j)
        if (slope_(i, j) != 0.0 && takes_part(j)) return true;
      return false;
    });
  }

  /// Of each component of a change of the coordinates on the readings.
  [[nodiscard]] Eigen::VectorXd effects(const Eigen::VectorXd& change) const {
    return (rows_ * change.asDiagonal()).colwise().norm();
  }

  static bool is_alone(const Eigen::VectorXd& way, Eigen::Index i) { return std::abs(way[i]) > 0.99 * way.norm(); }

  /// Whether a parameter that is sought by its logarithm has, by itself, no effect near the estimate. It may have
  /// one further off, as an exponent of a sharp yield has, and others may trade off with it there.
  [[nodiscard]] bool is_flat(Eigen::Index i) const {
    return end_.profile && end_.problem.space()[i].logarithmic && !acts_in_steps(i) &&
           std::ranges::any_of(lost_, [i](const Eigen::VectorXd& direction) { return is_alone(direction, i); });
  }

  /// The flat parameter of a lost direction whose profile has an end; nothing if there is none.
  [[nodiscard]] std::optional<Eigen::Index> shown_further_off(const Eigen::VectorXd& direction) const {
    for (Eigen::Index i = 0; i < size_; ++i)
      if (is_alone(direction, i) && is_flat(i) &&
          !std::isnan(fit_.parameters[static_cast<std::size_t>(i)].interval95[0]))
        return i;
    return std::nullopt;
  }

  void add_interval(Eigen::Index i) {
    FittedParameter& fitted = fit_.parameters[static_cast<std::size_t>(i)];
    const SearchCoordinate& c = end_.problem.space()[i];
    if (fitted.at_bound) {
      fitted.reason = "it lies at the end of its range";
      return;
    }
    if (is_lost(i)) {
      fitted.reason = "the data do not determine it";
      return;
    }
    if (needs_noise(scaled_row(i))) {
      fitted.reason = "a signal has too few readings to show its noise, and its noise is not stated";
      return;
    }
    fitted.std = std::sqrt(std::max(fit_.covariance(i, i), 0.0));
    const double width = quantiles_[static_cast<std::size_t>(i)] * fitted.std;
    const auto& at_speed = fitted.parameter.at_speed;
    const bool grows_by_factors = c.logarithmic || (at_speed && at_speed->power.sought && fitted.value > 0.0);
    if (grows_by_factors && is_near_zero(i) && width > fitted.value) {
      fitted.interval95 = {0.0, fitted.value + width};
    } else if (grows_by_factors) {
      const double factor = std::exp(std::min(width / fitted.value, 100.0));
      fitted.interval95 = {fitted.value / factor, fitted.value * factor};
    } else {
      fitted.interval95 = {fitted.value - width, fitted.value + width};
    }
    const friction::Range& range = fitted.parameter.range;
    fitted.interval95[0] = std::max(fitted.interval95[0], range.low);
    fitted.interval95[1] = std::min(fitted.interval95[1], range.high);
  }

  /// A parameter that must not be below another one is at least at the low end of the interval of that one.
  void end_above_other(FittedParameter& fitted) const {
    if (!fitted.parameter.above || std::isnan(fitted.interval95[0])) return;
    const FittedParameter& other = fit_.parameters[*fitted.parameter.above];
    const double low = std::isnan(other.interval95[0]) ? other.value : other.interval95[0];
    fitted.interval95[0] = std::max(fitted.interval95[0], std::min(low, fitted.value));
  }

  /// Whether a parameter has no effect near the estimate: its effect may come in steps, from reading to reading.
  [[nodiscard]] bool acts_in_steps(Eigen::Index i) const { return rows_.col(i).norm() == 0.0; }

  /// Chooses between the interval by the profile and the interval by the covariance.
  void judge_profile(Eigen::Index i) {
    FittedParameter& fitted = fit_.parameters[static_cast<std::size_t>(i)];
    const auto& [low, high] = fitted.profile95;
    const bool ends = !std::isnan(low) && !std::isnan(high);
    const auto& above = fitted.parameter.above;
    const double least = above ? fit_.parameters[*above].value : fitted.parameter.range.low;
    if (ends && fitted.at_bound) fitted.interval95 = fitted.profile95;
    if (ends && is_flat(i) && (low > least || high < fitted.parameter.range.high)) {
      fitted.interval95 = fitted.profile95;
      fitted.reason = "it has no effect near the estimate: the interval is that of the profile";
    }
    if (ends && acts_in_steps(i) && !fitted.at_bound && low > least && high < fitted.parameter.range.high) {
      fitted.interval95 = fitted.profile95;
      fitted.reason =
          "its effect comes in steps, from reading to reading: it has an interval and no standard error";
      std::erase_if(lost_, [i](const Eigen::VectorXd& direction) { return is_alone(direction, i); });
      take_variance_of_interval(i);
    } else if (end_.profile && ends && fitted.std > 0.0 && bends(fitted, quantiles_[static_cast<std::size_t>(i)])) {
      fitted.interval95 = fitted.profile95;
      fitted.reason = "the sum of squares is not a parabola: the interval is that of the profile";
    } else if (end_.profile && !end_.problem.is_exhausted() && !ends && fitted.std > 0.0) {
      fitted.reason = "the profile does not end: the interval by the covariance holds near the estimate only";
    }
  }

  /// Gives a parameter without derivatives the variance of its interval: what its covariance holds is rounding.
  void take_variance_of_interval(Eigen::Index i) {
    constexpr double deviations = 3.92;  // in 95 % of a normal distribution
    const auto& [low, high] = fit_.parameters[static_cast<std::size_t>(i)].interval95;
    fit_.covariance.row(i).setZero(), fit_.covariance.col(i).setZero();
    fit_.covariance(i, i) = std::pow((high - low) / deviations, 2);
  }

  /// Of the square root by which the sum of squares grows to an end of the interval. Correlated residuals widen it
  /// as they widen the covariance.
  [[nodiscard]] double limit_of(Eigen::Index i) const {
    const double variance = variance_along(slope_.row(i), classical_);
    const bool is_at_bound = fit_.parameters[static_cast<std::size_t>(i)].at_bound;
    const double widening = is_at_bound || is_flat(i) || !(variance > 0.0) ? 1.0 : fit_.covariance(i, i) / variance;
    return quantiles_[static_cast<std::size_t>(i)] * std::sqrt(widening * mean_variance());
  }

  void add_profiles() {
    const Eigen::MatrixXd rows = end_.weights.asDiagonal() * end_.jacobian;
    const Eigen::VectorXd residuals = end_.weights.cwiseProduct(end_.misses);
    const Profiler profiler(end_.problem, end_.weights, end_.q, rows, residuals, end_.motions);
    Eigen::VectorXd limits = Eigen::VectorXd::Zero(size_);
    Profiler::for_each(size_, [&](Eigen::Index i) {
      FittedParameter& fitted = fit_.parameters[static_cast<std::size_t>(i)];
      if ((is_lost(i) && !acts_in_steps(i) && !is_flat(i)) || (fitted.at_bound && free_.empty())) return;
      if (needs_noise(scaled_row(i))) return;
      // What acts in steps has no other interval.
      if (!end_.profile && !end_.problem.is_stepped(i)) return;
      limits[i] = limit_of(i);
      fitted.profile95 = profiler.interval(i, fitted, limits[i]);
    });
    profiler.widen(fit_.parameters, limits);
    if (!end_.problem.is_exhausted()) lower_ = profiler.lower();
    // Some of them have ended; which ones depends on the number of threads.
    if (end_.problem.is_exhausted() || profiler.are_in_vain())
      for (FittedParameter& fitted : fit_.parameters) fitted.profile95 = {unknown, unknown};
    if (end_.problem.is_exhausted())
      fit_.warnings.emplace_back(
          "the search for profiles was cut short: their motions took too many steps, and no parameter has one");
  }

  [[nodiscard]] double mean_variance() const {
    return std::accumulate(variances_.begin(), variances_.end(), 0.0) / static_cast<double>(variances_.size());
  }

  void add_trade_offs() {
    std::vector<FitParameter> parameters;
    for (const FittedParameter& fitted : fit_.parameters) parameters.push_back(fitted.parameter);
    const core::Coordinate coordinate = fit_.rig.known.oscillator.coordinate;
    Eigen::VectorXd near_zero = Eigen::VectorXd::Zero(size_);
    for (Eigen::Index i = 0; i < size_; ++i)
      if (is_near_zero(i)) near_zero[i] = slope_(i, i) * full_change(i);
    const auto add = [&](const Eigen::VectorXd& direction, double deviation) {
      const Eigen::VectorXd change = full_changes().cwiseProduct(direction);
      std::optional<TradeOff> found = trade_off({slope_ * change, direction, effects(change), deviation,
                                                 rounding * strongest_, near_zero, reaches(fit_.parameters)},
                                                parameters, coordinate);
      if (found) fit_.not_identifiable.push_back(std::move(*found));
    };
    const Eigen::VectorXd ratio = judged_changes().cwiseQuotient(full_changes());
    for (const Eigen::VectorXd& direction : lost_) {
      const std::optional<Eigen::Index> flat = shown_further_off(direction);
      if (flat)
        fit_.not_identifiable.push_back(
            known_further_off(fit_.parameters[static_cast<std::size_t>(*flat)], coordinate));
      else
        add(ratio.cwiseProduct(direction).normalized(), infinity);
    }
    if (free_.empty()) return;
    const SymmetricSpectrum spectrum = symmetric_spectrum(in_units(scaled_covariance_, ratio));
    for (Eigen::Index j = size_ - 1; j >= 0; --j) {
      const Eigen::VectorXd direction = spectrum.vectors.col(j);
      const Eigen::VectorXd in_judged_changes = ratio.cwiseProduct(direction);
      const double deviation = std::sqrt(std::max(spectrum.values[j], 0.0));
      if (!needs_noise(in_judged_changes) && quantile95(freedom_along(in_judged_changes)) * deviation > 1.0)
        add(direction, deviation);
    }
  }

  void add_undetermined() {
    fit_.undetermined.resize(size_, static_cast<Eigen::Index>(lost_.size()));
    for (std::size_t j = 0; j < lost_.size(); ++j) {
      const Eigen::VectorXd direction = (lost_[j].array().abs() > rounding).select(lost_[j], 0.0);
      fit_.undetermined.col(static_cast<Eigen::Index>(j)) = slope_ * judged_changes().cwiseProduct(direction);
    }
  }

  /// A value below this part of its size is near zero.
  static constexpr double small = 0.1;

  /// A direction with a smaller part of the largest square of an effect is lost.
  static constexpr double singular = 1e-12;

  /// Of a direction of length 1, and of the strongest effect.
  static constexpr double rounding = 1e-4;

  const FitEnd& end_;
  Fit& fit_;
  Eigen::Index size_;
  std::vector<Eigen::Index> free_;      ///< parameters with an effect
  Eigen::MatrixXd rows_;                ///< jacobian over the deviations
  Eigen::VectorXd residuals_;           ///< over the deviations; bounded in a robust fit
  std::vector<double> variances_;       ///< of the weighted residuals of each signal
  std::vector<double> freedoms_;        ///< of these; infinite: stated
  std::vector<bool> is_open_;           ///< the noise of the signal is neither stated nor shown
  Eigen::MatrixXd slope_;               ///< d(values)/d(coordinates)
  Eigen::MatrixXd covariance_;          ///< of coordinates
  Eigen::MatrixXd classical_;           ///< the same for independent residuals
  Eigen::MatrixXd scaled_covariance_;   ///< in parts of the judged changes
  std::vector<Eigen::MatrixXd> parts_;  ///< of each signal in `scaled_covariance_`
  std::vector<Eigen::VectorXd> lost_;   ///< directions that change nothing, in the same parts
  double strongest_ = 0.0;              ///< largest effect of a change of 100 %
  std::vector<double> quantiles_;       ///< of each parameter
  std::optional<Eigen::VectorXd> lower_;
};

}  // namespace

std::optional<Eigen::VectorXd> add_uncertainty(const FitEnd& end, Fit& fit) {
  Uncertainty uncertainty(end, fit);
  uncertainty.run();
  return uncertainty.lower();
}

}  // namespace dualdamp::identify
