#include "bench/mechanisms/fit.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "identify/methods/amplitudes/line_estimate.hpp"
#include "identify/statistics/least_squares.hpp"
#include "sim/orbits/steady_state_near.hpp"

namespace dualdamp::bench {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Tolerance of steps and of the closure of orbits, small enough for differences over `step`.
constexpr double accuracy = 1e-8;
constexpr double step = 3e-4;

/// Largest number of transient periods: at the edge of thermal runaway or of a fold a test converges too slowly for
/// a fit.
constexpr int patience = 300;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

VectorXd misfit(const std::vector<PartReading>& readings, const MechanismStudy& study) {
  VectorXd result(static_cast<Index>(2 * readings.size()));
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const PartEstimate& estimate = study.estimates[i];
    result[static_cast<Index>(2 * i)] = (readings[i].zeta - estimate.zeta) / estimate.zeta_std;
    result[static_cast<Index>(2 * i + 1)] = (readings[i].F0 - estimate.F0) / estimate.F0_std;
  }
  return result;
}

/// Derivatives by differences: backward where there is no forward one, 0 where there is neither.
template <typename Residuals>
Eigen::MatrixXd derivatives(const Residuals& residuals, const VectorXd& p, const VectorXd& here,
                            const VectorXd& high) {
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(here.size(), p.size());
  for (Index j = 0; j < p.size(); ++j) {
    const double ahead = p[j] + step > high[j] ? -step : step;
    for (const double h : {ahead, -ahead}) {
      VectorXd moved = p;
      moved[j] += h;
      const std::optional<VectorXd> there = residuals(moved);
      if (!there) continue;
      jacobian.col(j) = (*there - here) / h;
      break;
    }
  }
  return jacobian;
}

/// Least squares with residuals that may not exist: steps are shortened until they exist.
template <typename Residuals>
identify::LeastSquaresFit least_squares(const Residuals& residuals, Index count, VectorXd start, VectorXd low,
                                        VectorXd high, double tolerance) {
  identify::LeastSquaresProblem problem;
  problem.residuals = count;
  problem.start = std::move(start);
  problem.low = std::move(low);
  problem.high = std::move(high);
  problem.tolerance = tolerance;
  problem.evaluate = [&residuals, &most = problem.high](const VectorXd& p, VectorXd& values,
                                                        Eigen::MatrixXd* jacobian) {
    const std::optional<VectorXd> here = residuals(p);
    if (!here) return false;
    values = *here;
    if (jacobian != nullptr) *jacobian = derivatives(residuals, p, values, most);
    return true;
  };
  return identify::fit(problem);
}

/// Equally spaced levels.
std::vector<double> spaced(double first, double spacing, std::size_t count) {
  std::vector<double> levels(count);
  for (std::size_t i = 0; i < count; ++i) levels[i] = first + spacing * static_cast<double>(i);
  return levels;
}

/// Mean intercept of the lines of the estimates with the axis x = 0, approximately kY = (4/pi) F0; in Y [m].
double usual_intercept(const MechanismStudy& study, double stiffness) {
  double sum = 0.0;
  for (const PartEstimate& estimate : study.estimates) sum += estimate.F0;
  return 4.0 * std::numbers::inv_pi * sum / static_cast<double>(study.estimates.size()) / stiffness;
}

bool goes_by_ratios(const DepartureParameter& parameter) { return parameter.low > 0.0; }

/// The unknown of a parameter, given in units of its scale.
double to_unknown(const DepartureParameter& parameter, double value) {
  return goes_by_ratios(parameter) ? std::log(value) : value;
}

sim::Model test_model(const Departure& mechanism, const Apparatus& apparatus, const RigFriction& friction,
                      std::span<const double> values, double Y) {
  sim::Model model = driven(mechanism, apparatus, friction, values, Y);
  model.solver.tolerance = accuracy;
  return model;
}

/// Starts of a search, as ratios to `DepartureParameter::start`.
constexpr std::array<double, 3> ratios = {1.0, 0.3, 3.0};

}  // namespace

std::optional<std::vector<PartReading>> read_parts(const Levels& levels, const MechanismStudy& study,
                                                   const identify::KnownConstants& constants) {
  std::vector<PartReading> readings;
  for (const PartEstimate& estimate : study.estimates) {
    const std::size_t count = part_of(levels.Y.size(), estimate.share);
    std::vector<identify::Datum> pairs;
    for (std::size_t i = 0; i < count; ++i) pairs.push_back({.Y = levels.Y[i], .x = levels.x[i]});
    const auto line = identify::line_of(identify::moments_of(pairs), std::numeric_limits<double>::infinity());
    const auto friction = line ? identify::friction_of(*line, {}) : std::nullopt;
    if (!friction) return std::nullopt;
    readings.push_back({friction->zeta, friction->x_f * constants.stiffness});
  }
  return readings;
}

double bend_of(const std::vector<PartReading>& readings) {
  return readings.back().zeta / readings.front().zeta - 1.0;
}

