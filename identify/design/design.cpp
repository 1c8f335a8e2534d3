#include "identify/design/design.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "core/numbers.hpp"
#include "identify/methods/any_law/decay_readings.hpp"
#include "identify/methods/any_law/steady_readings.hpp"
#include "identify/statistics/distributions.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::identify {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Fits worse than the best one of their law by more than this take no part.
constexpr double reach = 12.0;

/// What a law at one severity expects of a measurement, over the deviations of its readings.
struct Expectation {
  const SeverityFit* fit = nullptr;
  VectorXd readings;
  MatrixXd slopes;
};

/// One law that the record allows.
struct Rival {
  const LawFits* law = nullptr;
  double weight = 0.0;                ///< in the average over laws
  double density = 0.0;               ///< weight over the sum of the likelihoods of its points
  std::vector<Expectation> points{};  ///< by severity
  std::size_t best = 0;
};

/// Rejecting a normal variate of this distance from zero at 5 %.
double power_at(double chi2) {
  constexpr double limit = 1.959963984540054;
  const double distance = std::sqrt(std::max(chi2, 0.0));
  const auto below = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
  return below(distance - limit) + below(-distance - limit);
}

/// Covariance of the measurement's unknowns after the record: those it shares with the record as there, its own by
/// their priors.
MatrixXd covariance_for(const ReadingModel& record, const SeverityFit& fit, const ReadingModel& planned) {
  MatrixXd covariance = MatrixXd::Zero(planned.unknowns(), planned.unknowns());
  covariance.topLeftCorner(2, 2) = fit.covariance.topLeftCorner(2, 2);
  const std::vector<Nuisance>& own = planned.nuisances();
  const bool shared = !record.nuisances().empty() && record.nuisances().front().name == own.front().name;
  if (shared) return fit.covariance;
  for (std::size_t j = 0; j < own.size(); ++j) {
    const auto place = 2 + static_cast<Index>(j);
    covariance(place, place) = own[j].deviation * own[j].deviation;
  }
  return covariance;
}

VectorXd unknowns_for(const ReadingModel& record, const SeverityFit& fit, const ReadingModel& planned) {
  VectorXd unknowns = VectorXd::Zero(planned.unknowns());
  const bool shared =
      !record.nuisances().empty() && record.nuisances().front().name == planned.nuisances().front().name;
  unknowns.head(shared ? fit.unknowns.size() : 2) = fit.unknowns.head(shared ? fit.unknowns.size() : 2);
  return unknowns;
}

/// The fit of a law after the measurement, where it gave `readings`.
SeverityFit updated(const ReadingModel& record, const ReadingModel& planned, const Expectation& point,
                    const VectorXd& readings) {
  const MatrixXd prior = covariance_for(record, *point.fit, planned);
  const MatrixXd spread =
      MatrixXd::Identity(readings.size(), readings.size()) + point.slopes * prior * point.slopes.transpose();
  const Eigen::LLT<MatrixXd> factor(spread);
  const VectorXd apart = readings - point.readings;
  const VectorXd solved = factor.solve(apart);
  SeverityFit fit;
  fit.severity = point.fit->severity;
  fit.residuals.resize(point.fit->residuals.size() + apart.size());
  fit.residuals << point.fit->residuals, factor.matrixL().solve(apart);
  fit.chi2 = fit.residuals.squaredNorm();
  fit.unknowns = unknowns_for(record, *point.fit, planned) + prior * point.slopes.transpose() * solved;
  fit.covariance = prior - prior * point.slopes.transpose() * factor.solve(point.slopes * prior);
  return fit;
}

/// Widths of the two ranges.
struct Widths {
  double hull_zeta = 0.0, hull_F0 = 0.0, average_zeta = 0.0, average_F0 = 0.0;
};

double width(const Interval& ends) { return ends[1] - ends[0]; }

/// Points of one law.
struct Curve {
  double density = 0.0;
  double before = 0.0;  ///< its least chi2 by the record alone
  std::vector<SeverityPoint> points;

  [[nodiscard]] double likelihood(const SeverityPoint& point) const {
    return std::exp(-0.5 * (point.chi2 - before) + point.log_volume);
  }
};

/// Mean and variance of a mixture by moments.
class Moments {
 public:
  void add(double weight, double value, double deviation) {
    sum_ += weight;
    first_ += weight * value;
    second_ += weight * (value * value + deviation * deviation);
  }
  [[nodiscard]] double deviation() const {
    const double mean = first_ / sum_;
    return std::sqrt(std::max(second_ / sum_ - mean * mean, 0.0));
  }

 private:
  double sum_ = 0.0, first_ = 0.0, second_ = 0.0;
};

