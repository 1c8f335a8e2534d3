#include "identify/ledger/histories/history_linearisation.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"

namespace dualdamp::identify {

HistoryLinearisation::HistoryLinearisation(const Record& record, const KnownConstants& constants, double sigma_x,
                                           Estimate& exclusions)
    : record_(record), constants_(constants), sigma_x_(sigma_x), fit_(record, constants, {}, exclusions) {
  if (!fit_.problem().empty()) return;
  start_.p = fit_.found().parameters;
  const ForceParameters force = fit_.layout().force(start_.p);
  natural_ = force.natural_frequency();
  scale_ = {fit_.layout().length(), fit_.layout().length() * natural_};
  unit_force_ = force.k * scale_.length;
  list_ = history_relaxations(fit_.tests(), constants_);
  zeros_ = free_zeros(fit_.tests(), scale_);
  start_.zeros.resize(static_cast<Eigen::Index>(zeros_.size()));
  for (std::size_t i = 0; i < zeros_.size(); ++i) start_.zeros[static_cast<Eigen::Index>(i)] = zeros_[i].near;
  start_.g = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(list_.relaxations.size()));
  for (const ForwardTest& test : fit_.tests()) {
    noise_.push_back(noise_levels(*test.history, force.k, scale_, sigma_x));
    if (noise_.back().drive > 0.0)
      shaken_.emplace(noise_.size() - 1, SampledOscillator(with_noisier_drive(*test.history), test.model.steps()));
  }
}

void HistoryLinearisation::free_zero_of_x(bool is_free) {
  std::erase_if(zeros_, [](const FreeZero& zero) { return zero.sensor == MotionSensor::x; });
  if (is_free) zeros_.push_back({.sensor = MotionSensor::x, .unit = scale_.length});
  const Eigen::Index before = std::min(start_.zeros.size(), static_cast<Eigen::Index>(zeros_.size()));
  start_.zeros.conservativeResize(static_cast<Eigen::Index>(zeros_.size()));
  start_.zeros.tail(start_.zeros.size() - before).setZero();
}

void HistoryLinearisation::forget_stated() {
  sigma_x_ = 0.0;
  for (std::size_t t = 0; t < noise_.size(); ++t)
    noise_[t].x = noise_levels(*fit_.tests()[t].history, unit_force_ / scale_.length, scale_).x;
}

ForceParameters HistoryLinearisation::force_at(const Place& at) const {
  ForceParameters force = fit_.layout().force(at.p);
  for (std::size_t j = 0; j < list_.parts.size(); ++j)
    if (is_constant(j)) ForwardLayout::value(force, list_.parts[j].by) += at.g[static_cast<Eigen::Index>(j)];
  return force;
}

Place HistoryLinearisation::stepped(Place at, const Eigen::VectorXd& step, const Taken& taken) const {
  const double scale = fit_.layout().shared()[0].scale;
  const ForceParameters before = force_at(at);
  const double zeta = (before.c + step[0] * scale) / critical_damping(before.m, before.k);
  const Eigen::Index base = count_of_base();
  at.p += step.head(at.p.size());
  at.zeros += step.segment(at.p.size(), at.zeros.size());
  for (std::size_t j = 0; j < taken.size(); ++j) {
    double& g = at.g[static_cast<Eigen::Index>(taken[j])];
    const double moved = g + step[base + static_cast<Eigen::Index>(j)];
    constexpr double least = 0.5;  // of a contact's yielding: no step makes it rigid
    g = is_contact(taken[j]) ? std::max(least * g, moved * (g > 0.0 ? 1.0 : 0.0)) : moved;
  }
  fit_.layout().bound(at.p);
  const ForceParameters after = force_at(at);
  if (after.m > 0.0 && after.k > 0.0) at.p[0] = zeta * critical_damping(after.m, after.k) / scale;
  return at;
}

std::optional<LinearisedHistories> HistoryLinearisation::at(const Place& place, const Taken& wanted,
                                                            Whitening whitening,
                                                            const std::vector<Autoregression>& errors) {
  const ForceParameters force = force_at(place);
  if (!(force.m > 0.0) || !(force.k > 0.0)) return std::nullopt;
  Channels channels;
  const bool shake = whitening == Whitening::on && !shaken_.empty() && !noise_grows(force, record_);
  for (std::size_t t = 0; t < fit_.tests().size(); ++t)
    if (!add_test(t, place, wanted, shake, channels)) return std::nullopt;
  return whitened(channels, wanted.size(), whitening, errors, shake);
}