std::optional<Levels> reconstruct(const MechanismStudy& study, const identify::KnownConstants& constants) {
  const std::size_t count = study.levels;
  const auto outputs = static_cast<Index>(count);
  const bool free_levels = study.amplitudes.empty();
  const double unit = usual_intercept(study, constants.stiffness);
  const auto levels_at = [&](const VectorXd& p) {
    Levels levels{free_levels ? spaced(p[outputs] * unit, p[outputs + 1] * unit, count) : study.amplitudes, {}};
    // The unknowns are the increments of the outputs, so that every line rises.
    double x = 0.0;
    for (Index i = 0; i < outputs; ++i) levels.x.push_back(x += p[i] * unit);
    return levels;
  };
  const auto residuals = [&](const VectorXd& p) -> std::optional<VectorXd> {
    const auto readings = read_parts(levels_at(p), study, constants);
    if (!readings) return std::nullopt;
    return misfit(*readings, study);
  };
  const Index size = outputs + (free_levels ? 2 : 0);
  VectorXd low = VectorXd::Constant(size, 1e-3);
  VectorXd high = VectorXd::Constant(size, 1e3);
  std::optional<Levels> best;
  double least = static_cast<double>(2 * study.estimates.size());
  for (const double first : {1.1, 1.25, 1.5, 2.0}) {
    for (const double spacing : {0.08, 0.15, 0.3}) {
      // Start with the outputs on the line of all data.
      const std::vector<double> Y = free_levels ? spaced(first, spacing, count) : study.amplitudes;
      VectorXd start(size);
      double before = 0.0;
      for (Index i = 0; i < outputs; ++i) {
        const double input = free_levels ? Y[at(i)] : Y[at(i)] / unit;
        const double output = (input - 1.0) / (2.0 * study.estimates.front().zeta);
        start[i] = std::max(output - before, 0.01);
        before = output;
      }
      if (free_levels) {
        start[outputs] = first;
        start[outputs + 1] = spacing;
      }
      const identify::LeastSquaresFit fit =
          least_squares(residuals, static_cast<Index>(2 * study.estimates.size()), start, low, high, 1e-10);
      if (!fit.outcome.ok() || !(fit.sum_of_squares < least)) continue;
      least = fit.sum_of_squares;
      best = levels_at(fit.parameters);
    }
  }
  return best;
}

std::optional<Response> response(const Departure& mechanism, const Apparatus& apparatus,
                                 const RigFriction& friction, std::span<const double> values,
                                 const std::vector<double>& Y, const std::vector<sim::KnownOrbit>& near) {
  const sim::SteadyStateOptions options{
      .tolerance = accuracy, .max_periods = patience, .detail = sim::OrbitDetail::extremes, .others = false};
  Response result;
  for (std::size_t i = 0; i < Y.size(); ++i) {
    const sim::Model model = test_model(mechanism, apparatus, friction, values, Y[i]);
    sim::SteadyState state =
        near.empty() ? sim::steady_state(model, options) : sim::steady_state_near(near[i], model, options);
    if (!state.outcome.ok()) return std::nullopt;
    result.x.push_back(state.amplitude);
    result.sticks = result.sticks || !state.sticks.empty();
    result.orbits.push_back(std::move(state));
  }
  return result;
}

MechanismSearch::MechanismSearch(const Departure& mechanism, const MechanismStudy& study,
                                 const Apparatus& apparatus, Levels near)
    : mechanism_(mechanism), study_(study), apparatus_(apparatus), near_(std::move(near)) {}

std::size_t MechanismSearch::starts() const {
  if (mechanism_.parameters.empty()) return 1;
  return goes_by_ratios(mechanism_.parameters.front()) ? ratios.size() : 2;
}

MechanismSearch::Point MechanismSearch::point(const VectorXd& p) const {
  Point point;
  point.friction = {p[0] * study_.friction.F0, p[1] * study_.friction.c};
  point.Y =
      levels_are_free() ? spaced(p[2] * near_.Y[0], p[3] * (near_.Y[1] - near_.Y[0]), near_.Y.size()) : near_.Y;
  for (std::size_t i = 0; i < parameters(); ++i) {
    const DepartureParameter& parameter = mechanism_.parameters[i];
    const double u = p[first_parameter() + static_cast<Index>(i)];
    point.values.push_back(natural_scale(apparatus_, parameter.unit) *
                           (goes_by_ratios(parameter) ? std::exp(u) : u));
  }
  return point;
}

/// Outputs of the test at p; sought near the orbits of the last test if p differs by the step of a derivative. A
/// test without known orbits is computed once more near its own orbits, so that it closes as well as its
/// neighbours, as differences require.
std::optional<Response> MechanismSearch::outputs(const VectorXd& p, LastTest& last) const {
  const Point here = point(p);
  const bool is_near = last.p.size() > 0 && (p - last.p).cwiseAbs().maxCoeff() < 2.0 * step;
  if (!is_near) {
    last = {};
    const std::optional<Response> found = response(mechanism_, apparatus_, here.friction, here.values, here.Y);
    if (!found) return std::nullopt;
    for (std::size_t i = 0; i < here.Y.size(); ++i)
      last.near.push_back(sim::known_orbit(
          test_model(mechanism_, apparatus_, here.friction, here.values, here.Y[i]), found->orbits[i]));
    last.p = p;
  }
  return response(mechanism_, apparatus_, here.friction, here.values, here.Y, last.near);
}

