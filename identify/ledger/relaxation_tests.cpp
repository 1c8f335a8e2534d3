#include "identify/ledger/relaxation_tests.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "identify/ledger/drift_or_speed.hpp"
#include "identify/ledger/family_of_tests.hpp"
#include "identify/ledger/sensor_or_symmetry.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/ties.hpp"

namespace dualdamp::identify {

namespace {

/// Least share of a column's length beside the base columns: below it the relaxation cannot be told from them.
constexpr double told_apart = 1e-4;
/// Once relaxations are taken: least part of a column's length beside the base that must remain beside the taken
/// ones too. Below it, the relaxation and those taken count as one departure.
constexpr double told_from_taken = 5e-3;
/// Standard errors at which a departure is found in four records of five.
constexpr double found_at = 2.8;
/// Noise that columns and residuals share changes their product by at most this many times what one draw of it
/// does.
constexpr double at_most_shared = 2.0;
/// Twice the gain of the log-likelihood that a relaxation needs where only the misfit as a whole rejects.
constexpr double far_better = 4.0 * equal_likelihood;

/// The relaxations beside a base, projected.
struct Projection {
  Eigen::VectorXd residuals;
  double freedom = 0.0;
  double scale_freedom = 0.0;        ///< of the deviation that a statistic is divided by
  std::vector<std::size_t> indices;  ///< of the relaxations that can be told apart
  std::vector<std::size_t> alike;    ///< of those that could be, were it not for the relaxations taken
  Eigen::MatrixXd unit;              ///< their columns beside the base, of unit length
  Eigen::VectorXd lengths;
  Eigen::MatrixXd shifts;  ///< of the base parameters for a unit of each relaxation
  /// What noise in both a column and the residuals adds to their product, for unit columns.
  Eigen::VectorXd shared;
};

/// Is it the square of a column that tells something?
bool is_told(double square) { return square > 0.0 && std::isfinite(square); }

/// A column that is not finite, or so long that its square is not, tells nothing: it is taken as zero.
Eigen::MatrixXd finite_columns(Eigen::MatrixXd columns) {
  for (Eigen::Index j = 0; j < columns.cols(); ++j)
    if (!is_told(columns.col(j).squaredNorm())) columns.col(j).setZero();
  return columns;
}

/// Lengths of columns beside a base.
Eigen::VectorXd lengths_beside(const Eigen::MatrixXd& base, const Eigen::MatrixXd& columns) {
  return (columns - base * DependentColumns(base).solve_each(columns)).colwise().norm();
}

Projection project(const JointModel& model, const Taken& taken) {
  const Eigen::Index own = model.base.cols();
  const Eigen::MatrixXd base = free_columns(model.base, model.relaxed, taken);
  const DependentColumns unit(base);
  const Eigen::MatrixXd columns = finite_columns(model.relaxed);
  const Eigen::MatrixXd solved = unit.solve_each(columns);
  const Eigen::MatrixXd beside = columns - product(base, solved);

  Projection result;
  result.residuals = model.residuals - base * unit.solve(model.residuals);
  result.freedom = static_cast<double>(base.rows() - unit.rank()) - model.spent;
  // A statistic may depend on one channel, or on all: the mean of both degrees of freedom.
  result.scale_freedom = 0.5 * (result.freedom + std::min(result.freedom, std::max(2.0, model.scale_freedom)));
  if (model.has_one_scale) result.scale_freedom = std::min(result.freedom, std::max(2.0, model.scale_freedom));
  if (model.is_stated) result.scale_freedom = std::max(2.0, std::min(model.scale_freedom, model.other_freedom));
  Eigen::VectorXd lengths = beside.colwise().norm();
  if (!taken.empty()) lengths = lengths_beside(model.base, columns);
  for (Eigen::Index j = 0; j < beside.cols(); ++j) {
    const double least = told_apart * columns.col(j).norm();
    if (!(lengths[j] > least)) continue;
    const double left = beside.col(j).norm();
    const bool told = taken.empty() || (left > least && left > told_from_taken * lengths[j]);
    (told ? result.indices : result.alike).push_back(static_cast<std::size_t>(j));
  }
  const auto count = static_cast<Eigen::Index>(result.indices.size());
  result.unit.resize(base.rows(), count);
  result.lengths.resize(count);
  result.shifts.resize(own, count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const auto from = static_cast<Eigen::Index>(result.indices[static_cast<std::size_t>(j)]);
    result.lengths[j] = beside.col(from).norm();
    result.unit.col(j) = beside.col(from) / result.lengths[j];
    result.shifts.col(j) = -solved.col(from).head(own);
  }
  result.shared = Eigen::VectorXd::Zero(count);
  if (model.shaken.size() == 0) return result;
  const Eigen::Index all = model.relaxed.cols();
  const Eigen::MatrixXd relaxed = model.shaken.rightCols(all) - columns;
  const Eigen::MatrixXd moved =
      relaxed - free_columns(model.shaken.middleCols(1, own) - model.base, relaxed, taken) * solved;
  const Eigen::VectorXd pushed = model.shaken.col(0) - model.residuals;
  const Eigen::VectorXd left = pushed - base * unit.solve(pushed);
  for (Eigen::Index j = 0; j < count; ++j)
    result.shared[j] = moved.col(static_cast<Eigen::Index>(result.indices[static_cast<std::size_t>(j)])).dot(left) /
                       result.lengths[j];
  return result;
}

/// The share of the level that each test gets, as a weight: the relative standard error of the change of zeta or F0
/// by its departure. A departure that is measured precisely is found at a strict level as well.
Eigen::VectorXd weights_of(const JointModel& model, const Projection& projection, double deviation,
                           double least_change) {
  constexpr double sharp = 0.15;  // times the least change, which is then seven standard errors
  constexpr double blunt = 15.0;  // only a far larger departure is seen
  const auto part = [](const Eigen::VectorXd& parts, Eigen::Index j) { return parts.size() > 0 ? parts[j] : 0.0; };
  Eigen::VectorXd weights(projection.lengths.size());
  for (Eigen::Index j = 0; j < weights.size(); ++j) {
    const auto own = static_cast<Eigen::Index>(projection.indices[static_cast<std::size_t>(j)]);
    const double unit = deviation / projection.lengths[j];
    const double zeta = std::max(std::abs(projection.shifts(0, j)), std::abs(part(model.zeta_parts, own)));
    const double F0 = std::max(std::abs(projection.shifts(1, j)), std::abs(part(model.F0_parts, own)));
    const double change = unit * std::max(zeta / std::abs(model.value.zeta), F0 / std::abs(model.value.F0));
    weights[j] = std::isfinite(change) ? std::clamp(change, sharp * least_change, blunt * least_change)
                                       : blunt * least_change;
  }
  return weights;
}

/// Does the estimate of a coefficient have the sign that its departure can have?
bool is_possible(const JointModel& model, std::size_t relaxation, double estimate) {
  const int sign = model.relaxations[relaxation].sign;
  return sign == 0 || sign * estimate > 0.0;
}

/// Products of columns and residuals, less what noise in both may add to them.
Eigen::VectorXd beyond_shared(const Eigen::VectorXd& along, const Eigen::VectorXd& shared) {
  const Eigen::ArrayXd sure = (along.array().abs() - at_most_shared * shared.array().abs()).max(0.0);
  return along.array().sign() * sure;
}

/// Tests of all relaxations beside those taken.
std::vector<RelaxationTest> tests_beside(const JointModel& model, const Projection& projection,
                                         double least_change) {
  std::vector<RelaxationTest> tests;
  if (projection.indices.empty() || projection.freedom < 2.0) return tests;
  const double squares = projection.residuals.squaredNorm();
  if (!std::isfinite(squares)) return tests;
  const Eigen::VectorXd along =
      beyond_shared(projection.unit.transpose() * projection.residuals, projection.shared);
  const Eigen::ArrayXd variance =
      model.is_stated ? Eigen::ArrayXd::Ones(along.size()) : variances_beside(along, squares, projection.freedom);
  const Eigen::VectorXd t = along.array() / variance.sqrt();
  const double deviation = model.is_stated ? 1.0 : std::sqrt(squares / projection.freedom);
  std::vector<int> signs;
  for (const std::size_t index : projection.indices) signs.push_back(model.relaxations[index].sign);
  const FamilyOfTests family({projection.unit, std::move(signs),
                              weights_of(model, projection, deviation, least_change), projection.scale_freedom});
  const double share = model.known_noise.empty() ? 1.0 : 1.0 - misfit_share;
  for (Eigen::Index j = 0; j < t.size(); ++j) {
    if (!std::isfinite(t[j])) continue;  // noise in the drive shakes its column beyond all numbers
    RelaxationTest test;
    test.index = projection.indices[static_cast<std::size_t>(j)];
    test.t = t[j];
    if (is_possible(model, test.index, t[j])) {
      const double sides = model.relaxations[test.index].sign == 0 ? 1.0 : 0.5;
      test.p_value = std::min(1.0, family.p_value(j, t[j]) / share);
      test.p_alone = sides * two_sided_p_value(t[j], projection.scale_freedom - 1.0);
      const double rows = projection.freedom + static_cast<double>(model.base.cols());
      test.explained = model.is_stated ? t[j] * t[j] : rows * std::log1p(t[j] * t[j] / (projection.freedom - 1.0));
    }
    const double gain = along[j] / projection.lengths[j];
    const double error = std::sqrt(variance[j]) / projection.lengths[j];
    test.coefficient = gain;
    test.zeta_change = projection.shifts(0, j) * gain;
    test.F0_change = projection.shifts(1, j) * gain;
    const auto own = static_cast<Eigen::Index>(test.index);
    if (model.F0_parts.size() > 0) test.F0_part = gain * model.F0_parts[own];
    if (model.zeta_parts.size() > 0) test.zeta_part = gain * model.zeta_parts[own];
    const double blind = found_at * error + at_most_shared * std::abs(projection.shared[j]) / projection.lengths[j];
    test.zeta_blind = std::abs(projection.shifts(0, j)) * blind;
    test.F0_blind = std::abs(projection.shifts(1, j)) * blind;
    tests.push_back(test);
  }
  return tests;
}

/// Best explanation first. Of those that explain the same but for rounding, as a mass and a stiffness do where only
/// k/m counts, the one comes first whose constant is stated with the larger uncertainty, then the order of the
/// list.
void sort_by_explained(const JointModel& model, const TestOptions& options, std::vector<RelaxationTest>& tests) {
  const auto deviation = [&](const RelaxationTest& test) {
    const Freed freed = model.relaxations[test.index].freed;
    return freed == Freed::mass ? options.mass : freed == Freed::stiffness ? options.stiffness : 0.0;
  };
  const auto before = [&](const RelaxationTest& a, const RelaxationTest& b) {
    return is_tie(deviation(a), deviation(b)) ? a.index < b.index : deviation(a) > deviation(b);
  };
  constexpr double unit = 1.0;  // of log-likelihoods
  sort_with_ties(tests, &RelaxationTest::explained, before, unit);
}

/// Relaxations that may explain the departure, best first, at most two of an assumption. Far from the fit the true
/// one may explain only half as much as the best. Constants, and what else has a fit far from the plain one, are
/// always candidates: a motion that is out of step with the model's is far from the fit. `missed`: the model misses
/// the whole record, and every one is a candidate.
std::vector<RelaxationTest> candidates(const JointModel& model, const TestOptions& options,
                                       std::vector<RelaxationTest> tests, bool missed) {
  sort_by_explained(model, options, tests);
  std::vector<RelaxationTest> list;
  for (const RelaxationTest& test : tests) {
    if (missed && test.explained == 0.0) continue;  // of an impossible sign
    const Relaxation& own = model.relaxations[test.index];
    const double share = own.assumption == Assumption::constants || own.is_far ? 0.0 : 0.5;
    const double least = std::min(tests.front().explained - equal_likelihood, share * tests.front().explained);
    if (!missed && test.explained < (model.refit ? least : tests.front().explained - equal_likelihood)) continue;
    const auto known = std::ranges::count_if(list, [&](const RelaxationTest& other) {
      return model.relaxations[other.index].assumption == own.assumption;
    });
    if (missed || own.is_far || known < 2) list.push_back(test);
  }
  const bool may_be_friction = std::ranges::any_of(
      list, [&](const RelaxationTest& test) { return is_of_law(model.relaxations[test.index].assumption); });
  if (!model.refit || !may_be_friction) return list;
  for (const std::size_t index : model.hidden) list.push_back({.index = index, .p_value = list.front().p_value});
  return list;
}

/// What these relaxations change zeta and F0 by. A fit that could not move from where it began leaves the whole
/// effect to the step of its linear model, and else would show none.
Eigen::Vector2d change_between(const JointModel& before, const JointModel& after, const Taken& taken) {
  Eigen::Vector2d change(after.value.zeta - before.value.zeta, after.value.F0 - before.value.F0);
  if (!change.isZero(0.0)) return change;
  const Eigen::VectorXd step =
      pivoted_least_squares(free_columns(after.base, after.relaxed, taken), after.residuals);
  if (step.allFinite()) change = step.head<2>();
  return change;
}

void set_change(const Eigen::Vector2d& change, RelaxationTest& test) {
  test.zeta_change = change[0];
  test.F0_change = change[1];
}

/// What is left for the other relaxations once the model is fitted with a candidate and those taken.
struct Rest {
  double p_value = 1.0;
  double misfit = 0.0;             ///< of the fit; if its likelihood is not known, the gain by one more relaxation
  std::vector<std::size_t> alike;  ///< relaxations that cannot be told from the candidate and those taken
  Eigen::Vector2d change = {unknown, unknown};  ///< of zeta and F0
  KnownConstants constants;
};

Rest rest_of(const JointModel& model, Taken taken, std::size_t candidate, double least_change) {
  taken.push_back(candidate);
  const JointModel fitted = model.refit(taken);
  Rest rest;
  rest.change = change_between(model, fitted, taken);
  rest.constants = fitted.constants;
  const Projection projection = project(fitted, taken);
  rest.alike = projection.alike;
  if (!fitted.is_possible || !std::isfinite(projection.residuals.squaredNorm())) {
    rest.misfit = core::infinity;
    return rest;
  }
  for (const RelaxationTest& test : tests_beside(fitted, projection, least_change)) {
    rest.p_value = std::min(rest.p_value, test.p_value);
    rest.misfit = std::max(rest.misfit, test.explained);
  }
  if (!std::isnan(fitted.deviance)) rest.misfit = fitted.deviance;
  return rest;
}

/// The departure that the tests show: the relaxation that explains it best, and those that explain it as well. Far
/// from the fit a linearised model ranks them wrongly. Where the model can be fitted again, candidates are
/// therefore judged by the misfit that they leave. `missed`: the model misses the whole record.
FoundDeparture departure_shown(const JointModel& model, const Taken& taken,
                               const std::vector<RelaxationTest>& tests, const TestOptions& options, bool missed) {
  std::vector<RelaxationTest> list = candidates(model, options, tests, missed);
  if (!model.refit || list.size() <= 1) return {list};
  std::vector<Rest> rests;
  std::vector<double> misfits;
  for (RelaxationTest& test : list) {
    rests.push_back(rest_of(model, taken, test.index, options.least_change));
    misfits.push_back(rests.back().misfit);
    set_change(rests.back().change, test);
    test.constants = rests.back().constants;
  }
  // A hidden relaxation is never charged alone, but beside a departure of friction.
  const auto is_hidden = [&](std::size_t i) {
    return std::ranges::find(model.hidden, list[i].index) != model.hidden.end();
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < list.size(); ++i)
    if (!is_hidden(i) && misfits[i] < misfits[best] - equal_likelihood) best = i;
  best = sensor_before_symmetry(model, list, misfits, best);
  FoundDeparture departure{{list[best]}};
  const Assumption charged = model.relaxations[list[best].index].assumption;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if ((is_hidden(i) && !is_of_law(charged)) || yields_to_sensor(model, list, misfits, best, i)) continue;
    const bool leaves_more = rests[i].p_value < family_level && rests[best].p_value >= family_level;
    const bool as_well = !leaves_more && misfits[i] <= misfits[best] + equal_likelihood;
    // Those with nearly the same column differ by the finest detail of the model, and by chance.
    const bool alike = std::ranges::find(rests[best].alike, list[i].index) != rests[best].alike.end() &&
                       misfits[i] <= misfits[best] + far_better;
    if (i != best && (as_well || alike)) departure.explanations.push_back(list[i]);
  }
  return departure;
}

/// Does a relaxed model explain what the one before missed as a whole: far better, with nothing left beside it?
bool explains(const JointModel& relaxed, const Taken& taken, double deviance_before, double least_change) {
  if (!(relaxed.deviance < deviance_before - far_better) || leaves_misfit(relaxed, taken, least_change))
    return false;
  const std::vector<RelaxationTest> tests = tests_beside(relaxed, project(relaxed, taken), least_change);
  return std::ranges::all_of(tests, [](const RelaxationTest& test) { return test.p_value >= family_level; });
}

/// Adds to each departure the relaxations that are like the one taken for it and explain it as well beside the
/// others: when the first departure was charged, what the others add decided between relaxations nearly the same.
void name_alike(const JointModel& model, const Taken& taken, const std::vector<std::size_t>& alike,
                double least_change, std::vector<FoundDeparture>& departures) {
  if (!model.refit || departures.size() < 2) return;
  for (std::size_t d = 0; d < departures.size(); ++d) {
    std::vector<RelaxationTest>& explanations = departures[d].explanations;
    Taken others = taken;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(d));
    std::optional<Rest> own;
    const std::vector<std::size_t> like_this = project(model, {taken[d]}).alike;
    for (const std::size_t index : alike) {
      const bool is_named = std::ranges::find(explanations, index, &RelaxationTest::index) != explanations.end();
      if (is_named || std::ranges::find(like_this, index) == like_this.end()) continue;
      if (!own) own = rest_of(model, others, taken[d], least_change);
      const Rest rest = rest_of(model, others, index, least_change);
      const bool leaves_as_little = rest.p_value >= family_level || own->p_value < family_level;
      if (!leaves_as_little || !(rest.misfit <= own->misfit + far_better)) continue;
      RelaxationTest test{.index = index, .p_value = explanations.front().p_value, .constants = rest.constants};
      set_change(rest.change, test);
      explanations.push_back(test);
    }
  }
}

