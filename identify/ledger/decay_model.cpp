#include "identify/ledger/decay_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "identify/methods/decays/free_decay.hpp"
#include "identify/statistics/linear_least_squares.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

namespace {

/// Parameters of the decay, lengths in units of the first amplitude, times in half periods of the fit. The
/// amplitudes alone say what zeta is: the period depends on it in the second order only, and just as well on all
/// that makes a motion other than the model's. The times say by what share the period is `longer` than stated.
struct Decay {
  double zeta = 0.0;
  double x_f = 0.0;
  double first = 1.0;
  double offset = 0.0;
  double start = 0.0;
  double longer = 0.0;
};

/// Share by which the period may differ from that of the constants stated and a zeta within its least change of
/// note.
double period_tolerance(double zeta) {
  // Constants are stated with six digits; 2 % of zeta.
  constexpr double rounded = 1e-6;
  return std::hypot(rounded, 0.02 * zeta * zeta);
}

/// One way in which a half swing may differ: what it takes from the amplitude, and by what share it lasts longer.
struct DecayTerm {
  Assumption assumption;
  std::string_view test;
  double (*loss)(double X, double side, double drop);
  double (*lasting)(double X);
};

double no_loss(double /*X*/, double /*side*/, double /*drop*/) { return 0.0; }
double no_lasting(double /*X*/) { return 0.0; }
double square(double X, double /*side*/, double /*drop*/) { return X * X; }
double cube(double X, double /*side*/, double /*drop*/) { return X * X * X; }
/// Amplitude at which a force at low speed has fallen to one half, of the first.
constexpr double slow = 0.15;
double at_low_speed(double X, double /*side*/, double /*drop*/) { return 1.0 / (1.0 + (X / slow) * (X / slow)); }
double deflection(double X, double /*side*/, double /*drop*/) { return 1.0 / X; }
double one_sided(double X, double side, double /*drop*/) { return side * X; }
double always(double /*X*/) { return 1.0; }
// A spring k x (1 + g x^2) stores more at large amplitudes: the same work takes less from them, in a shorter time.
double stiffer(double X, double /*side*/, double drop) { return -X * X * drop; }
double stiffening(double X) { return -0.375 * X * X; }
double stiff_contact(double X) { return -std::pow(X, -1.5); }

using enum Assumption;
constexpr std::array<DecayTerm, 8> terms = {{
    {constants, "period free", no_loss, always},
    {spring, "cubic stiffness", stiffer, stiffening},
    {friction_velocity, "quadratic term over speed", square, no_lasting},
    {friction_velocity, "cubic term over speed", cube, no_lasting},
    {friction_velocity, "force at low speed", at_low_speed, no_lasting},
    {friction_displacement, "deflection before sliding", deflection, no_lasting},
    {friction_displacement, "restoring force before sliding", no_loss, stiff_contact},
    {symmetry, "damping of its own in each direction", one_sided, no_lasting},
}};

/// Extremes and, after them, their times.
struct Course {
  std::vector<double> extremes;
  std::vector<double> times;
};

/// `term` with coefficient g beside plain friction; nullptr: none.
Course course(const Decay& decay, double side, std::size_t count, const DecayTerm* term, double g) {
  const double R = std::exp(-std::numbers::pi * decay.zeta / std::sqrt((1.0 - decay.zeta) * (1.0 + decay.zeta)));
  Course result;
  double X = decay.first;
  double t = decay.start;
  for (std::size_t i = 0; i < count; ++i, side = -side) {
    result.extremes.push_back(side * X + decay.offset);
    result.times.push_back(t);
    const double next = R * X - decay.x_f * (1.0 + R);
    const double mean = std::max(0.5 * (X + next), 1e-3);
    X = next - (term == nullptr ? 0.0 : g * term->loss(mean, side, X - next));
    t += 1.0 + decay.longer + (term == nullptr ? 0.0 : g * term->lasting(mean));
  }
  return result;
}

/// The rows of a course: amplitudes; where there are times, these, and the tolerance of the period as one more.
Eigen::VectorXd rows_of(const Course& course, bool timed, double longer) {
  const auto count = static_cast<Eigen::Index>(course.extremes.size());
  Eigen::VectorXd rows(timed ? 2 * count + 1 : count);
  rows.head(count) = Eigen::Map<const Eigen::VectorXd>(course.extremes.data(), count);
  if (timed) rows.tail(count + 1) << Eigen::Map<const Eigen::VectorXd>(course.times.data(), count), longer;
  return rows;
}

struct ChannelScale {
  double deviation = 0.0;
  double freedom = 0.0;
};

/// Brings the rows of one channel to unit deviation, which is taken from what its own columns leave.
ChannelScale scale_channel(JointModel& model, Eigen::Index first, Eigen::Index count) {
  Eigen::MatrixXd columns(count, model.base.cols() + model.relaxed.cols());
  columns << model.base.middleRows(first, count), model.relaxed.middleRows(first, count);
  const auto own = [](const Eigen::MatrixXd& list) { return (list.colwise().norm().array() > 0.0).count(); };
  const bool wide = count > 2 * own(columns);
  const Eigen::MatrixXd used = wide ? columns : Eigen::MatrixXd(model.base.middleRows(first, count));
  const Eigen::VectorXd target = model.residuals.segment(first, count);
  const Eigen::VectorXd left = target - used * pivoted_least_squares(used, target);
  const double freedom = std::max(1.0, static_cast<double>(count - own(used)));
  const double scale = std::sqrt(std::max(left.squaredNorm() / freedom, 1e-18));
  model.residuals.segment(first, count) /= scale;
  model.base.middleRows(first, count) /= scale;
  model.relaxed.middleRows(first, count) /= scale;
  return {scale, freedom};
}

void add_readings(JointModel& model, Channel channel, Eigen::Index count, double per_deviation) {
  for (int i = 1; i <= count; ++i) model.readings.push_back({channel, i, per_deviation});
}

/// Derivatives by central differences.
void add_columns(const Decay& decay, double side, std::size_t count, bool timed, JointModel& model) {
  constexpr double step = 1e-6;
  const auto rows = [&](const Decay& at, const DecayTerm* term, double g) {
    return rows_of(course(at, side, count, term, g), timed, at.longer);
  };
  const auto slope = [&](const Eigen::VectorXd& up, const Eigen::VectorXd& down) {
    return Eigen::VectorXd((up - down) / (2.0 * step));
  };
  constexpr std::array<double Decay::*, 6> members = {&Decay::zeta,   &Decay::x_f,   &Decay::first,
                                                      &Decay::offset, &Decay::start, &Decay::longer};
  const Eigen::Index size = model.residuals.size();
  model.base.resize(size, timed ? 6 : 4);
  for (Eigen::Index j = 0; j < model.base.cols(); ++j) {
    Decay up = decay;
    Decay down = decay;
    up.*members[static_cast<std::size_t>(j)] += step;
    down.*members[static_cast<std::size_t>(j)] -= step;
    model.base.col(j) = slope(rows(up, nullptr, 0.0), rows(down, nullptr, 0.0));
  }
  std::vector<Eigen::VectorXd> columns;
  for (const DecayTerm& term : terms) {
    if (term.loss == no_loss && !timed) continue;
    model.relaxations.push_back({term.assumption, std::string(term.test)});
    columns.emplace_back(slope(rows(decay, &term, step), rows(decay, &term, -step)));
  }
  model.relaxed.resize(size, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j) model.relaxed.col(static_cast<Eigen::Index>(j)) = columns[j];
}

}  // namespace

