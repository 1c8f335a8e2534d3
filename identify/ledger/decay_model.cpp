#include "identify/ledger/decay_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "identify/ledger/stated_noise.hpp"
#include "identify/methods/decays/free_decay.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/scatter.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

namespace {

/// Parameters of the decay, lengths in units of the first amplitude, times in half periods of the fit. Only the
/// amplitudes determine zeta: the period depends on it in the second order, and as much on every other departure.
/// The times determine by what share the period is `longer` than stated.
struct Decay {
  double zeta = 0.0;
  double x_f = 0.0;
  double first = 1.0;
  double offset = 0.0;
  double start = 0.0;
  double longer = 0.0;
  Eigen::VectorXd g = {};  ///< coefficients of the terms; empty: all zero
};

/// Share by which the period may differ from that of the stated constants: by their rounding, and by a zeta that is
/// off by less than matters.
double period_tolerance(double zeta) {
  // Constants are stated with six digits; 2 % of zeta.
  constexpr double rounded = 1e-6;
  return std::hypot(rounded, 0.02 * zeta * zeta);
}

/// One half swing of plain friction.
struct Swing {
  double X = 1.0;        ///< mean amplitude
  double side = 1.0;     ///< of its beginning
  double dry = 0.0;      ///< what Coulomb friction takes from the amplitude
  double viscous = 0.0;  ///< what viscous friction takes
};

/// One way in which a half swing may differ: its loss of amplitude, and the share by which it lasts longer.
struct DecayTerm {
  Assumption assumption;
  std::string_view test;
  double (*loss)(const Swing& swing);
  double (*lasting)(double X);
  int sign = 0;          ///< of the coefficient in such a departure; 0: either
  bool is_zero = false;  ///< the zero of x that drifts, which changes no swing
  Freed freed = Freed::effect;
};

double no_loss(const Swing& /*swing*/) { return 0.0; }
double no_lasting(double /*X*/) { return 0.0; }
double square(const Swing& swing) { return swing.X * swing.X; }
double cube(const Swing& swing) { return swing.X * swing.X * swing.X; }
/// Amplitude at which a force at low speed has fallen to one half, over the first amplitude.
constexpr double slow = 0.15;
double at_low_speed(const Swing& swing) { return 1.0 / (1.0 + (swing.X / slow) * (swing.X / slow)); }
double deflection(const Swing& swing) { return 1.0 / swing.X; }
double one_sided(const Swing& swing) { return swing.side * swing.X; }
double always(double /*X*/) { return 1.0; }
// A spring k x (1 + g x^2) stores k X^2/2 (1 + g X^2/2): the same work takes less from a large amplitude, by 1/(1 +
// g X^2). The work of viscous friction grows by 1 + 5/16 g X^2, because the motion is faster.
double stiffer(const Swing& swing) { return -swing.X * swing.X * (swing.dry + 11.0 / 16.0 * swing.viscous); }
double stiffening(double X) { return -0.375 * X * X; }
double stiff_contact(double X) { return -std::pow(X, -1.5); }

using enum Assumption;
constexpr std::array<DecayTerm, 10> all_decay_terms = {{
    // By the mass or by the stiffness: they differ only in F0 = k x_f.
    {constants, "period free, stiffness as stated", no_loss, always, 0, false, Freed::mass},
    {constants, "period free, mass as stated", no_loss, always, 0, false, Freed::stiffness},
    {spring, "cubic stiffness", stiffer, stiffening},
    {friction_velocity, "quadratic term over speed", square, no_lasting},
    {friction_velocity, "cubic term over speed", cube, no_lasting},
    {friction_velocity, "force at low speed", at_low_speed, no_lasting},
    {friction_displacement, "deflection before sliding", deflection, no_lasting, -1},
    {friction_displacement, "restoring force before sliding", no_loss, stiff_contact, 1},
    {symmetry, "damping of its own in each direction", one_sided, no_lasting},
    {stationarity, "zero of x that drifts", no_loss, no_lasting, 0, true},
}};

/// Terms that a record can show. Terms that change only times need times.
std::vector<const DecayTerm*> terms_of(bool timed) {
  std::vector<const DecayTerm*> list;
  for (const DecayTerm& term : all_decay_terms)
    if (timed || term.loss != no_loss || term.is_zero) list.push_back(&term);
  return list;
}

/// What the model of the extremes needs beside the parameters, in the units of Decay.
struct Setting {
  double side = 1.0;  ///< sign of the first amplitude
  Eigen::Index count = 0;
  bool timed = false;
  double unit = 1.0;         ///< m
  double half_period = 1.0;  ///< s
  double tolerance = 1.0;    ///< of the period
  double known = 0.0;        ///< stated deviation of an extreme; 0: none
  KnownConstants constants;
  std::vector<const DecayTerm*> terms;
};

/// Extremes; with times, also these and the share by which the period is longer.
Eigen::VectorXd rows_of(const Setting& setting, const Decay& decay) {
  const double R = std::exp(-std::numbers::pi * decay.zeta / std::sqrt((1.0 - decay.zeta) * (1.0 + decay.zeta)));
  const Eigen::Index count = setting.count;
  Eigen::VectorXd rows(setting.timed ? 2 * count + 1 : count);
  double side = setting.side;
  double X = decay.first;
  double t = decay.start;
  for (Eigen::Index i = 0; i < count; ++i, side = -side) {
    rows[i] = side * X + decay.offset;
    if (setting.timed) rows[count + i] = t;
    const double plain = R * X - decay.x_f * (1.0 + R);
    const double mean = std::max(0.5 * (X + plain), 1e-3);
    double next = plain;
    t += 1.0 + decay.longer;
    for (Eigen::Index j = 0; j < decay.g.size(); ++j) {
      const double g = decay.g[j];
      if (g == 0.0) continue;
      const DecayTerm& term = *setting.terms[static_cast<std::size_t>(j)];
      if (term.is_zero) rows[i] += g * static_cast<double>(i) / static_cast<double>(count - 1);
      next -= g * term.loss({mean, side, decay.x_f * (1.0 + R), (1.0 - R) * X});
      t += g * term.lasting(mean);
    }
    X = next;
  }
  if (setting.timed) rows[2 * count] = decay.longer;
  return rows;
}

struct ChannelScale {
  double deviation = 0.0;
  double freedom = 0.0;  ///< 0: the channel is exact to rounding, without noise
};

/// Scales the rows of one channel to unit deviation: `known`, or estimated from what its own columns leave.
ChannelScale scale_channel(JointModel& model, Eigen::Index first, Eigen::Index count, double known = 0.0) {
  Eigen::MatrixXd columns(count, model.base.cols() + model.relaxed.cols());
  columns << model.base.middleRows(first, count), model.relaxed.middleRows(first, count);
  const auto own = [](const Eigen::MatrixXd& list) { return (list.colwise().norm().array() > 0.0).count(); };
  const bool wide = count > 2 * own(columns);
  const Eigen::MatrixXd used = wide ? columns : Eigen::MatrixXd(model.base.middleRows(first, count));
  const Eigen::VectorXd target = model.residuals.segment(first, count);
  const Eigen::VectorXd left = left_beside(used, target);
  const double freedom = std::max(1.0, static_cast<double>(count - own(used)));
  constexpr double rounding = 1e-9;
  const double scale = known > 0.0 ? known : std::max(std::sqrt(left.squaredNorm() / freedom), rounding);
  model.residuals.segment(first, count) /= scale;
  model.base.middleRows(first, count) /= scale;
  model.relaxed.middleRows(first, count) /= scale;
  return {scale, scale > rounding ? freedom : 0.0};
}

void add_readings(JointModel& model, ReadingKind kind, Eigen::Index count, double per_deviation) {
  for (int i = 1; i <= count; ++i) model.readings.push_back({kind, i, per_deviation});
}

/// The model linearised at `at`, by central differences, with rows of unit deviation.
JointModel linearised(const Setting& setting, const Eigen::VectorXd& measured, const Decay& at) {
  constexpr double step = 1e-6;
  const auto slope = [&](auto move) {
    Decay up = at;
    Decay down = at;
    move(up, step);
    move(down, -step);
    return Eigen::VectorXd((rows_of(setting, up) - rows_of(setting, down)) / (2.0 * step));
  };
  constexpr std::array<double Decay::*, 6> members = {&Decay::zeta,   &Decay::x_f,   &Decay::first,
                                                      &Decay::offset, &Decay::start, &Decay::longer};
  JointModel model;
  model.residuals = measured - rows_of(setting, at);
  model.base.resize(model.residuals.size(), setting.timed ? 6 : 4);
  for (Eigen::Index j = 0; j < model.base.cols(); ++j)
    model.base.col(j) = slope([&](Decay& decay, double h) { decay.*members[static_cast<std::size_t>(j)] += h; });
  model.relaxed.resize(model.residuals.size(), at.g.size());
  for (Eigen::Index j = 0; j < at.g.size(); ++j) {
    const DecayTerm& term = *setting.terms[static_cast<std::size_t>(j)];
    model.relaxations.push_back({term.assumption, std::string(term.test), term.sign, term.freed});
    model.relaxed.col(j) = slope([&](Decay& decay, double h) { decay.g[j] += h; });
    // The column of the stiffness is at constant F0 = k x_f.
    if (term.freed == Freed::stiffness) model.relaxed.col(j) += 2.0 * at.x_f * model.base.col(1);
  }
  // A term that takes g X from the swings to one side and gives it to the others is a damping that differs between
  // the directions.
  const double root = (1.0 - at.zeta) * (1.0 + at.zeta);
  const double decrement = std::exp(-std::numbers::pi * at.zeta / std::sqrt(root));
  model.zeta_parts = Eigen::VectorXd::Zero(at.g.size());
  for (Eigen::Index j = 0; j < at.g.size(); ++j)
    if (setting.terms[static_cast<std::size_t>(j)]->assumption == symmetry)
      model.zeta_parts[j] = std::pow(root, 1.5) / (std::numbers::pi * decrement);
  const ChannelScale amplitudes = scale_channel(model, 0, setting.count, setting.known);
  model.is_stated = setting.known > 0.0;
  model.scale_freedom = model.is_stated ? known_freedom : amplitudes.freedom;
  // The part of the deviations; `fitted` adds the sum of squares.
  const auto readings = static_cast<double>(setting.count);
  model.deviance = 2.0 * readings * std::log(amplitudes.deviation);
  add_readings(model, ReadingKind::extreme, setting.count, amplitudes.deviation * setting.unit);
  model.spent = setting.timed ? 1.0 : 0.0;
  if (setting.timed) {
    const ChannelScale times = scale_channel(model, setting.count, setting.count);
    model.deviance += 2.0 * readings * std::log(times.deviation);
    add_readings(model, ReadingKind::time, setting.count, times.deviation * setting.half_period);
    model.readings.emplace_back();
    model.other_freedom = times.freedom;
    // Two columns, `start` and `longer`, act on the times alone.
    if (times.freedom == 0.0) model.spent += static_cast<double>(setting.count - 2);
    model.residuals[2 * setting.count] /= setting.tolerance;
    model.base.bottomRows(1) /= setting.tolerance;
    model.relaxed.bottomRows(1) /= setting.tolerance;
  }
  return model;
}

/// Moves by a step of the base parameters and of the terms taken. A step of the stiffness keeps F0.
void move(const Setting& setting, const Eigen::VectorXd& step, const Taken& taken, Decay& at) {
  const Eigen::Index base = setting.timed ? 6 : 4;
  at.zeta = std::clamp(at.zeta + step[0], 0.1 * at.zeta, 0.9);
  at.x_f += step[1];
  at.first += step[2];
  at.offset += step[3];
  if (setting.timed) {
    at.start += step[4];
    at.longer += step[5];
  }
  for (std::size_t j = 0; j < taken.size(); ++j) {
    const double g = step[base + static_cast<Eigen::Index>(j)];
    at.g[static_cast<Eigen::Index>(taken[j])] += g;
    if (setting.terms[taken[j]]->freed == Freed::stiffness) at.x_f += 2.0 * g * at.x_f;
  }
}

/// The model linearised where the terms taken are fitted beside plain friction.
JointModel fitted(const Setting& setting, const Eigen::VectorXd& measured, const Decay& start, const Taken& taken) {
  Decay at = start;
  JointModel model = linearised(setting, measured, at);
  constexpr int steps = 6;
  for (int i = 0; i < steps; ++i) {
    const Eigen::VectorXd step =
        pivoted_least_squares(free_columns(model.base, model.relaxed, taken), model.residuals);
    Decay moved = at;
    move(setting, step, taken, moved);
    if (!step.allFinite() || !rows_of(setting, moved).allFinite()) break;
    at = moved;
    model = linearised(setting, measured, at);
  }
  const Eigen::MatrixXd columns = free_columns(model.base, model.relaxed, taken);
  model.deviance += left_beside(columns, model.residuals).squaredNorm();
  model.constants = setting.constants;
  for (std::size_t j = 0; j < setting.terms.size(); ++j) {
    const double longer = 1.0 + at.g[static_cast<Eigen::Index>(j)];
    if (setting.terms[j]->freed == Freed::stiffness) model.constants.stiffness /= longer * longer;
    if (setting.terms[j]->freed == Freed::mass) model.constants.mass *= longer * longer;
  }
  model.base.col(1) /= model.constants.stiffness * setting.unit;
  model.value = parameters(at.zeta, at.x_f * setting.unit, model.constants);
  return model;
}

/// Where the extremes scatter clearly more than stated, the model is fitted with their own noise instead.
void compare_with_stated(Setting& setting, const Eigen::VectorXd& measured, const Decay& start, JointModel& model) {
  JointModel rescaled = model;
  const ChannelScale own = scale_channel(rescaled, 0, setting.count);
  const ScatterBesideStated scatter = readings_scatter(own.deviation, own.freedom);
  if (scatter == ScatterBesideStated::more) {
    setting.known = 0.0;
    model = fitted(setting, measured, start, {});
  }
  note_contradiction(scatter, own.deviation, "extremes", model);
}

}  // namespace

