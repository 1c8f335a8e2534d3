#include "identify/ledger/amplitude_model.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <vector>

#include "core/constants.hpp"
#include "identify/conclusion.hpp"
#include "identify/ledger/amplitude_noise.hpp"
#include "identify/ledger/amplitude_step.hpp"
#include "identify/ledger/amplitude_terms.hpp"
#include "identify/ledger/stated_noise.hpp"
#include "identify/methods/amplitudes/steady_states.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

namespace {

/// Y and phase of the drive that a motion needs.
using Asked = Eigen::Vector2d;

Asked asked(std::complex<double> drive) { return {std::abs(drive), std::arg(drive)}; }

/// Derivative of the needed drive, by a small step either way.
template <typename At>
Asked slope(const At& at, double step) {
  const Asked up = asked(at(step));
  const Asked down = asked(at(-step));
  return Asked(up[0] - down[0], wrapped(up[1] - down[1])) / (2.0 * step);
}

constexpr double small = 1e-5;

/// Rows of one linearisation, each over its deviation; rows of phases follow those of amplitudes.
struct Rows {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd base;
  Eigen::MatrixXd relaxed;
  std::vector<Reading> readings;  ///< lengths in units of the largest amplitude
  double log_variances = 0.0;     ///< half the log of the determinant of V
};

class SteadyStates {
 public:
  /// `known`: stated deviations of amplitudes, in the unit of the points.
  SteadyStates(std::vector<SteadyPoint> points, bool with_phases, const KnownDeviations& known)
      : points_(std::move(points)), known_(known) {
    for (const SteadyPoint& point : points_) {
      true_x_.push_back(point.x);
      frequencies_.insert(std::lround(1e4 * point.r));
      sweeps_ = std::max(sweeps_, point.sweep + 1);
      phases_ += with_phases && !std::isnan(point.phase) ? 1 : 0;
    }
    with_phases_ = phases_ >= 2;
    largest_ = largest_deviations(points_);
    for (const AmplitudeTerm& term : amplitude_terms()) {
      const bool by_frequency = term.several_frequencies && frequencies_.size() < 2;
      if (!by_frequency) terms_.push_back(&term);
    }
  }

  [[nodiscard]] const std::vector<SteadyPoint>& points() const { return points_; }
  [[nodiscard]] const std::vector<const AmplitudeTerm*>& terms() const { return terms_; }
  /// The true amplitude of a state at the last linearisation.
  [[nodiscard]] double true_x(std::size_t i) const { return true_x_[i]; }
  [[nodiscard]] bool with_phases() const { return with_phases_; }
  [[nodiscard]] const KnownDeviations& known() const { return known_; }
  [[nodiscard]] const Deviations& largest() const { return largest_; }
  [[nodiscard]] std::size_t frequencies() const { return frequencies_.size(); }
  [[nodiscard]] Eigen::Index smooth_columns() const {
    return identify::smooth_columns(frequencies() > 1, points_.size());
  }
  [[nodiscard]] int sweeps() const { return sweeps_; }
  [[nodiscard]] Eigen::Index amplitudes() const { return static_cast<Eigen::Index>(points_.size()); }
  [[nodiscard]] Eigen::Index phases() const { return with_phases_ ? phases_ : 0; }
  /// If only some states have phases, these may be too few for a smooth curve to leave noise. Then the noise is
  /// taken as large as that of the amplitudes, relative to the largest.
  [[nodiscard]] bool tells_phase_noise() const { return phases() == amplitudes() || phases() > smooth_columns(); }

  [[nodiscard]] std::vector<Relaxation> relaxations() const {
    std::vector<Relaxation> list;
    for (const AmplitudeTerm* term : terms_)
      list.push_back({term->assumption, std::string(term->test), term->sign, term->freed});
    for (int j = 0; j < contrasts(); ++j)
      list.push_back({Assumption::stationarity, "friction force of sweep " + std::to_string(j + 1) + " free"});
    if (has_trend()) list.push_back({Assumption::stationarity, "friction force that drifts from sweep to sweep"});
    return list;
  }

