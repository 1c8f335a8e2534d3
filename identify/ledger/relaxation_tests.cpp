#include "identify/ledger/relaxation_tests.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/random.hpp"
#include "identify/statistics/distributions.hpp"

namespace dualdamp::identify {

namespace {

/// Share of a column's length that the base parameters must leave for it to be told from them.
constexpr double told_apart = 1e-4;
/// Standard errors at which a departure is found in four records of five.
constexpr double found_at = 2.8;

/// The relaxations beside a base, projected.
struct Projection {
  Eigen::VectorXd residuals;
  double freedom = 0.0;
  double scale_freedom = 0.0;        ///< behind the deviation that a statistic is over
  std::vector<std::size_t> indices;  ///< of the relaxations that can be told apart
  Eigen::MatrixXd unit;              ///< their columns beside the base, of unit length
  Eigen::VectorXd lengths;
  Eigen::MatrixXd shifts;  ///< of the base parameters for a unit of each relaxation
};

Projection project(const JointModel& model, const std::vector<std::size_t>& taken) {
  const Eigen::Index own = model.base.cols();
  const auto more = static_cast<Eigen::Index>(taken.size());
  Eigen::MatrixXd base(model.base.rows(), own + more);
  base.leftCols(own) = model.base;
  for (Eigen::Index j = 0; j < more; ++j)
    base.col(own + j) = model.relaxed.col(static_cast<Eigen::Index>(taken[static_cast<std::size_t>(j)]));
  const Eigen::VectorXd scale = base.colwise().norm().cwiseMax(1e-300);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(base * scale.cwiseInverse().asDiagonal());
  const Eigen::MatrixXd solved = scale.cwiseInverse().asDiagonal() * qr.solve(model.relaxed);
  const Eigen::MatrixXd beside = model.relaxed - base * solved;

  Projection result;
  result.residuals = model.residuals - base * (scale.cwiseInverse().asDiagonal() * qr.solve(model.residuals));
  result.freedom = static_cast<double>(base.rows() - qr.rank()) - model.spent;
  // A statistic may rest on one channel, or on all.
  result.scale_freedom = 0.5 * (result.freedom + std::min(result.freedom, std::max(2.0, model.scale_freedom)));
  for (Eigen::Index j = 0; j < beside.cols(); ++j)
    if (beside.col(j).norm() > told_apart * model.relaxed.col(j).norm())
      result.indices.push_back(static_cast<std::size_t>(j));
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
  return result;
}

/// t statistics of unit columns beside residuals with `freedom`.
Eigen::VectorXd statistics(const Eigen::VectorXd& along, double squares, double freedom) {
  const Eigen::ArrayXd left = (squares - along.array().square()).max(1e-12 * squares) / (freedom - 1.0);
  return along.array() / left.sqrt();
}

double two_sided(double t, double freedom) { return f_test_p_value(t * t, 1.0, freedom); }

/// By how much each test may be stricter than others, as a factor on |t|. Where the least change of zeta or F0 that
/// matters lies many standard errors off, a test sees it at a strict level as well; the level that it does not use
/// is left to those that need it.
Eigen::VectorXd strictness_of(const JointModel& model, const Projection& projection, double deviation,
                              double least_change) {
  constexpr double most = 1.6;
  constexpr double usual = 3.0;  // |t| that is significant for a family
  constexpr double seen = 2.0;   // and that it reaches beyond with a probability of 0.98
  Eigen::VectorXd strictness = Eigen::VectorXd::Ones(projection.lengths.size());
  for (Eigen::Index j = 0; j < strictness.size(); ++j) {
    const double unit = deviation / projection.lengths[j];
    const double zeta = std::abs(projection.shifts(0, j)) * unit / std::abs(model.value.zeta);
    const auto own = static_cast<Eigen::Index>(projection.indices[static_cast<std::size_t>(j)]);
    const double part = model.F0_parts.size() > 0 ? model.F0_parts[own] : 0.0;
    const double F0 = std::max(std::abs(projection.shifts(1, j)), part) * unit / std::abs(model.value.F0);
    const double errors = least_change / std::max({zeta, F0, 1e-12});
    if (std::isfinite(errors)) strictness[j] = std::clamp((errors - seen) / usual, 1.0, most);
  }
  return strictness;
}

/// The largest |t| over its strictness of draws under the base model, ascending.
std::vector<double> largest_statistics(const Projection& projection, const Eigen::VectorXd& strictness) {
  constexpr std::size_t draws = 2000;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(projection.unit);
  const auto rank = std::min<Eigen::Index>(qr.rank(), static_cast<Eigen::Index>(projection.scale_freedom));
  const Eigen::MatrixXd basis =
      Eigen::MatrixXd(qr.householderQ() * Eigen::MatrixXd::Identity(projection.unit.rows(), rank));
  const Eigen::MatrixXd directions = projection.unit.transpose() * basis;
  const double beside = std::max(0.0, projection.scale_freedom - static_cast<double>(rank));
  constexpr core::RandomStream stream{20261122, 1};
  std::uint64_t drawn = 0;
  std::vector<double> largest;
  largest.reserve(draws);
  Eigen::VectorXd z(rank);
  for (std::size_t i = 0; i < draws; ++i) {
    for (double& value : z) value = stream.normal(drawn++);
    double squares = z.squaredNorm();
    // Chi-square beside the span of the columns, by Wilson and Hilferty's cube.
    if (beside > 0.0) {
      const double width = 2.0 / (9.0 * beside);
      const double root = 1.0 - width + std::sqrt(width) * stream.normal(drawn++);
      squares += beside * std::max(0.0, root * root * root);
    }
    const Eigen::VectorXd t = statistics(directions * z, squares, projection.scale_freedom);
    largest.push_back(t.cwiseQuotient(strictness).cwiseAbs().maxCoeff());
  }
  std::ranges::sort(largest);
  return largest;
}

double family_p_value(double t, double strictness, double freedom, const std::vector<double>& largest) {
  const auto above = largest.end() - std::ranges::lower_bound(largest, std::abs(t) / strictness);
  constexpr int enough = 20;  // fewer of the draws say little
  const auto draws = static_cast<double>(largest.size());
  if (above >= enough) return static_cast<double>(above) / draws;
  // Beyond them the tail falls as that of one test.
  const double last = largest[largest.size() - enough];
  const double tail = two_sided(std::abs(t) / strictness, freedom) / two_sided(last, freedom);
  return enough / draws * std::min(1.0, tail);
}

/// Tests of all relaxations beside those taken.
std::vector<RelaxationTest> tests_beside(const JointModel& model, const Projection& projection,
                                         double least_change) {
  std::vector<RelaxationTest> tests;
  if (projection.indices.empty() || projection.freedom < 2.0) return tests;
  const double squares = projection.residuals.squaredNorm();
  const Eigen::VectorXd along = projection.unit.transpose() * projection.residuals;
  const Eigen::VectorXd t = statistics(along, squares, projection.freedom);
  const double deviation = std::sqrt(squares / projection.freedom);
  const Eigen::VectorXd strictness = strictness_of(model, projection, deviation, least_change);
  const std::vector<double> largest = largest_statistics(projection, strictness);
  for (Eigen::Index j = 0; j < t.size(); ++j) {
    RelaxationTest test;
    test.index = projection.indices[static_cast<std::size_t>(j)];
    test.t = t[j];
    test.p_value = family_p_value(t[j], strictness[j], projection.scale_freedom - 1.0, largest);
    test.p_alone = two_sided(t[j], projection.scale_freedom - 1.0);
    const double rows = projection.freedom + static_cast<double>(model.base.cols());
    test.explained = rows * std::log1p(t[j] * t[j] / (projection.freedom - 1.0));
    const double gain = along[j] / projection.lengths[j];
    const double error =
        std::sqrt((squares - along[j] * along[j]) / (projection.freedom - 1.0)) / projection.lengths[j];
    test.zeta_change = projection.shifts(0, j) * gain;
    test.F0_change = projection.shifts(1, j) * gain;
    if (model.F0_parts.size() > 0) test.F0_part = gain * model.F0_parts[static_cast<Eigen::Index>(test.index)];
    test.zeta_blind = found_at * std::abs(projection.shifts(0, j)) * error;
    test.F0_blind = found_at * std::abs(projection.shifts(1, j)) * error;
    tests.push_back(test);
  }
  return tests;
}

/// Relaxations that may explain the departure, best first: two of an assumption at most. Far from the fit one that
/// explains half as much as the best may be it, and a constant that explains little: a motion out of step with the
/// model's is far away.
std::vector<RelaxationTest> candidates(const JointModel& model, std::vector<RelaxationTest> tests) {
  std::ranges::sort(tests, std::greater<>(), &RelaxationTest::explained);
  std::vector<RelaxationTest> list;
  for (const RelaxationTest& test : tests) {
    const double share = model.relaxations[test.index].assumption == Assumption::constants ? 0.05 : 0.5;
    const double least = std::min(tests.front().explained - equal_likelihood, share * tests.front().explained);
    if (test.explained < (model.refit ? least : tests.front().explained - equal_likelihood)) continue;
    const Assumption assumption = model.relaxations[test.index].assumption;
    const auto known = std::ranges::count_if(
        list, [&](const RelaxationTest& other) { return model.relaxations[other.index].assumption == assumption; });
    if (known < 2) list.push_back(test);
  }
  if (!model.refit) return list;
  for (const std::size_t index : model.hidden) {
    RelaxationTest test;
    test.index = index;
    test.p_value = list.front().p_value;
    list.push_back(test);
  }
  return list;
}

/// What the model fitted with a candidate beside those taken leaves to the others.
struct Rest {
  double p_value = 1.0;
  double largest = 0.0;
  ParameterSet value;
};

Rest rest_of(const JointModel& model, std::vector<std::size_t> taken, std::size_t candidate, double least_change) {
  taken.push_back(candidate);
  const JointModel fitted = model.refit(taken);
  Rest rest;
  rest.value = fitted.value;
  for (const RelaxationTest& test : tests_beside(fitted, project(fitted, taken), least_change)) {
    rest.p_value = std::min(rest.p_value, test.p_value);
    rest.largest = std::max(rest.largest, test.explained);
  }
  return rest;
}

/// The departure that the tests show: the relaxation that explains it best, and those that explain it as well. Far
/// from the fit a linearised model ranks them wrongly: where it can be fitted anew, candidates are judged by what
/// they leave.
Departure charged(const JointModel& model, const std::vector<std::size_t>& taken,
                  const std::vector<RelaxationTest>& tests, double least_change) {
  std::vector<RelaxationTest> list = candidates(model, tests);
  if (!model.refit || list.size() == 1) return {list};
  std::vector<Rest> rests;
  for (RelaxationTest& test : list) {
    rests.push_back(rest_of(model, taken, test.index, least_change));
    test.zeta_change = rests.back().value.zeta - model.value.zeta;
    test.F0_change = rests.back().value.F0 - model.value.F0;
  }
  // What the record shows in the second order only is never charged alone: it stands beside a departure of
  // friction.
  const auto is_hidden = [&](std::size_t i) {
    return std::ranges::find(model.hidden, list[i].index) != model.hidden.end();
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < list.size(); ++i)
    if (!is_hidden(i) && rests[i].largest < rests[best].largest - equal_likelihood) best = i;
  Departure departure{{list[best]}};
  const Assumption charged = model.relaxations[list[best].index].assumption;
  const bool of_friction = charged == Assumption::friction_velocity || charged == Assumption::friction_displacement;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (is_hidden(i) && !of_friction) continue;
    const bool as_well = rests[i].largest <= rests[best].largest + equal_likelihood &&
                         (rests[i].p_value >= family_level || rests[best].p_value < family_level);
    if (i != best && as_well) departure.explanations.push_back(list[i]);
  }
  return departure;
}

}  // namespace