std::variant<JointModel, std::string> decay_model(const Record& record, const KnownConstants& constants) {
  const Estimate fit = free_decay(record, constants, {});
  if (!fit.outcome.ok()) return fit.outcome.reason;
  constexpr std::size_t fewest = 6;
  const std::size_t count = fit.used.size();
  if (count < fewest) return "fewer than six extremes";
  const double unit = std::abs(fit.decay->first_amplitude);
  const double half_period = std::numbers::pi * std::sqrt(constants.mass / constants.stiffness) /
                             std::sqrt((1.0 - fit.value.zeta) * (1.0 + fit.value.zeta));
  const bool timed = record.decay->times.size() == record.decay->extremes.size();
  const Decay decay{fit.value.zeta, fit.value.x_f / unit, 1.0, fit.decay->offset / unit,
                    timed ? record.decay->times.front() / half_period : 0.0};
  const double side = fit.decay->first_amplitude < 0.0 ? -1.0 : 1.0;

  JointModel model;
  model.data = std::to_string(count) + " extremes" + (timed ? " with times" : "");
  Course measured;
  for (std::size_t i = 0; i < count; ++i) {
    measured.extremes.push_back(record.decay->extremes[i] / unit);
    measured.times.push_back(timed ? record.decay->times[i] / half_period : 0.0);
  }
  model.residuals = rows_of(measured, timed, 0.0) - rows_of(course(decay, side, count, nullptr, 0.0), timed, 0.0);
  add_columns(decay, side, count, timed, model);
  const auto rows = static_cast<Eigen::Index>(count);
  const ChannelScale amplitudes = scale_channel(model, 0, rows);
  model.scale_freedom = amplitudes.freedom;
  add_readings(model, Channel::extreme, rows, amplitudes.deviation * unit);
  if (timed) {
    add_readings(model, Channel::time, rows, scale_channel(model, rows, rows).deviation * half_period);
    model.base.bottomRows(1) /= period_tolerance(fit.value.zeta);
    model.readings.emplace_back();
  }
  model.spent = timed ? 1.0 : 0.0;
  model.base.col(1) /= constants.stiffness * unit;
  model.value = fit.value;
  model.constants = constants;
  for (const Exclusion& exclusion : fit.excluded)
    model.left_out.push_back("extreme " + std::to_string(exclusion.number) + ": " + exclusion.reason);
  return model;
}

}  // namespace dualdamp::identify