std::variant<JointModel, std::string> decay_model(const Record& record, const KnownConstants& constants,
                                                  double sigma_x) {
  const Estimate fit = free_decay(record, constants, {});
  if (!fit.outcome.ok()) return fit.outcome.reason;
  constexpr std::size_t fewest = 6;
  const std::size_t count = fit.used.size();
  if (count < fewest) return "fewer than six extremes";
  const bool timed = record.decay->times.size() == record.decay->extremes.size();
  Setting setting;
  setting.side = fit.decay->first_amplitude < 0.0 ? -1.0 : 1.0;
  setting.count = static_cast<Eigen::Index>(count);
  setting.timed = timed;
  setting.unit = std::abs(fit.decay->first_amplitude);
  setting.tolerance = period_tolerance(fit.value.zeta);
  setting.constants = constants;
  setting.terms = terms_of(timed);
  const double half_period = std::numbers::pi * std::sqrt(constants.mass / constants.stiffness) /
                             std::sqrt((1.0 - fit.value.zeta) * (1.0 + fit.value.zeta));
  setting.half_period = half_period;
  Decay start{fit.value.zeta, fit.value.x_f / setting.unit, 1.0, fit.decay->offset / setting.unit,
              timed ? record.decay->times.front() / half_period : 0.0};
  start.g = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(setting.terms.size()));
  Eigen::VectorXd measured = Eigen::VectorXd::Zero(timed ? 2 * setting.count + 1 : setting.count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    measured[row] = record.decay->extremes[i] / setting.unit;
    if (timed) measured[setting.count + row] = record.decay->times[i] / half_period;
  }
  setting.known = sigma_x / setting.unit;
  JointModel model = fitted(setting, measured, start, {});
  if (sigma_x > 0.0) compare_with_stated(setting, measured, start, model);
  model.refit = [setting, measured, start](const Taken& taken) { return fitted(setting, measured, start, taken); };
  model.data = std::to_string(count) + " extremes" + (timed ? " with times" : "");
  for (const Exclusion& exclusion : fit.excluded)
    model.left_out.push_back("extreme " + std::to_string(exclusion.number) + ": " + exclusion.reason);
  return model;
}

}  // namespace dualdamp::identify