  /// Linearised at the parameters and at the true amplitudes of the last call; then updates these amplitudes.
  /// Columns of relaxations that are not wanted are zero.
  Rows linearise(SteadyParameters at, const Deviations& deviations, const Taken& wanted) {
    Rows rows;
    const Eigen::Index count = amplitudes() + phases();
    rows.residuals.resize(count);
    rows.base.resize(count, 2);
    rows.relaxed.setZero(count, at.g.size());
    rows.readings.resize(static_cast<std::size_t>(count));
    Eigen::Index phase_row = amplitudes();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const bool has_phase = with_phases_ && !std::isnan(points_[i].phase);
      add_state(i, at, deviations, has_phase ? phase_row++ : -1, wanted, rows);
    }
    return rows;
  }

  /// Coefficients of all relaxations, each zero.
  [[nodiscard]] Eigen::VectorXd none_relaxed() const {
    return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(terms_.size()) + contrasts() + (has_trend() ? 1 : 0));
  }

 private:
  /// Number of sweeps whose friction force is set free: the first ones, if there are very many.
  [[nodiscard]] int contrasts() const {
    constexpr int most = 8;
    return sweeps_ < 2 ? 0 : sweeps_ == 2 ? 1 : std::min(sweeps_, most);
  }

  [[nodiscard]] bool has_trend() const { return sweeps_ > 2; }

  /// Friction displacement of a sweep less the mean over all sweeps, which is x_f.
  [[nodiscard]] double excess(int sweep, const SteadyParameters& at) const {
    const auto first = static_cast<Eigen::Index>(terms_.size());
    double sum = 0.0;
    for (int j = 0; j < contrasts(); ++j) sum += at.g[first + j] * (j == sweep ? 1.0 : -1.0 / (sweeps_ - 1.0));
    if (has_trend()) sum += at.g[first + contrasts()] * (2.0 * sweep / (sweeps_ - 1.0) - 1.0);
    return sum;
  }

  /// The drive that a state needs, with every relaxation by its coefficient.
  [[nodiscard]] std::complex<double> drive(const SteadyPoint& point, const SteadyParameters& at, double x) const {
    PlainFriction friction = at.friction;
    friction.x_f += excess(point.sweep, at);
    const std::complex<double> plain = plain_drive(friction, x, point.r);
    std::complex<double> sum = plain;
    for (std::size_t j = 0; j < terms_.size(); ++j) {
      const double g = at.g[static_cast<Eigen::Index>(j)];
      if (g != 0.0) sum += terms_[j]->drive(friction, x, point.r, g) - plain;
    }
    return sum;
  }

  /// Column of `parameter`, a number of `at`, which is moved and put back: the derivative of the needed drive.
  [[nodiscard]] Asked column(const SteadyPoint& point, const SteadyParameters& at, double x, double step,
                             double& parameter) const {
    const double here = parameter;
    const Asked found = slope(
        [&](double h) {
          parameter = here + h;
          return drive(point, at, x);
        },
        step);
    parameter = here;
    return found;
  }

  /// `at` is as before, afterwards.
  void add_state(std::size_t i, SteadyParameters& at, const Deviations& deviations, Eigen::Index phase_row,
                 const Taken& wanted, Rows& rows) {
    const SteadyPoint& point = points_[i];
    double& xi = true_x_[i];
    const bool has_phase = phase_row >= 0;
    const Asked model = asked(drive(point, at, xi));
    const Asked by_x = slope([&](double h) { return drive(point, at, xi + h); }, small);
    Asked residual(point.Y - model[0], has_phase ? wrapped(point.phase - model[1]) : 0.0);
    residual -= by_x * (point.x - xi);
    if (!has_phase) residual[1] = 0.0;

    Eigen::Matrix2d variance =
        Eigen::Vector2d(deviations.Y * deviations.Y, deviations.phase * deviations.phase).asDiagonal();
    const double x_variance = deviations.x * deviations.x;
    variance += x_variance * by_x * by_x.transpose();
    if (!has_phase) {
      variance(0, 1) = variance(1, 0) = 0.0;
      variance(1, 1) = 1.0;
    }
    const Eigen::LLT<Eigen::Matrix2d> factor(variance);
    rows.log_variances += std::log(factor.matrixL()(0, 0)) + std::log(factor.matrixL()(1, 1));
    const auto row = static_cast<Eigen::Index>(i);
    const auto put = [&](const Asked& column, auto into) {
      const Asked whitened = factor.matrixL().solve(column);
      into(row) = whitened[0];
      if (has_phase) into(phase_row) = whitened[1];
    };
    put(residual, rows.residuals.col(0));
    const Eigen::Matrix2d L = factor.matrixL();
    rows.readings[i] = {ReadingKind::amplitude, point.number, by_x[0] == 0.0 ? 0.0 : -L(0, 0) / by_x[0]};
    if (has_phase) rows.readings[static_cast<std::size_t>(phase_row)] = {ReadingKind::phase, point.number, L(1, 1)};
    put(column(point, at, xi, small * std::max(at.friction.zeta, 1e-3), at.friction.zeta), rows.base.col(0));
    put(column(point, at, xi, small, at.friction.x_f), rows.base.col(1));
    for (const std::size_t number : wanted) {
      const auto j = static_cast<Eigen::Index>(number);
      put(column(point, at, xi, small, at.g[j]), rows.relaxed.col(j));
    }
    const Asked solved = factor.solve(residual);
    xi = std::max(point.x + x_variance * by_x.dot(solved), 1e-3 * point.x);
  }

  std::vector<SteadyPoint> points_;
  std::vector<double> true_x_;
  KnownDeviations known_;
  Deviations largest_;
  std::set<long> frequencies_;
  std::vector<const AmplitudeTerm*> terms_;
  int sweeps_ = 0;
  Eigen::Index phases_ = 0;
  bool with_phases_ = false;
};

