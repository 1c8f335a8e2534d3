#include "identify/ledger/estimate/joint_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>
#include <utility>

#include "core/constants.hpp"
#include "identify/conclusion.hpp"
#include "identify/ledger/estimate/stated_errors.hpp"
#include "identify/ledger/stated_noise.hpp"
#include "identify/models/force_parameters.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/least_squares.hpp"
#include "identify/statistics/scatter.hpp"
#include "identify/statistics/statistics.hpp"
#include "identify/statistics/ties.hpp"

namespace dualdamp::identify {

namespace {

void cover(Interval& interval, const Interval& other) {
  interval = {std::min(interval[0], other[0]), std::max(interval[1], other[1])};
}

void cover(Estimate& estimate, const Estimate& other) {
  if (!estimate.interval95 || !other.interval95) return;
  for (const ReportedParameter& parameter : reported_parameters)
    cover((*estimate.interval95).*parameter.interval, (*other.interval95).*parameter.interval);
}

/// Quantile of an estimate whose model leaves `freedom`: the deviation of the rows has no more degrees of freedom
/// than that of the readings that decide about friction, and one at least.
double quantile_of(const JointModel& model, double freedom) {
  return quantile95(std::max(1.0, std::min(model.is_stated ? known_freedom : freedom, model.scale_freedom)));
}

/// Is it a term of friction that a test of its own rejects at 25 %?
bool is_nearly_seen(const JointModel& model, const RelaxationTest& test) {
  constexpr double level = 0.25;
  return is_of_friction(model.relaxations[test.index].assumption) && test.p_alone < level;
}

/// The forces of a solution, and their covariance, of (m, c, k, F0).
struct SolvedForce {
  ForceParameters value;
  Eigen::Matrix4d covariance;
};

/// Columns of a mass and of a stiffness are at constant zeta, so their errors move c.
SolvedForce force_of(const JointModel& model, const Solution& solution) {
  const KnownConstants& constants = model.constants;
  ForceParameters force{.m = constants.mass, .k = constants.stiffness, .F0 = model.value.F0 + solution.step[1]};
  Eigen::Index mass = -1;
  Eigen::Index stiffness = -1;
  for (std::size_t j = 0; j < solution.free.size(); ++j) {
    const Eigen::Index column = model.base.cols() + static_cast<Eigen::Index>(j);
    const auto stated = model.relaxations[solution.free[j]].stated;
    if (stated == &ConstantUncertainties::mass) mass = column;
    if (stated == &ConstantUncertainties::stiffness) stiffness = column;
  }
  if (mass >= 0) force.m += solution.step[mass];
  if (stiffness >= 0) force.k += solution.step[stiffness];
  const double zeta = model.value.zeta + solution.step[0];
  const double critical = critical_damping(force.m, force.k);
  force.c = zeta * critical;
  Eigen::MatrixXd to_force = Eigen::MatrixXd::Zero(4, solution.step.size());
  to_force(1, 0) = critical;
  to_force(3, 1) = 1.0;
  if (mass >= 0) to_force(0, mass) = 1.0, to_force(1, mass) = 0.5 * force.c / force.m;
  if (stiffness >= 0) to_force(2, stiffness) = 1.0, to_force(1, stiffness) = 0.5 * force.c / force.k;
  return {force, propagated(to_force, solution.variance * solution.covariance)};
}

}  // namespace

Estimate joint_estimate(const JointModel& model, const Taken& relaxed, const StatedShares& shares,
                        std::string basis) {
  Estimate estimate;
  estimate.method = "joint_fit";
  const std::optional<Solution> solution = solved(model, relaxed, shares);
  if (!solution) {
    refuse(estimate, "the record does not distinguish the parameters of the joint model");
    return estimate;
  }
  const SolvedForce force = force_of(model, *solution);
  set_estimate(estimate, force.value, force.covariance, quantile_of(model, solution->freedom));
  std::vector<std::string> faults;
  judge_signs(estimate, 0.0, faults);
  conclude(estimate, faults, std::move(basis));
  return estimate;
}

namespace {

/// Extends the intervals to cover the estimates in which a nearly seen term of friction is free.
void reach_over_nearly_seen(const JointModel& model, const RelaxationTests& tests, const Taken& relaxed,
                            const StatedShares& shares, Estimate& estimate) {
  const JointModel& here = tests.relaxed ? *tests.relaxed : model;
  for (const RelaxationTest& test : tests.tests) {
    if (!is_nearly_seen(model, test)) continue;
    Taken further = relaxed;
    further.push_back(test.index);
    cover(estimate, joint_estimate(here, further, shares, {}));
  }
}

/// Estimates of a model with all departures relaxed, by one explanation of each or another.
class RelaxedEstimates {
 public:
  RelaxedEstimates(const JointModel& model, const RelaxationTests& tests, const StatedShares& shares)
      : model_(model), tests_(tests), shares_(shares) {
    for (const FoundDeparture& departure : tests.departures) {
      best_.push_back(departure.explanations.front().index);
      relaxed_ += (relaxed_.empty() ? "" : ", ") + model.relaxations[best_.back()].test;
    }
  }