/// `student`: half width of a region, in deviations. The record allows all of these laws; those whose misfit the
/// measurement raises by more than its square are told apart.
Widths widths_of(const std::vector<Curve>& curves, double student) {
  const double limit = student * student;
  Interval zeta{std::numeric_limits<double>::infinity(), 0.0};
  Interval F0 = zeta;
  Moments mean_zeta;
  Moments mean_F0;
  for (const Curve& curve : curves) {
    for (const SeverityPoint& point : curve.points) {
      const double weight = curve.density * curve.likelihood(point);
      mean_zeta.add(weight, point.c, point.c_deviation);
      mean_F0.add(weight, point.F0, point.F0_deviation);
    }
    if (best_of(curve.points).chi2 > curve.before + limit) continue;
    const Interval c = region_of(curve.points, limit, &SeverityPoint::c, &SeverityPoint::c_deviation);
    const Interval f = region_of(curve.points, limit, &SeverityPoint::F0, &SeverityPoint::F0_deviation);
    zeta = {std::min(zeta[0], c[0]), std::max(zeta[1], c[1])};
    F0 = {std::min(F0[0], f[0]), std::max(F0[1], f[1])};
  }
  return {width(zeta), width(F0), mean_zeta.deviation(), mean_F0.deviation()};
}

class Advisor {
 public:
  Advisor(const ReadingModel& record, const LawStudy& study, const KnownConstants& constants)
      : record_(record), study_(study), constants_(constants), student_(quantile95(study.plain.noise.freedom)) {
    for (const LawFits& law : study.laws) {
      const auto answer = std::ranges::find(study.intervals.laws, law.law.name(), &LawAnswer::name);
      if (answer == study.intervals.laws.end() || answer->rejected) continue;
      rivals_.push_back({&law, std::max(answer->weight, 1e-3)});
    }
    double sum = 0.0;
    for (const Rival& rival : rivals_) sum += rival.weight;
    for (Rival& rival : rivals_) {
      rival.weight /= sum;
      const Curve curve = curve_now(rival);
      double likelihood = 0.0;
      for (const SeverityPoint& point : curve.points) likelihood += curve.likelihood(point);
      rival.density = rival.weight / likelihood;
    }
  }

  [[nodiscard]] std::size_t rivals() const { return rivals_.size(); }

  /// Mean power between pairs of laws, by what the record itself says.
  [[nodiscard]] double power_now() const {
    double mean = 0.0;
    for (const Rival& truth : rivals_)
      for (const Rival& other : rivals_)
        mean += truth.weight * power_at(other.law->best().chi2 - truth.law->best().chi2) /
                static_cast<double>(rivals_.size());
    return mean;
  }

  [[nodiscard]] std::optional<Advice> advice(const CandidateMeasurement& candidate) const {
    const std::unique_ptr<const ReadingModel> planned = plan(candidate);
    std::vector<Rival> rivals = rivals_;
    for (Rival& rival : rivals)
      if (!expect(*planned, rival)) return std::nullopt;
    Advice advice{.candidate = candidate};
    const Widths before = widths_of(now(), student_);
    Widths after;
    for (const Rival& truth : rivals) {
      const VectorXd& readings = truth.points[truth.best].readings;
      std::vector<Curve> curves;
      for (const Rival& other : rivals) curves.push_back(after_readings(*planned, other, readings));
      const Widths widths = widths_of(curves, student_);
      after.hull_zeta += truth.weight * widths.hull_zeta;
      after.hull_F0 += truth.weight * widths.hull_F0;
      after.average_zeta += truth.weight * widths.average_zeta;
      after.average_F0 += truth.weight * widths.average_F0;
      const double own = best_of(curves[static_cast<std::size_t>(&truth - rivals.data())].points).chi2;
      for (std::size_t i = 0; i < curves.size(); ++i)
        if (rivals.size() > 1 && &rivals[i] != &truth)
          advice.power += truth.weight * power_at(best_of(curves[i].points).chi2 - own) /
                          static_cast<double>(rivals.size() - 1);
    }
    advice.hull = {after.hull_zeta / before.hull_zeta, after.hull_F0 / before.hull_F0};
    advice.average = {after.average_zeta / before.average_zeta, after.average_F0 / before.average_F0};
    return advice;
  }

 private:
  [[nodiscard]] std::vector<Curve> now() const {
    std::vector<Curve> curves;
    for (const Rival& rival : rivals_) curves.push_back(curve_now(rival));
    return curves;
  }

  [[nodiscard]] Curve curve_now(const Rival& rival) const {
    std::vector<SeverityFit> fits;
    for (const SeverityFit& fit : rival.law->fits)
      if (fit.chi2 < rival.law->best().chi2 + reach) fits.push_back(fit);
    return {rival.density, rival.law->best().chi2, severity_curve(record_, fits)};
  }

  [[nodiscard]] Curve after_readings(const ReadingModel& planned, const Rival& rival,
                                     const VectorXd& readings) const {
    std::vector<SeverityFit> fits;
    for (const Expectation& point : rival.points) fits.push_back(updated(record_, planned, point, readings));
    return {rival.density, rival.law->best().chi2, severity_curve(planned, fits)};
  }

