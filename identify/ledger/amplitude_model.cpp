#include "identify/ledger/amplitude_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "core/constants.hpp"
#include "identify/conclusion.hpp"
#include "identify/ledger/amplitude_noise.hpp"
#include "identify/ledger/amplitude_states.hpp"
#include "identify/ledger/amplitude_step.hpp"
#include "identify/ledger/amplitude_terms.hpp"
#include "identify/ledger/stated_noise.hpp"
#include "identify/methods/amplitudes/steady_states.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/scatter.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

namespace {

struct AmplitudeFit {
  SteadyParameters at;
  Deviations deviations;
  AmplitudeRows rows;
  std::optional<AmplitudeStates> states;  ///< what gives the rows with the columns of all relaxations
  double deviance = core::infinity;       ///< -2 log-likelihood
  double scatter = 1.0;                   ///< of the amplitudes about a smooth curve, over their deviation
};

/// The noise of one channel: what a smooth curve leaves of its residuals. A departure is smooth, so it is not taken
/// for noise. Of few states the curve is over the fitted amplitudes: at one level of Y a measured one is a curve
/// over r and its own noise. Of many it is over the measured ones, which hold where the model misses the record.
double scale_of(const AmplitudeStates& states, const Eigen::VectorXd& residuals, Eigen::Index first,
                Eigen::Index count) {
  Eigen::MatrixXd curve(count, states.smooth_columns());
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < states.points().size() && row < count; ++i) {
    const SteadyPoint& point = states.points()[i];
    if (first > 0 && std::isnan(point.phase)) continue;
    const double x = states.amplitudes() < many_states ? states.true_x(i) : point.x;
    const double r = point.r - 1.0;
    std::array<double, 6> powers{1.0, x, x * x};
    if (states.frequencies() > 1) powers = {1.0, x, r, r * r, x * x, r * r * r};
    curve.row(row++) = Eigen::Map<const Eigen::RowVectorXd>(powers.data(), curve.cols());
  }
  const Eigen::VectorXd own = residuals.segment(first, count);
  const Eigen::VectorXd left = left_beside(curve, own);
  const double freedom = std::max(1.0, static_cast<double>(count - curve.cols()));
  return std::sqrt(std::max(left.squaredNorm() / freedom, 1e-28));
}

/// The fit with sigma_Y = `ratio` sigma_x. A fit that once came near zeta = 0 climbs from there by half of zeta in
/// a step, so it may need more steps than most. Amplitudes alone hardly show some relaxations, and more steps only
/// take these further from what is possible.
AmplitudeFit fit_with(AmplitudeStates states, const SteadyParameters& begin, const Taken& taken, double ratio) {
  AmplitudeFit fit;
  fit.at = begin;
  const KnownDeviations& known = states.known();
  fit.deviations = {ratio > 1e3 ? 0.0 : 1e-3, ratio > 1e3 ? 1e-3 : 1e-3 * ratio, 1e-2};
  if (is_stated(known)) fit.deviations = {known.sigma_x, known.sigma_Y, 1e-2};
  constexpr int fewest = 14;
  const int most = states.with_phases() ? 40 : fewest;
  for (int i = 1; i <= most; ++i) {
    fit.rows = states.linearise(fit.at, fit.deviations, taken);
    const Eigen::MatrixXd columns = free_columns(fit.rows.base, fit.rows.relaxed, taken);
    const Eigen::VectorXd step = pivoted_least_squares(columns, fit.rows.residuals);
    if (!step.allFinite()) return fit;
    const SteadyParameters before = fit.at;
    take_step(step, taken, fit.at);
    if (i == most || (i >= fewest && is_settled(before, fit.at))) break;
    const Eigen::VectorXd left = fit.rows.residuals - columns * step;
    const double amplitude = scale_of(states, left, 0, states.amplitudes());
    fit.scatter = amplitude;
    if (!is_stated(known)) {
      fit.deviations.x *= amplitude;
      fit.deviations.Y *= amplitude;
    }
    if (states.tells_phase_noise())
      fit.deviations.phase *= scale_of(states, left, states.amplitudes(), states.phases());
    else
      fit.deviations.phase = std::max(fit.deviations.x, fit.deviations.Y);
    limit(fit.deviations, states.largest());
    if (is_stated(known)) {
      fit.deviations.x = known.sigma_x;
      fit.deviations.Y = known.sigma_Y;
    }
  }
  fit.states = states;
  fit.rows = states.linearise(fit.at, fit.deviations, taken);
  const Eigen::MatrixXd columns = free_columns(fit.rows.base, fit.rows.relaxed, taken);
  const double left = left_beside(columns, fit.rows.residuals).squaredNorm();
  fit.deviance = left + 2.0 * fit.rows.log_variances;
  return fit;
}