RelaxationTests test_relaxations(const JointModel& model, double least_change) {
  RelaxationTests result;
  std::vector<std::size_t> taken;
  constexpr std::size_t most_departures = 4;
  Projection projection = project(model, taken);
  for (std::size_t j = 0; j < model.relaxations.size(); ++j)
    if (std::ranges::find(projection.indices, j) == projection.indices.end() &&
        model.relaxed.col(static_cast<Eigen::Index>(j)).squaredNorm() > 0.0)
      result.alone.push_back(j);
  while (true) {
    const JointModel& here = result.relaxed ? *result.relaxed : model;
    result.tests = tests_beside(here, projection, least_change);
    result.freedom = projection.freedom;
    const auto least = std::ranges::min_element(result.tests, {}, &RelaxationTest::p_value);
    if (least == result.tests.end() || least->p_value >= family_level || taken.size() == most_departures) break;
    result.departures.push_back(charged(here, taken, result.tests, least_change));
    // That of the departure, whichever relaxation is charged with it.
    for (RelaxationTest& test : result.departures.back().explanations) test.p_value = least->p_value;
    RelaxationTest& best = result.departures.back().explanations.front();
    taken.push_back(best.index);
    if (model.refit) {
      JointModel relaxed = model.refit(taken);
      best.zeta_change = relaxed.value.zeta - here.value.zeta;
      best.F0_change = relaxed.value.F0 - here.value.F0;
      result.relaxed = std::move(relaxed);
    }
    projection = project(result.relaxed ? *result.relaxed : model, taken);
  }
  return result;
}

}  // namespace dualdamp::identify
