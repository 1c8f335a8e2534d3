#include "identify/design/design.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "core/numbers.hpp"
#include "identify/methods/any_law/any_law.hpp"
#include "identify/methods/any_law/decay_readings.hpp"
#include "identify/methods/any_law/steady_readings.hpp"
#include "identify/statistics/distributions.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::identify {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Fits whose chi2 is above the least of their law by more than this are left out.
constexpr double reach = 12.0;

/// What a law at one severity predicts for a measurement.
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

/// Probability that a two-sided test of level 5 % rejects a normal variate of mean sqrt(chi2).
double power_at(double chi2) {
  constexpr double limit = 1.959963984540054;
  const double distance = std::sqrt(std::max(chi2, 0.0));
  const auto below = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
  return below(distance - limit) + below(-distance - limit);
}

/// Covariance of the measurement's unknowns after the record: those that it shares with the record have the
/// covariance of the fit, its own that of their priors.
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

/// `student`: half width of a region, in deviations. The record allows all of these laws. A law leaves the hull if
/// the measurement raises its least chi2 by more than the square of `student`. `moved`: deviations of c and F0 by
/// the constants.
Widths widths_of(const std::vector<Curve>& curves, double student, const ParameterSet& moved) {
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
  const double both_sides = 2.0 * normal95();
  return {std::hypot(width(zeta), both_sides * moved.c), std::hypot(width(F0), both_sides * moved.F0),
          std::hypot(mean_zeta.deviation(), moved.c), std::hypot(mean_F0.deviation(), moved.F0)};
}

