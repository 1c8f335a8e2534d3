#include "identify/ledger/history_model.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>

#include "core/constants.hpp"
#include "identify/ledger/freed_constants.hpp"
#include "identify/ledger/history_relaxations.hpp"
#include "identify/ledger/history_rows.hpp"
#include "identify/ledger/innovations.hpp"
#include "identify/ledger/stated_noise.hpp"
#include "identify/methods/histories/forward_fit.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

namespace {

using By = SampledOscillator::By;

/// Whether the rows of a channel are made white. Only the joint model needs that.
enum class Whitening { off, on };

/// The histories of one record with their fit, at which the joint model is linearised. In reading order:
///  1. `fitted`: the nearest of some fits, to which Gauss-Newton steps (`descend`) lead, as a joint model
///  (`joint`);
///  2. `linearised`: the rows of all channels at one place, whitened;
///  3. `add_test`: of one test, the simulated motion and its derivatives, and the innovations of its rows;
///  4. `rows_of`, `arranged`: what each sensor reads of that motion, a column for each parameter and relaxation;
///  5. `through_constant`, `seen_from_afar`, `freed`: if the stated constants miss most of the motion.
class Histories {
 public:
  Histories(const Record& record, const KnownConstants& constants, double sigma_x, Estimate& exclusions)
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
      if (noise_.back().drive > 0.0) shaken_.emplace(noise_.size() - 1, with_noisier_drive(*test.history));
    }
  }

  [[nodiscard]] ForwardFit& fit() { return fit_; }

  /// The model linearised where the relaxations taken are fitted beside the parameters.
  [[nodiscard]] JointModel fitted(const Taken& taken) {
    Taken all(list_.relaxations.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    Fitted best{start_, linearised(start_, taken, Whitening::off)};
    bool is_near = taken.empty();
    for (const std::size_t number : taken) {
      const std::optional<Place> other = freed(number);
      if (other) best.take_nearer({*other, linearised(*other, taken, Whitening::off)});
      is_near =
          is_near || (other && (is_constant(number) || freed_.with(list_.parts[number]) == freed_.much_nearer()));
    }
    descend(taken, best);
    if (!is_near) best.take_nearer(through_constant(taken));
    return joint(best.at, taken, all);
  }

  void forget_stated() {  // the noise of x is that of its samples
    sigma_x_ = 0.0;
    for (std::size_t t = 0; t < noise_.size(); ++t)
      noise_[t].x = noise_levels(*fit_.tests()[t].history, unit_force_ / scale_.length, scale_).x;
  }

  [[nodiscard]] double scatter() const { return scatter_; }            ///< of the samples of x over that stated
  [[nodiscard]] std::string fault_of_fit() { return freed_.fault(); }  ///< why the fit tells nothing; else empty

 private:
  struct Linearised {
    Eigen::VectorXd residuals;
    Eigen::MatrixXd base;
    Eigen::MatrixXd relaxed;
    Eigen::MatrixXd shaken;      ///< all of these with more noise in the drive; empty: not wanted, or no noise
    double log_variances = 0.0;  ///< of the errors of the rows, summed
    double squares = 0.0;        ///< of the innovations of x
    double variance = 1.0;       ///< of one residual
    std::vector<Autoregression> errors;  ///< of the channels that were read
  };

  struct Fitted {
    Place at;
    std::optional<Linearised> here;

    void take_nearer(Fitted&& other) {
      if (other.here && !(here && other.here->squares > here->squares)) *this = std::move(other);
    }
  };

  [[nodiscard]] bool is_constant(std::size_t number) const {
    return list_.parts[number].kind == FreedPart::Kind::constant;
  }

  /// Steps of Gauss and Newton, as long as they bring the motion nearer.
  void descend(const Taken& taken, Fitted& fitted) {
    auto& [at, here] = fitted;
    constexpr int most_steps = 8;
    for (int i = 0; here && i < most_steps; ++i) {
      Eigen::MatrixXd columns(here->residuals.size(), here->base.cols() + here->relaxed.cols());
      columns << here->base, here->relaxed;
      const Eigen::VectorXd step = pivoted_least_squares(columns, here->residuals);
      constexpr double little = 0.01;  // of a standard error, squared
      if (!step.allFinite() || (columns * step).squaredNorm() < little * here->variance) break;
      std::optional<Linearised> next;
      Place moved;
      for (double share = 1.0; share > 0.05; share *= 0.4) {
        moved = stepped(at, share * step, taken);
        next = linearised(moved, taken, Whitening::off);
        if (next && next->squares < here->squares) break;
        next.reset();
      }
      if (!next) break;
      at = std::move(moved);
      here = std::move(next);
    }
  }

  /// A fit out of step with the motion is at a minimum of its own, which no step leaves, whatever is relaxed. A fit
  /// with a constant free that comes much nearer keeps in step, and from there the constant is set back.
  [[nodiscard]] Fitted through_constant(const Taken& taken) {
    const FreedFit* near = freed_.much_nearer();
    for (std::size_t j = 0; near != nullptr && j < list_.parts.size(); ++j) {
      if (freed_.with(list_.parts[j]) != near) continue;
      Taken both = taken;
      both.push_back(j);
      Fitted through{*freed(j), {}};
      through.here = linearised(through.at, both, Whitening::off);
      descend(both, through);
      Eigen::VectorXd back = Eigen::VectorXd::Zero(count_of_base() + static_cast<Eigen::Index>(both.size()));
      back[back.size() - 1] = -through.at.g[static_cast<Eigen::Index>(j)];
      through.at = stepped(through.at, back, both);
      through.here = linearised(through.at, taken, Whitening::off);
      descend(taken, through);
      return through;
    }
    return {start_, std::nullopt};
  }

  [[nodiscard]] JointModel joint(const Place& at, const Taken& taken, const Taken& all) {
    JointModel model;
    model.relaxations = list_.relaxations;
    for (std::size_t j = 0; j < list_.parts.size(); ++j)
      model.relaxations[j].is_far = !is_constant(j) && freed(j).has_value();
    if (std::optional<Linearised> found =
            taken.empty() ? seen_from_afar(at, all) : linearised(at, all, Whitening::on)) {
      model.deviance =
          found->log_variances +
          left_beside(free_columns(found->base, found->relaxed, taken), found->residuals).squaredNorm();
      model.residuals = std::move(found->residuals);
      model.base = std::move(found->base);
      model.relaxed = std::move(found->relaxed);
      model.shaken = std::move(found->shaken);
    }
    const ForceParameters force = force_at(at);
    model.value = parameters(force);
    if (model.residuals.size() == 0) return model;
    const std::vector<ForwardLayout::Entry>& shared = fit_.layout().shared();
    // From the scales of the fit to zeta and F0.
    const Eigen::Vector2d units(critical_damping(force.m, force.k) / shared[0].scale, 1.0 / shared[1].scale);
    for (Eigen::Index j = 0; j < units.size(); ++j) {
      model.base.col(j) *= units[j];
      if (model.shaken.size() > 0) model.shaken.col(1 + j) *= units[j];
    }
    model.constants = {force.m, force.k, constants_.frequency};
    model.is_stated = sigma_x_ > 0.0;
    model.scale_freedom = model.is_stated ? known_freedom : static_cast<double>(model.residuals.size());
    model.F0_parts = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(list_.parts.size()));
    model.zeta_parts = model.F0_parts;
    for (std::size_t j = 0; j < list_.parts.size(); ++j) {
      const auto own = static_cast<Eigen::Index>(j);
      if (list_.parts[j].kind == FreedPart::Kind::friction_of_history) model.F0_parts[own] = 1.0;
      if (list_.parts[j].term != nullptr && list_.parts[j].term->one_sided)
        model.zeta_parts[own] = unit_force_ / scale_.speed / critical_damping(force.m, force.k);
    }
    return model;
  }

  /// Far from the right constants the fit leaves a swing, which an autoregression would take for errors that last.
  /// If another constant brings it much nearer, errors are those of the nearer fit, and the column of a constant
  /// leads straight to the fit with it free.
  [[nodiscard]] std::optional<Linearised> seen_from_afar(const Place& at, const Taken& all) {
    const FreedFit* near = freed_.much_nearer();
    std::optional<Linearised> nearer;
    for (std::size_t j = 0; near != nullptr && !nearer && j < list_.parts.size(); ++j)
      if (freed_.with(list_.parts[j]) == near) nearer = linearised(*freed(j), {}, Whitening::on);
    if (!nearer) return linearised(at, all, Whitening::on);
    std::optional<Linearised> found = linearised(at, all, Whitening::on, nearer->errors);
    for (std::size_t j = 0; found && j < list_.parts.size(); ++j) {
      const std::optional<Place> place = freed(j);
      const auto own = static_cast<Eigen::Index>(j);
      const std::optional<Linearised> there =
          place && place->g[own] != 0.0 ? linearised(*place, {}, Whitening::on, nearer->errors) : std::nullopt;
      if (!there) continue;
      const Eigen::VectorXd straight = (found->residuals - there->residuals) / place->g[own];
      if (found->shaken.size() > 0)
        found->shaken.col(1 + found->base.cols() + own) += straight - found->relaxed.col(own);
      found->relaxed.col(own) = straight;
    }
    return found;
  }

  /// The fit with this constant unknown: one out of step with it cannot be reached by steps from the stated one.
  [[nodiscard]] std::optional<Place> freed(std::size_t number) {
    const FreedFit* found = freed_.with(list_.parts[number]);
    if (found == nullptr) return std::nullopt;
    Place place{found->p, start_.zeros, start_.g};
    place.g[static_cast<Eigen::Index>(number)] = found->change;
    return place;
  }

  /// Always free: parameters of the fit, then the zeros of v and a.
  [[nodiscard]] Eigen::Index count_of_base() const { return fit_.layout().count() + start_.zeros.size(); }

  [[nodiscard]] ForceParameters force_at(const Place& at) const {
    ForceParameters force = fit_.layout().force(at.p);
    for (std::size_t j = 0; j < list_.parts.size(); ++j)
      if (is_constant(j)) ForwardLayout::value(force, list_.parts[j].by) += at.g[static_cast<Eigen::Index>(j)];
    return force;
  }

  /// The step of the first parameter is taken in zeta, so that a step of the mass does not change zeta.
  [[nodiscard]] Place stepped(Place at, const Eigen::VectorXd& step, const Taken& taken) const {
    const double scale = fit_.layout().shared()[0].scale;
    const ForceParameters before = force_at(at);
    const double zeta = (before.c + step[0] * scale) / critical_damping(before.m, before.k);
    const Eigen::Index base = count_of_base();
    at.p += step.head(at.p.size());
    at.zeros += step.segment(at.p.size(), at.zeros.size());
    for (std::size_t j = 0; j < taken.size(); ++j)
      at.g[static_cast<Eigen::Index>(taken[j])] += step[base + static_cast<Eigen::Index>(j)];
    at.p[1] = std::max(0.0, at.p[1]);
    const ForceParameters after = force_at(at);
    if (after.m > 0.0 && after.k > 0.0) at.p[0] = zeta * critical_damping(after.m, after.k) / scale;
    return at;
  }

  /// Rows of every channel. They are whitened by `errors`, else by their own residuals, and then have `shaken`.
  [[nodiscard]] std::optional<Linearised> linearised(const Place& at, const Taken& wanted, Whitening whitening,
                                                     const std::vector<Autoregression>& errors = {}) {
    const ForceParameters force = force_at(at);
    if (!(force.m > 0.0) || !(force.k > 0.0)) return std::nullopt;
    Channel x{.most_lags = 4};
    // Innovations are nearly white: the noise levels are estimates.
    Channel v{.most_lags = 4};
    Channel a{.most_lags = 4};
    const bool shake = whitening == Whitening::on && !shaken_.empty() && !noise_grows(force, record_);
    for (std::size_t t = 0; t < fit_.tests().size(); ++t)
      if (!add_test(t, at, wanted, shake, x, v, a)) return std::nullopt;
    Linearised result;
    const Eigen::Index base = count_of_base();
    const auto more = static_cast<Eigen::Index>(wanted.size());
    result.squares = x.rows.col(0).squaredNorm();
    std::vector<Eigen::MatrixXd> parts;
    for (Channel* channel : {&x, &v, &a}) {
      if (channel->rows.rows() == 0) continue;
      if (whitening == Whitening::off) channel->most_lags = 0;
      const Autoregression* known = errors.empty() ? nullptr : &errors[parts.size()];
      WhiteRows made = made_white(*channel, base + more, known, channel == &x && sigma_x_ > 0.0);
      if (channel == &x && whitening == Whitening::on && known == nullptr) scatter_ = made.scatter;
      result.log_variances += made.log_variances;
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

  /// The motion of a test and its derivatives by base parameters and relaxations, in the order of the columns.
  bool add_test(std::size_t t, const Place& at, const Taken& wanted, bool shake, Channel& in_x, Channel& in_v,
                Channel& in_a) {
    ForwardTest& test = fit_.tests()[t];
    const ForwardLayout& layout = fit_.layout();
    const ForceParameters force = force_at(at);
    SampledOscillator::Parameters parameters = layout.parameters(at.p, t, test);
    parameters.m = force.m;
    parameters.k = force.k;
    std::vector<By> by;
    for (const ForwardLayout::Column& column : layout.columns(t, test)) by.push_back(column.by);
    std::vector<SampledOscillator::Force> forces;
    for (const std::size_t j : wanted) {
      const FreedPart& part = list_.parts[j];
      const double g = at.g[static_cast<Eigen::Index>(j)];
      if (part.kind == FreedPart::Kind::constant) by.push_back(part.by);
      if (part.kind == FreedPart::Kind::friction_of_history)
        parameters.F0 += g * share_of(part, t, fit_.tests().size());
      if (part.kind != FreedPart::Kind::force) continue;
      const double unit = part.term->assumption == Assumption::sensors ? 1.0 : unit_force_;
      forces.emplace_back([term = part.term, unit, scale = scale_](const SampledOscillator::Instant& instant) {
        return unit * term->force(instant, scale);
      });
      parameters.further.push_back(g);
    }
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
    const double rate = history.sample_rate;
    const auto width = std::max<Eigen::Index>(1, std::lround(rate * core::two_pi / natural_ / 24.0));
    if (!history.a.empty()) leave_out_reversals(motion.v, rows.a);
    make_innovations(motion.derivatives.steps, noise_[t], force, rows);
    // The same rows in every step of a fit.
    if (moving_.size() == t) moving_.push_back(moving_rows(history, motion.x, parameters.F0 / parameters.k));
    const Eigen::Index moving = moving_[t];
    // Means of independent errors have their deviation over the root of the width.
    in_x.add(std::sqrt(static_cast<double>(width)) * averaged(rows.x.topRows(moving), width));
    if (!history.v.empty()) in_v.add(averaged(rows.v.topRows(moving), width));
    if (!history.a.empty()) in_a.add(averaged(rows.a.topRows(moving), width));
    return true;
  }

  struct Motion {
    Eigen::VectorXd x, v;
    SampledOscillator::Derivatives derivatives{.with_steps = true};
  };

  [[nodiscard]] SensorRows rows_of(std::size_t t, const Place& at, const Taken& wanted, const Motion& motion) {
    const History& history = *fit_.tests()[t].history;
    const double rate = history.sample_rate;
    const ForceParameters force = force_at(at);
    const Eigen::VectorXd& a = motion.derivatives.a;
    const Eigen::VectorXd jerk = finely_differentiated(a, rate);
    const Eigen::MatrixXd columns_x = arranged(t, wanted, force, motion.derivatives.x);
    const Eigen::MatrixXd columns_v = arranged(t, wanted, force, motion.derivatives.v);
    const HistoryReader read{list_.parts, zeros_, scale_.length, at, wanted, t};
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

  /// Base columns, then those of the relaxations wanted, from the derivatives of one test; zero for those of
  /// sensors. Columns of mass and stiffness are at constant zeta.
  [[nodiscard]] Eigen::MatrixXd arranged(std::size_t t, const Taken& wanted, const ForceParameters& force,
                                         const Eigen::MatrixXd& derivatives) {
    const ForwardLayout& layout = fit_.layout();
    const Eigen::Index base = count_of_base();
    Eigen::MatrixXd result =
        Eigen::MatrixXd::Zero(derivatives.rows(), base + static_cast<Eigen::Index>(wanted.size()));
    Eigen::Index from = 0;
    const auto at_constant_zeta = [&](By by) {
      const double share = by == By::mass ? 0.5 * force.c / force.m : 0.5 * force.c / force.k;
      return Eigen::VectorXd(derivatives.col(from) + share * derivatives.col(0));
    };
    for (const ForwardLayout::Column& column : layout.columns(t, fit_.tests()[t])) {
      const bool constant = column.by == By::mass || column.by == By::stiffness;
      result.col(column.column) =
          (constant ? at_constant_zeta(column.by) : Eigen::VectorXd(derivatives.col(from))) * column.scale;
      ++from;
    }
    for (std::size_t j = 0; j < wanted.size(); ++j)
      if (const FreedPart& part = list_.parts[wanted[j]]; part.kind == FreedPart::Kind::constant) {
        result.col(base + static_cast<Eigen::Index>(j)) = at_constant_zeta(part.by);
        ++from;
      }
    for (std::size_t j = 0; j < wanted.size(); ++j) {
      const FreedPart& part = list_.parts[wanted[j]];
      const Eigen::Index to = base + static_cast<Eigen::Index>(j);
      if (part.kind == FreedPart::Kind::force) result.col(to) = derivatives.col(from++);
      if (part.kind == FreedPart::Kind::friction_of_history)
        result.col(to) = result.col(1) * (share_of(part, t, fit_.tests().size()) / layout.shared()[1].scale);
    }
    return result;
  }

  const Record& record_;  // outlives the tests
  KnownConstants constants_;
  double sigma_x_;        ///< stated; 0: none
  double scatter_ = 1.0;  ///< of the rows of x where the model was linearised last
  ForwardFit fit_;
  Place start_;
  MotionScale scale_;
  double natural_ = 1.0;     ///< rad/s
  double unit_force_ = 1.0;  ///< N
  HistoryRelaxations list_;
  std::vector<FreeZero> zeros_;
  std::vector<ReadingNoise> noise_;
  std::map<std::size_t, SampledOscillator> shaken_;  ///< of the tests with noise in their drive
  std::vector<Eigen::Index> moving_;
  FreedConstants freed_{record_, constants_, fit_};
};

}  // namespace

std::variant<JointModel, std::string> history_model(const Record& record, const KnownConstants& constants,
                                                    double sigma_x) {
  if (std::string fault = fault_of_histories(record); !fault.empty()) return fault;
  Estimate exclusions;
  const auto histories = std::make_shared<Histories>(record, constants, sigma_x, exclusions);
  ForwardFit& fit = histories->fit();
  if (!fit.problem().empty()) return fit.problem();
  if (std::string fault = histories->fault_of_fit(); !fault.empty()) return fault;
  JointModel model = histories->fitted({});
  const double ratio = histories->scatter();
  const auto freedom = static_cast<double>(sigma_x > 0.0 ? model.residuals.size() : 0);
  const ScatterBesideStated scatter = readings_scatter(ratio, freedom);
  if (scatter == ScatterBesideStated::more) {
    histories->forget_stated();
    model = histories->fitted({});
  }
  note_contradiction(scatter, ratio, "samples of x", model);
  if (model.residuals.size() == 0 || !model.residuals.allFinite() || !model.base.allFinite())
    return "the simulated motion, fitted with the mass and the stiffness as stated, grows beyond all numbers";
  model.refit = [histories](const Taken& numbers) { return histories->fitted(numbers); };
  model.of_histories = true;
  model.step_interval = step_interval_of(fit.tests());
  model.data = std::to_string(fit.residuals().count()) + " samples of " + std::to_string(fit.tests().size()) +
               (fit.tests().size() == 1 ? " history" : " histories");
  for (const Exclusion& exclusion : exclusions.excluded)
    model.left_out.push_back("history " + std::to_string(exclusion.number) + ": " + exclusion.reason);
  return model;
}

}  // namespace dualdamp::identify