struct AmplitudeFit {
  SteadyParameters at;
  Deviations deviations;
  Rows rows;
  std::optional<SteadyStates> states;  ///< what gives the rows with the columns of all relaxations
  double deviance = core::infinity;    ///< -2 log-likelihood
  double scatter = 1.0;                ///< of the amplitudes about a smooth curve, over their deviation
};

/// The noise of one channel: what a smooth curve leaves of its residuals. A departure is smooth, so it is not taken
/// for noise. Of few states the curve is over the fitted amplitudes: at one level of Y a measured one is a curve
/// over r and its own noise. Of many it is over the measured ones, which hold where the model misses the record.
double scale_of(const SteadyStates& states, const Eigen::VectorXd& residuals, Eigen::Index first,
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
AmplitudeFit fit_with(SteadyStates states, const SteadyParameters& begin, const Taken& taken, double ratio) {
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
AmplitudeFit best_fit(const SteadyStates& states, const SteadyParameters& begin, const Taken& taken) {
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
void leave_out_unseen(const SteadyStates& states, const PlainFriction& friction, const Taken& taken,
                      JointModel& model) {
  if (states.with_phases()) return;
  constexpr double seen = 0.2;
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
KnownConstants constants_at(const AmplitudeFit& fit, const SteadyStates& states, KnownConstants constants) {
  for (std::size_t j = 0; j < states.terms().size(); ++j) {
    const double g = fit.at.g[static_cast<Eigen::Index>(j)];
    if (states.terms()[j]->freed == Freed::stiffness) constants.stiffness *= std::exp(-2.0 * g);
    if (states.terms()[j]->freed == Freed::mass) constants.mass *= std::exp(2.0 * g);
  }
  return constants;
}

/// The fit with more relaxations free than `fit`. It is never worse: it may begin at `fit` as well, and may stay.
AmplitudeFit fit_beside(const AmplitudeFit& fit, const SteadyStates& states, const Taken& hidden,
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

JointModel amplitude_model_of(const AmplitudeFit& fit, const SteadyStates& states, const Taken& relaxed,
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
  if (std::string fault = fault_of(constants); !fault.empty()) return fault;
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
    const SteadyStates states(points, true, stated);
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