/// The fit with the columns of all relaxations, which cost as much as its search: those of the best fit alone are
/// read.
AmplitudeFit with_all_columns(AmplitudeFit fit) {
  if (!fit.states) return fit;
  Taken all(static_cast<std::size_t>(fit.at.g.size()));
  std::iota(all.begin(), all.end(), 0);
  fit.rows = fit.states->linearise(fit.at, fit.deviations, all);
  fit.states.reset();
  return fit;
}

/// The fit with the best ratio of the deviations. Some 25 states hardly determine it, so it has a prior: sensors of
/// equal relative accuracy, with a factor of three as one standard deviation. At one frequency without phases the
/// record does not determine it at all, because the gain of Y on x hardly varies: only x has errors then.
AmplitudeFit best_fit(const AmplitudeStates& states, const SteadyParameters& begin, const Taken& taken) {
  if (is_stated(states.known())) return with_all_columns(fit_with(states, begin, taken, 1.0));
  if (states.frequencies() < 2 && states.phases() == 0)
    return with_all_columns(fit_with(states, begin, taken, 0.0));
  const double deviation = std::log(3.0);
  AmplitudeFit best;
  double least = core::infinity;
  for (const double share : {0.03, 0.1, 0.3, 0.55, 1.0, 1.8, 3.3, 10.0}) {
    AmplitudeFit fit = fit_with(states, begin, taken, share * mean_ratio(states.points()));
    const double deviance = fit.deviance + std::pow(std::log(share) / deviation, 2);
    if (deviance < least || !std::isfinite(best.deviance)) {
      best = std::move(fit);
      least = deviance;
    }
  }
  return with_all_columns(std::move(best));
}

/// Leaves out the terms that amplitudes alone do not show. At resonance the drive is in quadrature with the motion,
/// and a force in phase with the motion hardly changes its amplitude: only an absurd force would be seen. Such a
/// term is not tested, but may explain what another test finds.
void leave_out_unseen(const AmplitudeStates& states, const PlainFriction& friction, const Taken& taken,
                      JointModel& model) {
  if (states.with_phases()) return;
  constexpr double seen = 0.2;
  constexpr double small = 1e-5;
  const std::vector<const AmplitudeTerm*>& terms = states.terms();
  for (std::size_t j = 0; j < terms.size(); ++j) {
    double radial = 0.0;
    double whole = 0.0;
    for (const SteadyPoint& point : states.points()) {
      const std::complex<double> drive = plain_drive(friction, point.x, point.r);
      const std::complex<double> change = terms[j]->drive(friction, point.x, point.r, small) - drive;
      radial += std::pow(std::real(change * std::conj(drive)) / std::abs(drive), 2);
      whole += std::norm(change);
    }
    if (!(radial < seen * seen * whole) || std::ranges::find(taken, j) != taken.end()) continue;
    model.relaxed.col(static_cast<Eigen::Index>(j)).setZero();
    model.hidden.push_back(j);
  }
}

/// The constants with the fitted natural frequency: another stiffness, or another mass.
KnownConstants constants_at(const AmplitudeFit& fit, const AmplitudeStates& states, KnownConstants constants) {
  for (std::size_t j = 0; j < states.terms().size(); ++j) {
    const double g = fit.at.g[static_cast<Eigen::Index>(j)];
    if (states.terms()[j]->freed == Freed::stiffness) constants.stiffness *= std::exp(-2.0 * g);
    if (states.terms()[j]->freed == Freed::mass) constants.mass *= std::exp(2.0 * g);
  }
  return constants;
}

/// The fit with more relaxations free than `fit`. It is never worse: it may begin at `fit` as well, and may stay.
AmplitudeFit fit_beside(const AmplitudeFit& fit, const AmplitudeStates& states, const Taken& hidden,
                        const Taken& taken) {
  SteadyParameters begin{start_beside(fit.at.friction, states.points()), states.none_relaxed()};
  AmplitudeFit best = best_fit(states, begin, taken);
  const auto try_from = [&](const SteadyParameters& start) {
    AmplitudeFit other = best_fit(states, start, taken);
    if (other.deviance < best.deviance) best = std::move(other);
  };
  // A term of second order has no slope at zero: the fit begins away from it.
  if (std::ranges::any_of(taken, [&](std::size_t j) { return std::ranges::find(hidden, j) != hidden.end(); }))
    for (const double g : {0.02, -0.02}) {
      for (const std::size_t j : taken) begin.g[static_cast<Eigen::Index>(j)] = g;
      try_from(begin);
    }
  if (best.deviance > fit.deviance) try_from(fit.at);
  return best.deviance > fit.deviance ? fit : best;
}