class Advisor {
 public:
  Advisor(const ReadingModel& record, const LawStudy& study, const KnownConstants& constants,
          const ParameterSet& moved)
      : record_(record),
        study_(study),
        constants_(constants),
        student_(quantile95(study.plain.noise.freedom)),
        moved_(moved) {
    // The curves are those of c; the change of zeta is turned to c by the stated constants.
    moved_.c = moved.zeta * 2.0 * std::sqrt(constants.mass * constants.stiffness);
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

  /// Mean power between pairs of laws by the record alone.
  [[nodiscard]] double power_now() const {
    double mean = 0.0;
    for (const Rival& truth : rivals_)
      for (const Rival& other : rivals_)
        mean += truth.weight * power_at(other.law->best().chi2 - truth.law->best().chi2) /
                static_cast<double>(rivals_.size());
    return mean;
  }

  /// Advice for candidates with the same states, or the same release: the engines compute these once.
  [[nodiscard]] std::vector<Advice> advice(std::span<const CandidateMeasurement> same) const {
    const std::unique_ptr<const ReadingModel> planned = model_of(same.front().plan);
    std::vector<Rival> rivals = rivals_;
    for (Rival& rival : rivals)
      if (!expect(*planned, rival)) return {};
    std::vector<Advice> list;
    for (const CandidateMeasurement& candidate : same) list.push_back(advice(candidate, *planned, rivals));
    return list;
  }

 private:
  /// `expected`: with predictions of all readings that the plan can give.
  [[nodiscard]] Advice advice(const CandidateMeasurement& candidate, const ReadingModel& planned,
                              const std::vector<Rival>& expected) const {
    const std::vector<Rival> rivals = reading_only(candidate, planned, expected);
    Advice advice{.candidate = candidate};
    const Widths before = widths_of(now(), student_, moved_);
    Widths after;
    for (const Rival& truth : rivals) {
      const VectorXd& readings = truth.points[truth.best].readings;
      std::vector<Curve> curves;
      for (const Rival& other : rivals) curves.push_back(after_readings(planned, other, readings));
      const Widths widths = widths_of(curves, student_, moved_);
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

  /// A phase that was not measured gets the relative deviation of the amplitude in the middle of the range.
  [[nodiscard]] std::array<double, 2> deviations() const {
    const std::vector<double>& own = study_.plain.noise.deviations;
    const bool knows_phase = std::ranges::find(record_.channels(), 1) != record_.channels().end();
    return {own[0], knows_phase ? own[1] : own[0] / record_.reference().amplitude};
  }

  /// The model of a plan with all that could be read, also the phases of states.
  [[nodiscard]] std::unique_ptr<const ReadingModel> model_of(const MeasurementPlan& plan) const {
    if (const auto* decay = std::get_if<PlannedDecay>(&plan))
      return planned_decay(record_, decay->release, decay->extremes, constants_, deviations()[0]);
    std::vector<Pair> states;
    for (const PlannedState& planned : std::get<std::vector<PlannedState>>(plan)) {
      Pair state{.Y = planned.Y,
                 .x = record_.reference().amplitude * planned.Y / record_.reference().Y,
                 .number = static_cast<int>(states.size()) + 1};
      state.omega = planned.omega;
      state.phase = 0.5 * std::numbers::pi;
      states.push_back(state);
    }
    return planned_states(record_, std::move(states), constants_, deviations());
  }

  /// The predictions of what the candidate reads, over the deviations.
  [[nodiscard]] std::vector<Rival> reading_only(const CandidateMeasurement& candidate, const ReadingModel& planned,
                                                std::vector<Rival> rivals) const {
    std::vector<Index> rows;
    for (std::size_t i = 0; i < planned.channels().size(); ++i)
      if (planned.channels()[i] == 0 ? !candidate.only_phases : candidate.phases)
        rows.push_back(static_cast<Index>(i));
    VectorXd weights(static_cast<Index>(rows.size()));
    for (Index i = 0; i < weights.size(); ++i)
      weights[i] = 1.0 / deviations().at(static_cast<std::size_t>(
                             planned.channels()[static_cast<std::size_t>(rows[static_cast<std::size_t>(i)])]));
    for (Rival& rival : rivals) {
      for (Expectation& point : rival.points) {
        point.readings = VectorXd(weights.cwiseProduct(VectorXd(point.readings(rows))));
        point.slopes = MatrixXd(weights.asDiagonal() * MatrixXd(point.slopes(rows, Eigen::all)));
      }
    }
    return rivals;
  }

  /// Predicts the readings at each severity. Orbits are found next to those of the last severity of the same sign.
  [[nodiscard]] bool expect(const ReadingModel& planned, Rival& rival) const {
    std::unique_ptr<NearbyOrbits> near;
    double last = 0.0;
    for (const SeverityFit& fit : rival.law->fits) {
      if (fit.chi2 > rival.law->best().chi2 + reach) continue;
      if (near == nullptr || !(fit.severity * last > 0.0)) near = planned.no_orbits(planned.known_deviations());
      last = 0.0;
      const LawAt law{fit.severity == 0.0 ? nullptr : rival.law->law.departure, fit.severity};
      const VectorXd unknowns = unknowns_for(record_, fit, planned);
      const std::optional<VectorXd> residuals = planned.residuals(law, unknowns, *near);
      if (!residuals) continue;
      const std::optional<MatrixXd> slopes = planned.derivatives(law, unknowns, *residuals, *near);
      if (!slopes) continue;
      last = fit.severity;
      if (rival.points.empty() || fit.chi2 < rival.points[rival.best].fit->chi2) rival.best = rival.points.size();
      rival.points.push_back({&fit, planned.readings() - *residuals, *slopes});
    }
    return !rival.points.empty();
  }

  const ReadingModel& record_;
  const LawStudy& study_;
  const KnownConstants& constants_;
  double student_;
  ParameterSet moved_;
  std::vector<Rival> rivals_;
};

/// Groups of neighbours in the list with the same plan, which differ only in what they read.
std::vector<std::span<const CandidateMeasurement>> by_plan(std::span<const CandidateMeasurement> candidates) {
  std::vector<std::span<const CandidateMeasurement>> groups;
  for (std::size_t first = 0, end = 0; first < candidates.size(); first = end) {
    while (end < candidates.size() && candidates[end].plan == candidates[first].plan) ++end;
    groups.push_back(candidates.subspan(first, end - first));
  }
  return groups;
}

/// Two significant digits; whole percents from 99.5 % on.
std::string percent(double share) {
  constexpr int digits = 2;
  constexpr double all = 99.5;
  const double value = 100.0 * share;
  return (value < all ? core::format_number(value, digits) : std::to_string(std::llround(value))) + " %";
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
                                               const KnownDeviations& known, const LawIntervalOptions& options,
                                               const ParameterSet& moved) {
  if (!record.pairs || record.pairs->pairs.empty()) return "advice needs a record of steady states";
  auto readings = steady_readings(record, constants, known);
  if (const auto* why = std::get_if<std::string>(&readings)) return *why;
  const ReadingModel& model = *std::get<0>(readings);
  std::variant<LawStudy, std::string> found = study_laws(model, constants, options);
  if (const auto* why = std::get_if<std::string>(&found)) return *why;
  const LawStudy& study = std::get<LawStudy>(found);
  const Advisor advisor(model, study, constants, moved);
  Design design{.now = study.intervals};
  widen(moved, design.now);
  design.power_now = advisor.power_now();
  std::vector<Pair> states = record.pairs->pairs;
  for (Pair& state : states) state.omega = frequency_of(state, constants);
  const std::vector<CandidateMeasurement> candidates = candidates_after(states, constants, design.now.mean.zeta);
  const std::vector<std::span<const CandidateMeasurement>> groups = by_plan(candidates);
  std::vector<std::vector<Advice>> advice(groups.size());
  sim::in_parts(groups.size(), 1, 0, [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) advice[i] = advisor.advice(groups[i]);
  });
  for (std::vector<Advice>& group : advice) {
    for (Advice& one : group) {
      one.text = text_of(one, design.now, design.power_now);
      design.advice.push_back(std::move(one));
    }
  }
  if (design.advice.empty()) return "no law that the record allows has steady states under any candidate";
  std::ranges::stable_sort(design.advice, {}, [](const Advice& one) { return one.hull.zeta * one.hull.F0; });
  return design;
}

}  // namespace dualdamp::identify