/// Departures one after another, each charged to what explains it best.
RelaxationTests one_after_another(const JointModel& model, const TestOptions& options) {
  const double least_change = options.least_change;
  RelaxationTests result;
  Taken taken;
  constexpr std::size_t most_departures = 4;
  Projection projection = project(model, taken);
  for (std::size_t j = 0; j < model.relaxations.size(); ++j)
    if (std::ranges::find(projection.indices, j) == projection.indices.end() &&
        is_told(model.relaxed.col(static_cast<Eigen::Index>(j)).squaredNorm()))
      result.alone.push_back(j);
  while (true) {
    const JointModel& here = result.relaxed ? *result.relaxed : model;
    result.tests = tests_beside(here, projection, least_change);
    result.freedom = projection.freedom;
    result.misfit = misfit_of(here, taken, least_change);
    const auto least = std::ranges::min_element(result.tests, {}, &RelaxationTest::p_value);
    if (least == result.tests.end() || taken.size() == most_departures) break;
    const bool rejects = least->p_value < family_level;
    if (!rejects && !(result.misfit && model.refit)) break;
    FoundDeparture found = departure_shown(here, taken, result.tests, options, result.misfit.has_value());
    if (found.explanations.empty()) break;
    name_speed_beside_drift(here, result.tests, found);
    RelaxationTest& best = found.explanations.front();
    Taken further = taken;
    further.push_back(best.index);
    std::optional<JointModel> relaxed;
    if (model.refit) relaxed = model.refit(further);
    if (!rejects && !explains(*relaxed, further, here.deviance, least_change)) break;
    // All explanations of a departure have the p-value of the departure.
    const double p_value = rejects ? least->p_value : result.misfit->p_value;
    for (RelaxationTest& test : found.explanations) test.p_value = p_value;
    if (relaxed) {
      set_change(change_between(here, *relaxed, further), best);
      best.constants = relaxed->constants;
      result.relaxed = std::move(relaxed);
    }
    result.departures.push_back(std::move(found));
    taken = std::move(further);
    projection = project(result.relaxed ? *result.relaxed : model, taken);
  }
  name_alike(model, taken, projection.alike, least_change, result.departures);
  return result;
}