  [[nodiscard]] const Taken& best() const { return best_; }
  [[nodiscard]] Estimate with_best() const { return of(fitted(best_), best_); }

  /// Extends the intervals to cover what else explains a departure.
  void cover_others(std::size_t departure, Estimate& estimate) const {
    const FoundDeparture& found = tests_.departures[departure];
    const bool shares = shares_.apply_to(model_, found);
    bool has_shared = is_shared(best_[departure]);
    for (const RelaxationTest& other : found.explanations) {
      Taken instead = best_;
      instead[departure] = other.index;
      const bool is_shared_out = shares && is_shared(other.index);
      if (is_shared_out ? has_shared && shares_.allow(other.constants) : instead == best_) continue;
      const JointModel relaxed = fitted(instead);
      // Beyond what the uncertainties allow, either of them may be off alone.
      if (is_shared_out && !shares_.allow(other.constants)) cover(estimate, alone(relaxed, instead));
      if (!is_shared_out || !std::exchange(has_shared, true)) cover(estimate, of(relaxed, instead));
    }
  }

 private:
  [[nodiscard]] bool is_shared(std::size_t relaxation) const {
    return StatedShares::is_shared(model_.relaxations[relaxation]);
  }

  [[nodiscard]] JointModel fitted(const Taken& taken) const {
    return model_.refit && !taken.empty() ? model_.refit(taken) : model_;
  }

  [[nodiscard]] Estimate alone(const JointModel& relaxed, const Taken& taken) const {
    return joint_estimate(
        relaxed, taken, shares_,
        "all of " + model_.data + " together" + (relaxed_.empty() ? "" : "; free beside zeta and F0: " + relaxed_));
  }

  /// With the constants that a mass and a stiffness share, where one of them is free and the other explains as
  /// much.
  [[nodiscard]] Estimate of(const JointModel& relaxed, const Taken& taken) const {
    for (std::size_t d = 0; d < taken.size(); ++d)
      if (is_shared(taken[d]) && shares_.apply_to(model_, tests_.departures[d]))
        return alone(with_constants(relaxed, shares_.of(relaxed.constants)), taken);
    return alone(relaxed, taken);
  }

  const JointModel& model_;
  const RelaxationTests& tests_;
  const StatedShares& shares_;
  Taken best_;
  std::string relaxed_;
};

}  // namespace

Estimate relaxed_estimate(const JointModel& model, const RelaxationTests& tests, const StatedShares& shares) {
  const RelaxedEstimates relaxed(model, tests, shares);
  Estimate estimate = relaxed.with_best();
  for (std::size_t d = 0; d < tests.departures.size(); ++d) relaxed.cover_others(d, estimate);
  reach_over_nearly_seen(model, tests, relaxed.best(), shares, estimate);
  return estimate;
}

namespace {

/// The fit with one more relaxation free, as far as zeta (0) and F0 (1) are concerned.
class FreedTerm {
 public:
  /// Nothing can be said where a column is a combination of the others.
  FreedTerm(const JointModel& model, const Taken& taken, const StatedShares& shares, double quantile, int sign)
      : quantile_(quantile) {
    const std::optional<Solution> solution = solved(model, taken, shares);
    if (!solution) return;
    const Eigen::MatrixXd& covariance = solution->covariance;
    const Eigen::VectorXd& step = solution->step;
    const double variance = solution->variance;
    const Eigen::Index last =
        model.base.cols() + (std::ranges::find(solution->free, taken.back()) - solution->free.begin());
    const double of_term = covariance(last, last);
    const double reach = quantile * std::sqrt(variance * of_term);
    const double least = sign > 0 ? 0.0 : -core::infinity;
    const double most = sign < 0 ? 0.0 : core::infinity;
    if (step[last] + reach < least || step[last] - reach > most) return;
    const double best = std::clamp(step[last], least, most);
    const std::array<double, 2> ends = {std::max(step[last] - reach, least) - best,
                                        std::min(step[last] + reach, most) - best};
    for (Eigen::Index j = 0; j < 2; ++j) {
      const auto at = static_cast<std::size_t>(j);
      slopes_[at] = covariance(j, last) / of_term;
      const double fixed = covariance(j, j) - slopes_[at] * covariance(j, last);
      errors_[at] = std::sqrt(variance * std::max(0.0, fixed));
      centres_[at] = step[j] + slopes_[at] * (best - step[last]);
    }
    ends_ = ends;
    is_possible_ = true;
  }