  [[nodiscard]] std::unique_ptr<const ReadingModel> plan(const CandidateMeasurement& candidate) const {
    const std::vector<double>& deviations = study_.plain.noise.deviations;
    if (const auto* decay = std::get_if<PlannedDecay>(&candidate.plan))
      return planned_decay(record_, decay->release, decay->extremes, constants_, deviations[0]);
    // A phase that was not measured is taken to be as good as the amplitude in the middle of the range.
    const bool knows_phase = deviations.size() > 1 && !record_.nuisances().empty();
    const double phase = knows_phase ? deviations[1] : deviations[0] / record_.reference().amplitude;
    std::vector<Pair> states;
    for (const PlannedState& planned : std::get<std::vector<PlannedState>>(candidate.plan)) {
      Pair state{.Y = planned.Y,
                 .x = record_.reference().amplitude * planned.Y / record_.reference().Y,
                 .number = static_cast<int>(states.size()) + 1};
      state.omega = planned.omega;
      if (candidate.phases) state.phase = 0.5 * std::numbers::pi;
      states.push_back(state);
    }
    const double amplitude = candidate.only_phases ? 1e3 * record_.reference().amplitude : deviations[0];
    return planned_states(record_, std::move(states), constants_, {amplitude, phase});
  }

  [[nodiscard]] bool expect(const ReadingModel& planned, Rival& rival) const {
    VectorXd weights(planned.readings().size());
    for (Index i = 0; i < weights.size(); ++i)
      weights[i] =
          1.0 /
          planned.known_deviations()[static_cast<std::size_t>(planned.channels()[static_cast<std::size_t>(i)])];
    for (const SeverityFit& fit : rival.law->fits) {
      if (fit.chi2 > rival.law->best().chi2 + reach) continue;
      const LawAt law{fit.severity == 0.0 ? nullptr : rival.law->law.departure, fit.severity};
      const std::unique_ptr<NearbyOrbits> own = planned.no_orbits(planned.known_deviations());
      const VectorXd unknowns = unknowns_for(record_, fit, planned);
      const std::optional<VectorXd> residuals = planned.residuals(law, unknowns, *own);
      if (!residuals) continue;
      const std::optional<MatrixXd> slopes = planned.derivatives(law, unknowns, *residuals, *own);
      if (!slopes) continue;
      if (&fit == &rival.law->best()) rival.best = rival.points.size();
      const VectorXd predicted = planned.readings() - *residuals;
      rival.points.push_back({&fit, predicted.cwiseProduct(weights), MatrixXd(weights.asDiagonal() * *slopes)});
    }
    return !rival.points.empty();
  }

  const ReadingModel& record_;
  const LawStudy& study_;
  const KnownConstants& constants_;
  double student_;
  std::vector<Rival> rivals_;
};

std::string percent(double share) {
  constexpr int digits = 2;
  return core::format_number(100.0 * share, digits) + " %";
}

std::string text_of(const Advice& advice, const LawIntervals& now, double power_now) {
  const auto half = [](const Interval& ends, double value) { return 0.5 * (ends[1] - ends[0]) / value; };
  const double zeta = half(now.zeta_hull, now.mean.zeta);
  const double F0 = half(now.F0_hull, now.mean.F0);
  constexpr double little = 0.9;
  const bool helps = advice.hull.zeta < little || advice.hull.F0 < little;
  return advice.candidate.name + ": zeta's range goes from +-" + percent(zeta) + " to +-" +
         percent(zeta * advice.hull.zeta) + ", F0's from +-" + percent(F0) + " to +-" +
         percent(F0 * advice.hull.F0) + "; a wrong law is rejected with probability " + percent(advice.power) +
         " (now " + percent(power_now) + ")" + (helps ? "" : "; this hardly helps");
}

}  // namespace

std::variant<Design, std::string> design_after(const Record& record, const KnownConstants& constants,
                                               const KnownDeviations& known, const LawIntervalOptions& options) {
  if (!record.pairs || record.pairs->pairs.empty()) return "advice needs a record of steady states";
  auto readings = steady_readings(record, constants, known);
  if (const auto* why = std::get_if<std::string>(&readings)) return *why;
  const ReadingModel& model = *std::get<0>(readings);
  std::variant<LawStudy, std::string> found = study_laws(model, constants, options);
  if (const auto* why = std::get_if<std::string>(&found)) return *why;
  const LawStudy& study = std::get<LawStudy>(found);
  const Advisor advisor(model, study, constants);
  Design design{.now = study.intervals};
  design.power_now = advisor.power_now();
  std::vector<Pair> states = record.pairs->pairs;
  for (Pair& state : states) state.omega = frequency_of(state, constants);
  const std::vector<CandidateMeasurement> candidates = candidates_after(states, constants, design.now.mean.zeta);
  std::vector<std::optional<Advice>> advice(candidates.size());
  sim::in_parts(candidates.size(), 1, 0, [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) advice[i] = advisor.advice(candidates[i]);
  });
  for (std::optional<Advice>& one : advice) {
    if (!one) continue;
    one->text = text_of(*one, design.now, design.power_now);
    design.advice.push_back(std::move(*one));
  }
  if (design.advice.empty()) return "no law that the record allows has steady states under any candidate";
  std::ranges::stable_sort(design.advice, {}, [](const Advice& one) { return one.hull.zeta * one.hull.F0; });
  return design;
}

}  // namespace dualdamp::identify