/// Relaxations of what is stated with an uncertainty: the constant with the larger one, and gains.
Taken stated_as_uncertain(const JointModel& model, const TestOptions& options) {
  const Freed constant = options.mass >= options.stiffness ? Freed::mass : Freed::stiffness;
  const bool has_constant = std::max(options.mass, options.stiffness) > 0.0;
  Taken result;
  std::ranges::copy_if(project(model, {}).indices, std::back_inserter(result), [&](std::size_t index) {
    const Freed freed = model.relaxations[index].freed;
    return (freed == constant && has_constant) || (freed == Freed::gain && options.gains);
  });
  return result;
}

/// The departures if errors of several stated numbers explain the record together, none beyond what is allowed.
std::optional<RelaxationTests> stated_errors_together(const JointModel& model, double p_value,
                                                      const TestOptions& options) {
  const Taken uncertain = stated_as_uncertain(model, options);
  if (!model.refit || uncertain.size() < 2) return std::nullopt;
  RelaxationTests result{.relaxed = model};
  Taken taken;
  for (const std::size_t index : uncertain) {
    RelaxationTest test{.index = index, .p_value = p_value};
    taken.push_back(index);
    const JointModel& here = *result.relaxed;
    const Eigen::MatrixXd columns = free_columns(here.base, here.relaxed, taken);
    test.coefficient = pivoted_least_squares(columns, here.residuals)[columns.cols() - 1];
    JointModel next = model.refit(taken);
    set_change(change_between(here, next, taken), test);
    const KnownConstants now = test.constants = next.constants;
    result.relaxed = std::move(next);
    const double ratio = now.stiffness / model.constants.stiffness * model.constants.mass / now.mass;
    const double error = model.relaxations[index].freed == Freed::gain ? test.coefficient : std::log(ratio);
    if (!(std::abs(error) < options.allowed)) return std::nullopt;
    result.departures.push_back({{test}});
  }
  const Projection rest = project(*result.relaxed, taken);
  result.tests = tests_beside(*result.relaxed, rest, options.least_change);
  result.freedom = rest.freedom;
  result.misfit = misfit_of(*result.relaxed, taken, options.least_change);
  const auto rejects = [](const RelaxationTest& test) { return test.p_value < family_level; };
  if (result.misfit || result.tests.empty() || std::ranges::any_of(result.tests, rejects)) return std::nullopt;
  name_alike(model, taken, rest.alike, options.least_change, result.departures);
  return result;
}

}  // namespace

RelaxationTests test_relaxations(const JointModel& model, const TestOptions& options) {
  RelaxationTests result = one_after_another(model, options);
  const auto is_of_stated = [&](const RelaxationTest& test) {
    const Freed freed = model.relaxations[test.index].freed;
    return freed != Freed::effect && freed != Freed::delay;
  };
  const bool charges_more = std::ranges::any_of(result.departures, [&](const FoundDeparture& departure) {
    return std::ranges::none_of(departure.explanations, is_of_stated);
  });
  if (!charges_more) return result;
  const RelaxationTest& first = result.departures.front().explanations.front();
  std::optional<RelaxationTests> together = stated_errors_together(model, first.p_value, options);
  if (together) together->alone = result.alone;
  return together ? *together : result;
}

}  // namespace dualdamp::identify