  [[nodiscard]] bool is_possible() const { return is_possible_; }

  /// Change of the parameter from its value in the model.
  [[nodiscard]] Interval interval(std::size_t parameter) const {
    const double slope = slopes_[parameter];
    const double low = std::min(slope * ends_[0], slope * ends_[1]);
    const double high = std::max(slope * ends_[0], slope * ends_[1]);
    const double error = quantile_ * errors_[parameter];
    return {centres_[parameter] - std::hypot(error, low), centres_[parameter] + std::hypot(error, high)};
  }

 private:
  double quantile_;
  bool is_possible_ = false;
  std::array<double, 2> centres_{}, slopes_{}, errors_{}, ends_{};
};

/// An interval that was extended to cover a term ends where this term does, but for rounding, and by itself.
void reach(const Interval& interval, const std::string& test, Interval& range, std::array<std::string, 2>& ends) {
  if (interval[0] < range[0] && !is_tie(interval[0], range[0])) range[0] = interval[0], ends[0] = test;
  if (interval[1] > range[1] && !is_tie(interval[1], range[1])) range[1] = interval[1], ends[1] = test;
}

/// Sets the ends of c and x_f by those of zeta and F0.
void set_others(const KnownConstants& constants, UnseenRange& range) {
  for (std::size_t end = 0; end < 2; ++end) {
    const ParameterSet both = parameters(range.ends.zeta[end], range.ends.F0[end] / constants.stiffness, constants);
    range.ends.c[end] = both.c;
    range.ends.x_f[end] = both.x_f;
  }
}

}  // namespace

std::optional<UnseenRange> unseen_friction(const JointModel& model, const RelaxationTests& tests,
                                           const Estimate& estimate, const StatedShares& shares) {
  if (!estimate.outcome.ok() || !estimate.interval95) return std::nullopt;
  const JointModel& here = tests.relaxed ? *tests.relaxed : model;
  Taken taken;
  for (const FoundDeparture& departure : tests.departures) taken.push_back(departure.explanations.front().index);
  UnseenRange range{.ends = *estimate.interval95};
  const double freedom = static_cast<double>(here.base.rows() - here.base.cols() - 1) - here.spent;
  const double quantile = quantile_of(here, freedom);
  for (const RelaxationTest& test : tests.tests) {
    const Relaxation& relaxation = here.relaxations[test.index];
    if (!is_of_friction(relaxation.assumption)) continue;
    Taken further = taken;
    further.push_back(test.index);
    const FreedTerm freed(here, further, shares, quantile, relaxation.sign);
    if (!freed.is_possible()) continue;
    const auto from = [&](double value, std::size_t parameter) {
      const Interval change = freed.interval(parameter);
      return Interval{std::max(0.0, value + change[0]), value + change[1]};
    };
    reach(from(here.value.zeta, 0), relaxation.test, range.ends.zeta, range.zeta_by);
    reach(from(here.value.F0, 1), relaxation.test, range.ends.F0, range.F0_by);
  }
  set_others(here.constants, range);
  return range;
}

bool follows_law(const JointModel& model, const RelaxationTests& tests) {
  if (tests.departures.size() != 1) return false;
  return std::ranges::any_of(tests.departures.front().explanations, [&](const RelaxationTest& test) {
    return model.relaxations[test.index].is_law && test.coefficient > 0.0;
  });
}

void note_nearly_seen(const JointModel& model, const RelaxationTests& tests, Ledger& ledger) {
  for (const RelaxationTest& test : tests.tests) {
    LedgerEntry& entry = ledger.entry(model.relaxations[test.index].assumption);
    constexpr std::string_view note = " at 25 %, and the intervals of joint_fit include its effect";
    const bool noted = entry.reason.ends_with(note);
    if (entry.standing != Standing::violated && is_nearly_seen(model, test) && !noted)
      entry.reason +=
          "; the test of " + model.relaxations[test.index].test + " by itself rejects" + std::string(note);
  }
}

}  // namespace dualdamp::identify