JointModel amplitude_model_of(const AmplitudeFit& fit, const AmplitudeStates& states, const Taken& relaxed,
                              double unit, const KnownConstants& stated) {
  const KnownConstants constants = constants_at(fit, states, stated);
  JointModel model;
  model.constants = constants;
  model.data = std::to_string(states.points().size()) + " steady states" +
               (states.with_phases() ? " with phases" : " without phases");
  model.residuals = fit.rows.residuals;
  model.readings = fit.rows.readings;
  for (Reading& reading : model.readings)
    if (reading.kind == ReadingKind::amplitude) reading.per_deviation *= unit;
  model.base = fit.rows.base;
  model.deviance = fit.deviance;
  model.relaxations = states.relaxations();
  model.relaxed = fit.rows.relaxed;
  leave_out_unseen(states, fit.at.friction, relaxed, model);
  model.is_stated = is_stated(states.known());
  set_noise(states.amplitudes(), states.phases(), states.smooth_columns(), model);
  model.refit = [states, fit, hidden = model.hidden, unit, stated](const Taken& taken) {
    return amplitude_model_of(fit_beside(fit, states, hidden, taken), states, taken, unit, stated);
  };
  const double to_force = constants.stiffness * unit;
  // The column of the stiffness is at constant F0 = k x_f.
  for (std::size_t j = 0; j < states.terms().size(); ++j) {
    auto column = model.relaxed.col(static_cast<Eigen::Index>(j));
    if (states.terms()[j]->freed == Freed::stiffness && !column.isZero(0.0))
      column += 2.0 * fit.at.friction.x_f * model.base.col(1);
  }
  model.F0_parts = Eigen::VectorXd::Zero(model.relaxed.cols());
  const auto terms = static_cast<Eigen::Index>(states.terms().size());
  model.F0_parts.tail(model.relaxed.cols() - terms).setConstant(to_force);
  model.base.col(1) /= to_force;
  model.value = parameters(fit.at.friction.zeta, fit.at.friction.x_f * unit, constants);
  return model;
}

}  // namespace

std::variant<JointModel, std::string> amplitude_model(const Record& record, const KnownConstants& constants,
                                                      const KnownDeviations& known) {
  if (std::string fault = lacks_constants(constants); !fault.empty()) return fault;
  Estimate taken;
  const std::optional<std::vector<Pair>> pairs = take_states(record, constants, false, taken);
  if (!pairs) return taken.reason;
  constexpr std::size_t fewest = 4;
  if (pairs->size() < fewest) return "fewer than four steady states";
  const double unit = std::ranges::max_element(*pairs, {}, &Pair::x)->x;
  std::vector<SteadyPoint> points = points_of(*pairs, constants, unit);
  std::vector<std::string> left_out;
  KnownDeviations stated{known.sigma_x / unit, known.sigma_Y / unit};
  double ratio = 1.0;
  while (points.size() >= fewest) {
    if (std::string lack = lacks_levels(points); !lack.empty()) return lack;
    const AmplitudeStates states(points, true, stated);
    const AmplitudeFit fit = best_fit(states, {first_guess(points), states.none_relaxed()}, {});
    if (!std::isfinite(fit.deviance)) return "no damping ratio and friction force fit the steady states";
    if (drop_sticking(points, fit.at.friction, left_out)) continue;
    const double freedom = static_cast<double>(states.amplitudes() - states.smooth_columns());
    if (is_stated(stated)) ratio = fit.scatter;
    const ScatterBesideStated scatter = readings_scatter(ratio, is_stated(known) ? freedom : 0.0);
    if (scatter == ScatterBesideStated::more && is_stated(stated)) {
      stated = {};
      continue;
    }
    JointModel model = amplitude_model_of(fit, states, {}, unit, constants);
    note_contradiction(scatter, ratio, "amplitudes", model);
    model.left_out = std::move(left_out);
    return model;
  }
  return "fewer than four steady states do not stick";
}

}  // namespace dualdamp::identify