LinearisedHistories HistoryLinearisation::whitened(Channels& channels, std::size_t wanted, Whitening whitening,
                                                   const std::vector<Autoregression>& errors, bool shake) {
  LinearisedHistories result;
  const Eigen::Index base = count_of_base();
  const auto more = static_cast<Eigen::Index>(wanted);
  result.squares = channels.x.rows.col(0).squaredNorm();
  std::vector<Eigen::MatrixXd> parts;
  for (Channel* channel : {&channels.x, &channels.v, &channels.a}) {
    if (channel->rows.rows() == 0) continue;
    if (whitening == Whitening::off) channel->most_lags = 0;
    const Autoregression* known = errors.empty() ? nullptr : &errors[parts.size()];
    WhiteRows made = made_white(*channel, base + more, known, channel == &channels.x && is_stated());
    if (channel == &channels.x && whitening == Whitening::on && known == nullptr) scatter_ = made.scatter;
    result.log_variances += made.log_variances;
    result.freedom = std::min(result.freedom, made.freedom);
    result.errors.push_back(std::move(made.errors));
    parts.push_back(std::move(made.rows));
  }
  const Eigen::MatrixXd rows = stacked(parts);
  result.residuals = rows.col(0);
  result.base = rows.middleCols(1, base);
  result.relaxed = rows.middleCols(1 + base, more);
  if (shake) result.shaken = rows.rightCols(1 + base + more);
  return result;
}

SampledOscillator::Parameters HistoryLinearisation::parameters_of(std::size_t t, const Place& at,
                                                                  const Taken& wanted) const {
  const ForceParameters force = force_at(at);
  SampledOscillator::Parameters parameters = fit_.layout().parameters(at.p, t, fit_.tests()[t]);
  parameters.m = force.m;
  parameters.k = force.k;
  for (const std::size_t j : wanted) {
    const FreedPart& part = list_.parts[j];
    const double g = at.g[static_cast<Eigen::Index>(j)];
    if (part.kind == FreedPart::Kind::friction_of_history)
      parameters.F0 += g * share_of(part, t, fit_.tests().size());
    if (is_force(j, at)) parameters.further.push_back(g);
    if (yields(j, at)) parameters.yield = g * scale_.length;
  }
  return parameters;
}

/// A contact that does not yield yet is tested by the force of its term.
bool HistoryLinearisation::is_force(std::size_t number, const Place& at) const {
  return list_.parts[number].kind == FreedPart::Kind::force || (is_contact(number) && !yields(number, at));
}

bool HistoryLinearisation::yields(std::size_t number, const Place& at) const {
  return is_contact(number) && at.g[static_cast<Eigen::Index>(number)] > 0.0;
}

std::vector<SampledOscillator::Force> HistoryLinearisation::forces_of(const Place& at, const Taken& wanted) const {
  std::vector<SampledOscillator::Force> forces;
  for (const std::size_t j : wanted) {
    const FreedPart& part = list_.parts[j];
    if (!is_force(j, at)) continue;
    const double unit = part.term->assumption == Assumption::sensors ? 1.0 : unit_force_;
    forces.emplace_back([term = part.term, unit, scale = scale_](const SampledOscillator::Instant& instant) {
      return unit * term->force(instant, scale);
    });
  }
  return forces;
}

std::vector<SampledOscillator::By> HistoryLinearisation::columns_of(std::size_t t, const Place& at,
                                                                    const Taken& wanted) const {
  std::vector<SampledOscillator::By> by;
  for (const ForwardLayout::Column& column : fit_.layout().columns(t, fit_.tests()[t])) by.push_back(column.by);
  for (const std::size_t j : wanted)
    if (is_constant(j)) by.push_back(list_.parts[j].by);
  for (const std::size_t j : wanted)
    if (yields(j, at)) by.push_back(SampledOscillator::By::yield);
  return by;
}

bool HistoryLinearisation::add_test(std::size_t t, const Place& at, const Taken& wanted, bool shake,
                                    Channels& channels) {
  ForwardTest& test = fit_.tests()[t];
  const SampledOscillator::Parameters parameters = parameters_of(t, at, wanted);
  const std::vector<SampledOscillator::By> by = columns_of(t, at, wanted);
  const std::vector<SampledOscillator::Force> forces = forces_of(at, wanted);
  Motion motion;
  const auto move = [&](SampledOscillator& model) {
    return model.run(parameters, by, motion.x, &motion.derivatives, &motion.v, forces);
  };
  SensorRows noisier;
  if (shake) {
    const auto other = shaken_.find(t);
    if (!move(other == shaken_.end() ? test.model : other->second)) return false;
    noisier = rows_of(t, at, wanted, motion);
  }
  if (!move(test.model)) return false;
  SensorRows rows = rows_of(t, at, wanted, motion);
  if (shake) rows.append(noisier);
  const History& history = *test.history;
  if (!history.a.empty()) leave_out_reversals(motion.v, rows.a);
  make_innovations(motion.derivatives.steps, noise_[t], force_at(at), rows);
  // The same rows in every step of a fit.
  if (moving_.size() == t) moving_.push_back(moving_rows(history, motion.x, parameters.F0 / parameters.k));
  const Eigen::Index moving = moving_[t];
  // Rows follow the motion at 24 in a period. In all, few are averaged less: how long their errors last must show.
  constexpr double in_period = 24.0;
  constexpr Eigen::Index few = 400;
  const Eigen::Index most_width = std::lround(history.sample_rate * core::two_pi / natural_ / in_period);
  const Eigen::Index width = std::max<Eigen::Index>(1, std::min(most_width, fit_.residuals().count() / few));
  // Means of independent errors have their deviation over the root of the width.
  const double root = std::sqrt(static_cast<double>(width));
  channels.x.add(root * averaged(rows.x.topRows(moving), width));
  constexpr Eigen::Index fewest = 20;
  const Eigen::Map<const Eigen::VectorXd> rest(history.at_rest.data(),
                                               static_cast<Eigen::Index>(history.at_rest.size()));
  if (rest.size() / width >= fewest) channels.x.at_rest.emplace_back(root / noise_[t].x * averaged(rest, width));
  if (!history.v.empty()) channels.v.add(averaged(rows.v.topRows(moving), width));
  if (!history.a.empty()) channels.a.add(averaged(rows.a.topRows(moving), width));
  return true;
}