VectorXd MechanismSearch::bounds(bool high) const {
  // Friction may become very small. Levels are bounded around those reconstructed from the estimates: others would
  // be another experiment, and a little below them the mass sticks.
  VectorXd p = VectorXd::Constant(static_cast<Index>(unknowns()), high ? 6.0 : 1e-3);
  if (levels_are_free()) {
    p[2] = high ? 1.6 : 0.9;
    p[3] = high ? 3.0 : 0.1;
  }
  for (std::size_t i = 0; i < parameters(); ++i) {
    const DepartureParameter& parameter = mechanism_.parameters[i];
    p[first_parameter() + static_cast<Index>(i)] = to_unknown(parameter, high ? parameter.high : parameter.low);
  }
  return p;
}

VectorXd MechanismSearch::start(std::size_t number) const {
  // For bent data F0 and c lie below the estimates of the lowest part. If the mechanism has no effect, they are the
  // estimates of all data.
  const PartEstimate& estimate = number == 0 ? study_.estimates.back() : study_.estimates.front();
  const double below = number == 0 ? 0.85 : 0.95;
  const double c =
      estimate.zeta * identify::critical_damping(apparatus_.oscillator.mass, apparatus_.oscillator.stiffness);
  VectorXd p = VectorXd::Ones(static_cast<Index>(unknowns()));
  p[0] = below * estimate.F0 / study_.friction.F0;
  p[1] = below * c / study_.friction.c;
  for (std::size_t i = 0; i < parameters(); ++i) {
    const DepartureParameter& parameter = mechanism_.parameters[i];
    double value = parameter.start;
    // The first parameter is the main one of a mechanism: its search has several starts.
    if (i == 0) value *= goes_by_ratios(parameter) ? ratios.at(number) : number == 0 ? 1.0 : -1.0;
    p[first_parameter() + static_cast<Index>(i)] =
        to_unknown(parameter, std::clamp(value, parameter.low, parameter.high));
  }
  return p;
}

VectorXd MechanismSearch::pull(const VectorXd& p) const {
  // Doubled levels count as a misfit of one standard error, and so does a parameter that is e^10 times larger.
  VectorXd weights = VectorXd::Constant(p.size(), 0.1);
  weights.head(first_parameter()).setConstant(1.0);
  weights.head(2).setZero();
  return weights.cwiseProduct(p - start(0));
}

MechanismFit MechanismSearch::begin(std::size_t number) const {
  constexpr double rough = 0.1;
  return fit(start(number), rough);
}

MechanismFit MechanismSearch::refine(const MechanismFit& rough) const {
  constexpr double fine = 1e-5;
  return rough.outcome.ok() ? fit(rough.unknowns, fine) : rough;
}

MechanismFit MechanismSearch::fit(const VectorXd& from, double tolerance) const {
  const identify::KnownConstants constants{apparatus_.oscillator.mass, apparatus_.oscillator.stiffness,
                                           apparatus_.reference.frequency};
  MechanismFit result;
  LastTest last;
  const auto test = [&](const VectorXd& p) -> std::optional<VectorXd> {
    const auto response = outputs(p, last);
    if (!response || response->sticks) return std::nullopt;
    result.levels = {point(p).Y, response->x};
    const auto readings = read_parts(result.levels, study_, constants);
    if (!readings) return std::nullopt;
    result.readings = *readings;
    VectorXd all(static_cast<Index>(numbers()) + p.size());
    all << misfit(*readings, study_), pull(p);
    return all;
  };
  const VectorXd low = bounds(false);
  const VectorXd high = bounds(true);
  const identify::LeastSquaresFit fit =
      least_squares(test, static_cast<Index>(numbers()) + from.size(), from, low, high, tolerance);
  result.outcome = fit.outcome;
  // Compute the result again: the last test of a fit may belong to a difference.
  const std::optional<VectorXd> residuals = fit.outcome.ok() ? test(fit.parameters) : std::nullopt;
  if (!residuals) {
    if (result.outcome.ok()) result.outcome = {core::OutcomeKind::not_identifiable, "the fit did not converge"};
    return result;
  }
  const Point there = point(fit.parameters);
  result.friction = there.friction;
  result.values = there.values;
  constexpr double close = 1e-3;
  for (Index j = first_parameter(); j < fit.parameters.size(); ++j) {
    const double room = std::min(fit.parameters[j] - low[j], high[j] - fit.parameters[j]);
    result.at_bound.push_back(room < close * (high[j] - low[j]));
  }
  result.chi2 = residuals->head(static_cast<Index>(numbers())).squaredNorm();
  result.unknowns = fit.parameters;
  return result;
}

}  // namespace dualdamp::bench
