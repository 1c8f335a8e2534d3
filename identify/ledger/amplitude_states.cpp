#include "identify/ledger/amplitude_states.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/angle.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

namespace {

Eigen::Vector2d asked(std::complex<double> drive) { return {std::abs(drive), std::arg(drive)}; }

/// Derivative of the needed drive, which is `here`, by a small step either way.
template <typename At>
Eigen::Vector2d slope(const At& at, std::complex<double> here, double step) {
  const std::complex<double> change = (at(step) - at(-step)) / (2.0 * step) * std::conj(here);
  const double square = std::norm(here);
  return Eigen::Vector2d(change.real() / std::sqrt(square), change.imag() / square);
}

constexpr double small = 1e-5;

}  // namespace

AmplitudeStates::AmplitudeStates(std::vector<SteadyPoint> points, bool with_phases, const KnownDeviations& known)
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

std::vector<Relaxation> AmplitudeStates::relaxations() const {
  std::vector<Relaxation> list;
  for (const AmplitudeTerm* term : terms_)
    list.push_back({term->assumption, std::string(term->test), term->sign, term->freed});
  for (int j = 0; j < contrasts(); ++j)
    list.push_back({Assumption::stationarity, "friction force of sweep " + std::to_string(j + 1) + " free"});
  if (has_trend()) list.push_back({Assumption::stationarity, "friction force that drifts from sweep to sweep"});
  return list;
}

Eigen::VectorXd AmplitudeStates::none_relaxed() const {
  return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(terms_.size()) + contrasts() + (has_trend() ? 1 : 0));
}

AmplitudeRows AmplitudeStates::linearise(SteadyParameters at, const Deviations& deviations, const Taken& wanted) {
  AmplitudeRows rows;
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

int AmplitudeStates::contrasts() const {
  constexpr int most = 8;
  return sweeps_ < 2 ? 0 : sweeps_ == 2 ? 1 : std::min(sweeps_, most);
}

double AmplitudeStates::excess(int sweep, const SteadyParameters& at) const {
  const auto first = static_cast<Eigen::Index>(terms_.size());
  double sum = 0.0;
  for (int j = 0; j < contrasts(); ++j) sum += at.g[first + j] * (j == sweep ? 1.0 : -1.0 / (sweeps_ - 1.0));
  if (has_trend()) sum += at.g[first + contrasts()] * (2.0 * sweep / (sweeps_ - 1.0) - 1.0);
  return sum;
}

PlainFriction AmplitudeStates::friction_of(int sweep, const SteadyParameters& at) const {
  return {at.friction.zeta, at.friction.x_f + excess(sweep, at)};
}

std::complex<double> AmplitudeStates::drive(const SteadyPoint& point, const SteadyParameters& at, double x) const {
  const PlainFriction friction = friction_of(point.sweep, at);
  const std::complex<double> plain = plain_drive(friction, x, point.r);
  std::complex<double> sum = plain;
  for (std::size_t j = 0; j < terms_.size(); ++j) {
    const double g = at.g[static_cast<Eigen::Index>(j)];
    if (g != 0.0) sum += terms_[j]->drive(friction, x, point.r, g) - plain;
  }
  return sum;
}

AmplitudeStates::Asked AmplitudeStates::column(const State& state, const SteadyParameters& at, double step,
                                               double& parameter) const {
  const double here = parameter;
  const Asked found = slope(
      [&](double h) {
        parameter = here + h;
        return drive(state.point, at, state.x);
      },
      state.drive, step);
  parameter = here;
  return found;
}

AmplitudeStates::Asked AmplitudeStates::relaxed_column(const State& state, SteadyParameters& at,
                                                       std::size_t number) const {
  double& g = at.g[static_cast<Eigen::Index>(number)];
  if (number >= terms_.size()) return column(state, at, small, g);
  const PlainFriction friction = friction_of(state.point.sweep, at);
  return slope([&](double h) { return terms_[number]->drive(friction, state.x, state.point.r, g + h); },
               state.drive, small);
}

void AmplitudeStates::add_state(std::size_t i, SteadyParameters& at, const Deviations& deviations,
                                Eigen::Index phase_row, const Taken& wanted, AmplitudeRows& rows) {
  const SteadyPoint& point = points_[i];
  double& xi = true_x_[i];
  const bool has_phase = phase_row >= 0;
  const State state{point, xi, drive(point, at, xi)};
  const Asked model = asked(state.drive);
  const Asked by_x = slope([&](double h) { return drive(point, at, xi + h); }, state.drive, small);
  Asked residual(point.Y - model[0], has_phase ? core::wrapped(point.phase - model[1]) : 0.0);
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
  put(column(state, at, small * std::max(at.friction.zeta, 1e-3), at.friction.zeta), rows.base.col(0));
  put(column(state, at, small, at.friction.x_f), rows.base.col(1));
  for (const std::size_t number : wanted)
    put(relaxed_column(state, at, number), rows.relaxed.col(static_cast<Eigen::Index>(number)));
  const Asked solved = factor.solve(residual);
  xi = std::max(point.x + x_variance * by_x.dot(solved), 1e-3 * point.x);
}

}  // namespace dualdamp::identify