SensorRows HistoryLinearisation::rows_of(std::size_t t, const Place& at, const Taken& wanted,
                                         const Motion& motion) {
  const History& history = *fit_.tests()[t].history;
  const double rate = history.sample_rate;
  const Eigen::VectorXd& a = motion.derivatives.a;
  const Eigen::VectorXd jerk = finely_differentiated(a, rate);
  const Eigen::MatrixXd columns_x = arranged(t, at, wanted, motion.derivatives.x);
  const Eigen::MatrixXd columns_v = arranged(t, at, wanted, motion.derivatives.v);
  const HistoryReader read{list_.parts, zeros_, fit_.layout(), scale_.length, at, wanted, t};
  SensorRows rows;
  rows.x = read(MotionSensor::x, history.x, {motion.x, motion.v, a, rate}, columns_x, columns_v);
  if (!history.v.empty())
    rows.v =
        read(MotionSensor::v, history.v, {motion.v, a, jerk, rate}, columns_v, differentiated(columns_v, rate));
  if (!history.a.empty())
    rows.a =
        read(MotionSensor::a, history.a, {a, jerk, Eigen::VectorXd::Zero(jerk.size()), rate},
             finely_differentiated(columns_v, rate), Eigen::MatrixXd::Zero(columns_v.rows(), columns_v.cols()));
  return rows;
}

Eigen::MatrixXd HistoryLinearisation::arranged(std::size_t t, const Place& at, const Taken& wanted,
                                               const Eigen::MatrixXd& derivatives) {
  const ForwardLayout& layout = fit_.layout();
  const ForceParameters force = force_at(at);
  const Eigen::Index base = count_of_base();
  Eigen::MatrixXd result =
      Eigen::MatrixXd::Zero(derivatives.rows(), base + static_cast<Eigen::Index>(wanted.size()));
  Eigen::Index from = 0;
  const auto at_constant_zeta = [&](SampledOscillator::By by) {
    const double share = by == SampledOscillator::By::mass ? 0.5 * force.c / force.m : 0.5 * force.c / force.k;
    return Eigen::VectorXd(derivatives.col(from) + share * derivatives.col(0));
  };
  for (const ForwardLayout::Column& column : layout.columns(t, fit_.tests()[t])) {
    const bool constant = column.by == SampledOscillator::By::mass || column.by == SampledOscillator::By::stiffness;
    result.col(column.column) =
        (constant ? at_constant_zeta(column.by) : Eigen::VectorXd(derivatives.col(from))) * column.scale;
    ++from;
  }
  for (std::size_t j = 0; j < wanted.size(); ++j)
    if (const FreedPart& part = list_.parts[wanted[j]]; part.kind == FreedPart::Kind::constant) {
      result.col(base + static_cast<Eigen::Index>(j)) = at_constant_zeta(part.by);
      ++from;
    }
  for (std::size_t j = 0; j < wanted.size(); ++j)
    if (yields(wanted[j], at))
      result.col(base + static_cast<Eigen::Index>(j)) = derivatives.col(from++) * scale_.length;
  for (std::size_t j = 0; j < wanted.size(); ++j) {
    const FreedPart& part = list_.parts[wanted[j]];
    const Eigen::Index to = base + static_cast<Eigen::Index>(j);
    if (is_force(wanted[j], at)) result.col(to) = derivatives.col(from++);
    if (part.kind == FreedPart::Kind::friction_of_history)
      result.col(to) = result.col(1) * (share_of(part, t, fit_.tests().size()) / layout.shared()[1].scale);
  }
  return result;
}

}  // namespace dualdamp::identify
