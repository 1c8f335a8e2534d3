#include "identify/ledger/histories/history_model.hpp"

#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/numbers.hpp"
#include "identify/ledger/histories/freed_constants.hpp"
#include "identify/ledger/histories/history_linearisation.hpp"
#include "identify/ledger/histories/unlike_zeros.hpp"
#include "identify/ledger/stated_noise.hpp"
#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

namespace {

/// The histories of one record with their fit, at which the joint model is linearised. In reading order:
///  1. `fitted`: the nearest of some fits, to which Gauss-Newton steps (`descend`) lead, as a joint model
///  (`joint`);
///  2. `through_constant`, `seen_from_afar`, `freed`: if the stated constants miss most of the motion.
class Histories {
 public:
  Histories(Record record, const KnownConstants& constants, double sigma_x, Estimate& exclusions)
      : record_(std::move(record)), constants_(constants), motion_(record_, constants_, sigma_x, exclusions) {}

  [[nodiscard]] const Record& record() const { return record_; }
  [[nodiscard]] const KnownConstants& constants() const { return constants_; }
  [[nodiscard]] HistoryLinearisation& motion() { return motion_; }
  [[nodiscard]] std::string fault_of_fit() { return freed_.fault(); }  ///< why the fit tells nothing; else empty

  /// The model linearised where the relaxations taken are fitted beside the parameters.
  [[nodiscard]] JointModel fitted(const Taken& taken) {
    Fitted best{motion_.start(), motion_.at(motion_.start(), taken, Whitening::off)};
    bool is_near = taken.empty();
    for (const std::size_t number : taken) {
      const std::optional<Place> other = freed(number);
      if (other) best.take_nearer({*other, motion_.at(*other, taken, Whitening::off)});
      is_near = is_near || (other && (motion_.is_constant(number) ||
                                      freed_.with(motion_.list().parts[number]) == freed_.much_nearer()));
    }
    if (const std::optional<Place> yielding = yielding_at(taken))
      best.take_nearer({*yielding, motion_.at(*yielding, taken, Whitening::off)});
    descend(taken, best);
    if (!is_near) best.take_nearer(through_constant(taken));
    if (taken.empty()) plain_ = best.at;
    return joint(best.at, taken);
  }

  /// Where the model with nothing relaxed is linear.
  [[nodiscard]] const Place& plain() const { return plain_; }

 private:
  struct Fitted {
    Place at;
    std::optional<LinearisedHistories> here;

    void take_nearer(Fitted&& other) {
      if (other.here && !(here && other.here->squares > here->squares)) *this = std::move(other);
    }
  };

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
      std::optional<LinearisedHistories> next;
      Place moved;
      for (double share = 1.0; share > 0.05; share *= 0.4) {
        moved = motion_.stepped(at, share * step, taken);
        next = motion_.at(moved, taken, Whitening::off);
        if (next && next->squares < here->squares) break;
        next.reset();
      }
      if (!next) break;
      at = std::move(moved);
      here = std::move(next);
    }
  }

  /// Where a contact that yields, taken alone, comes nearest: no step leads there from a rigid one.
  [[nodiscard]] std::optional<Place> yielding_at(const Taken& taken) {
    const auto found = std::ranges::find_if(taken, [&](std::size_t number) { return motion_.is_contact(number); });
    if (found == taken.end()) return std::nullopt;
    if (!yielding_) yielding_ = with_contact(*found);
    return yielding_->here ? std::optional(yielding_->at) : std::nullopt;
  }

  [[nodiscard]] Fitted with_contact(std::size_t number) {
    Fitted best{motion_.start(), std::nullopt};
    for (const double yield : {0.003, 0.01, 0.03, 0.06, 0.12, 0.25, 0.5}) {  // of the length of the motion
      Fitted next{motion_.start(), std::nullopt};
      next.at.g[static_cast<Eigen::Index>(number)] = yield;
      next.here = motion_.at(next.at, {number}, Whitening::off);
      best.take_nearer(std::move(next));
    }
    descend({number}, best);
    return best;
  }

  /// A fit out of step with the motion is at a minimum of its own, which no step leaves, whatever is relaxed. A fit
  /// with a constant free that comes much nearer keeps in step, and from there the constant is set back.
  [[nodiscard]] Fitted through_constant(const Taken& taken) {
    const FreedFit* near = freed_.much_nearer();
    for (std::size_t j = 0; near != nullptr && j < motion_.list().parts.size(); ++j) {
      if (freed_.with(motion_.list().parts[j]) != near) continue;
      Taken both = taken;
      both.push_back(j);
      Fitted through{*freed(j), {}};
      through.here = motion_.at(through.at, both, Whitening::off);
      descend(both, through);
      Eigen::VectorXd back =
          Eigen::VectorXd::Zero(motion_.count_of_base() + static_cast<Eigen::Index>(both.size()));
      back[back.size() - 1] = -through.at.g[static_cast<Eigen::Index>(j)];
      through.at = motion_.stepped(through.at, back, both);
      through.here = motion_.at(through.at, taken, Whitening::off);
      descend(taken, through);
      return through;
    }
    return {motion_.start(), std::nullopt};
  }

  [[nodiscard]] JointModel joint(const Place& at, const Taken& taken) {
    JointModel model;
    model.relaxations = motion_.list().relaxations;
    model.coefficients = at.g;
    for (std::size_t j = 0; j < motion_.list().parts.size(); ++j) {
      const FreedPart& part = motion_.list().parts[j];
      if (is_hidden(j)) model.hidden.push_back(j);
      model.relaxations[j].is_far =
          part.kind == FreedPart::Kind::corner || (!motion_.is_constant(j) && freed(j).has_value());
      if (part.kind == FreedPart::Kind::zero || (part.term != nullptr && part.term->is_constant))
        model.relaxations[j].constant_force = motion_.unit_force();
    }
    double lasting = core::infinity;
    if (std::optional<LinearisedHistories> found = taken.empty() ? seen_from_afar(at) : with_all(at, taken)) {
      model.deviance =
          found->log_variances +
          left_beside(free_columns(found->base, found->relaxed, taken), found->residuals).squaredNorm();
      lasting = found->freedom;
      model.residuals = std::move(found->residuals);
      model.base = std::move(found->base);
      model.relaxed = std::move(found->relaxed);
      model.shaken = std::move(found->shaken);
    }
    const ForceParameters force = motion_.force_at(at);
    model.value = parameters(force);
    model.is_possible = std::ranges::all_of(taken, [&](std::size_t number) {
      const FreedPart& part = motion_.list().parts[number];
      const HistoryTerm* term = part.term;
      const double g = at.g[static_cast<Eigen::Index>(number)];
      constexpr double most_bent = 0.05;  // of half the range: a sensor that is sold as linear bends less
      if (part.kind == FreedPart::Kind::square || part.kind == FreedPart::Kind::cube)
        return std::abs(g) < most_bent;
      return term == nullptr || !term->is_constant || std::abs(g) * motion_.unit_force() <= force.F0;
    });
    if (model.residuals.size() == 0) return model;
    const std::vector<ForwardLayout::Entry>& shared = motion_.fit().layout().shared();
    // From the scales of the fit to zeta and F0.
    const Eigen::Vector2d units(critical_damping(force.m, force.k) / shared[0].scale, 1.0 / shared[1].scale);
    for (Eigen::Index j = 0; j < units.size(); ++j) {
      model.base.col(j) *= units[j];
      if (model.shaken.size() > 0) model.shaken.col(1 + j) *= units[j];
    }
    model.constants = {force.m, force.k, constants_.frequency};
    model.is_stated = motion_.is_stated();
    model.scale_freedom =
        std::min(lasting, model.is_stated ? known_freedom : static_cast<double>(model.residuals.size()));
    model.has_one_scale = true;
    model.F0_parts = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(motion_.list().parts.size()));
    model.zeta_parts = model.F0_parts;
    for (std::size_t j = 0; j < motion_.list().parts.size(); ++j) {
      const auto own = static_cast<Eigen::Index>(j);
      if (motion_.list().parts[j].kind == FreedPart::Kind::friction_of_history) model.F0_parts[own] = 1.0;
      if (motion_.list().parts[j].term != nullptr && motion_.list().parts[j].term->one_sided)
        model.zeta_parts[own] = motion_.unit_damping() / critical_damping(force.m, force.k);
    }
    return model;
  }

  [[nodiscard]] bool is_hidden(std::size_t number) const {
    const HistoryTerm* term = motion_.list().parts[number].term;
    return term != nullptr && term->is_hidden;
  }

  /// Linearised with a column for each relaxation: zero for the hidden ones, but for those taken.
  [[nodiscard]] std::optional<LinearisedHistories> with_all(const Place& at, const Taken& taken,
                                                            const std::vector<Autoregression>& errors = {}) {
    Taken wanted;
    for (std::size_t j = 0; j < motion_.list().parts.size(); ++j)
      if (!is_hidden(j) || std::ranges::find(taken, j) != taken.end()) wanted.push_back(j);
    std::optional<LinearisedHistories> found = motion_.at(at, wanted, Whitening::on, errors);
    const auto spread = [&](Eigen::MatrixXd& columns, Eigen::Index before) {
      const Eigen::MatrixXd few = columns;
      columns.setZero(few.rows(), before + static_cast<Eigen::Index>(motion_.list().parts.size()));
      columns.leftCols(before) = few.leftCols(before);
      for (std::size_t i = 0; i < wanted.size(); ++i)
        columns.col(before + static_cast<Eigen::Index>(wanted[i])) = few.col(before + static_cast<Eigen::Index>(i));
    };
    if (found) spread(found->relaxed, 0);
    if (found && found->shaken.size() > 0) spread(found->shaken, 1 + found->base.cols());
    return found;
  }

  /// A fit that something wrong keeps from the motion, by more than the linear model sees, leaves swings as well.
  /// If one relaxation brings it much nearer, errors are those of the fit with it.
  [[nodiscard]] std::optional<LinearisedHistories> seen_from_relaxed(const Place& at) {
    constexpr double large = 1.5;  // times the noise by differences
    constexpr double much_less = 0.5;
    std::optional<LinearisedHistories> found = with_all(at, {});
    if (!found || std::isinf(found->freedom) || motion_.scatter() < large) return found;
    Fitted best{at, std::nullopt};
    Taken taken;
    for (std::size_t j = 0; j < motion_.list().parts.size(); ++j) {
      Fitted relaxed{at, is_hidden(j) ? std::nullopt : motion_.at(at, {j}, Whitening::off)};
      descend({j}, relaxed);
      if (!relaxed.here || (best.here && relaxed.here->squares >= best.here->squares)) continue;
      best = std::move(relaxed);
      taken = {j};
    }
    if (!best.here || !(best.here->squares < much_less * found->squares)) return found;
    const std::optional<LinearisedHistories> near = motion_.at(best.at, taken, Whitening::on);
    return near ? with_all(at, {}, near->errors) : found;
  }

  /// Far from the right constants the fit leaves a swing, which an autoregression would take for errors that last.
  /// If another constant brings it much nearer, errors are those of the nearer fit, and the column of a constant
  /// leads straight to the fit with it free.
  [[nodiscard]] std::optional<LinearisedHistories> seen_from_afar(const Place& at) {
    const FreedFit* near = freed_.much_nearer();
    std::optional<LinearisedHistories> nearer;
    for (std::size_t j = 0; near != nullptr && !nearer && j < motion_.list().parts.size(); ++j)
      if (freed_.with(motion_.list().parts[j]) == near) nearer = motion_.at(*freed(j), {}, Whitening::on);
    if (!nearer) return seen_from_relaxed(at);
    std::optional<LinearisedHistories> found = with_all(at, {}, nearer->errors);
    for (std::size_t j = 0; found && j < motion_.list().parts.size(); ++j) {
      const std::optional<Place> place = freed(j);
      const auto own = static_cast<Eigen::Index>(j);
      const std::optional<LinearisedHistories> there =
          place && place->g[own] != 0.0 ? motion_.at(*place, {}, Whitening::on, nearer->errors) : std::nullopt;
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
    const FreedFit* found = freed_.with(motion_.list().parts[number]);
    if (found == nullptr) return std::nullopt;
    Place place{found->p, motion_.start().zeros, motion_.start().g};
    place.g[static_cast<Eigen::Index>(number)] = found->change;
    return place;
  }

  Record record_;
  KnownConstants constants_;
  HistoryLinearisation motion_;
  Place plain_;
  std::optional<Fitted> yielding_;  ///< with a contact that yields, once it was sought
  FreedConstants freed_{record_, constants_, motion_.fit()};
};

/// Where the zero of x differs from history to history, no one need be as stated: their mean is free as well. The
/// histories are then read about their zeros: a fit about others ends with another F0, at the wrong half swing.
void free_unlike_zeros(double sigma_x, std::shared_ptr<Histories>& histories, JointModel& model) {
  HistoryLinearisation& motion = histories->motion();
  if (motion.fit().layout().count_of_zeros() == 0) return;
  motion.free_zero_of_x(true);
  const JointModel other = histories->fitted({});
  const Eigen::VectorXd zeros = unlike_zeros(other, motion.fit().layout(), histories->plain());
  motion.free_zero_of_x(false);
  if (zeros.size() == 0) return;
  Record moved = histories->record();
  const std::vector<ForwardTest>& tests = motion.fit().tests();
  for (std::size_t t = 0; t < tests.size(); ++t)
    for (double& x : moved.histories[static_cast<std::size_t>(tests[t].number) - 1].x)
      x -= zeros[motion.fit().layout().records()[t]];
  Estimate unused;
  const auto about_zeros = std::make_shared<Histories>(std::move(moved), histories->constants(),
                                                       motion.is_stated() ? sigma_x : 0.0, unused);
  const ForwardFit& fit = about_zeros->motion().fit();
  if (!fit.problem().empty() || fit.tests().size() != tests.size()) return;
  about_zeros->motion().free_zero_of_x(true);
  JointModel found = about_zeros->fitted({});
  // A fit about a wrong mean may have zeros that differ where those of the nearer fit do not.
  if (unlike_zeros(found, fit.layout(), about_zeros->plain(), zeros).size() == 0) return;
  found.warnings = std::move(model.warnings);
  constexpr int digits = 3;
  found.unlike_zeros = "the zero of x differs from history to history, by up to " +
                       core::format_number(zeros.maxCoeff() - zeros.minCoeff(), digits) + " " +
                       histories->constants().unit("m");
  histories = about_zeros;
  model = std::move(found);
}

}  // namespace

std::variant<JointModel, std::string> history_model(const Record& record, const KnownConstants& constants,
                                                    double sigma_x, std::string* missed) {
  if (std::string fault = fault_of_histories(record); !fault.empty()) return fault;
  Estimate exclusions;
  auto histories = std::make_shared<Histories>(record, constants, sigma_x, exclusions);
  HistoryLinearisation& motion = histories->motion();
  if (std::string problem = motion.fit().problem(); !problem.empty()) return problem;
  if (std::string fault = histories->fault_of_fit(); !fault.empty()) {
    if (missed != nullptr) *missed = fault;
    return fault;
  }
  JointModel model = histories->fitted({});
  const double ratio = motion.scatter();
  const auto freedom = static_cast<double>(sigma_x > 0.0 ? model.residuals.size() : 0);
  const ScatterBesideStated scatter = readings_scatter(ratio, freedom);
  if (scatter == ScatterBesideStated::more) {
    motion.forget_stated();
    model = histories->fitted({});
  }
  note_contradiction(scatter, ratio, "samples of x", model);
  free_unlike_zeros(sigma_x, histories, model);
  if (model.residuals.size() == 0 || !model.residuals.allFinite() || !model.base.allFinite())
    return "the simulated motion, fitted with the mass and the stiffness as stated, grows beyond all numbers";
  model.refit = [histories](const Taken& numbers) { return histories->fitted(numbers); };
  model.of_histories = true;
  const ForwardFit& fit = histories->motion().fit();
  model.data = std::to_string(fit.residuals().count()) + " samples of " + std::to_string(fit.tests().size()) +
               (fit.tests().size() == 1 ? " history" : " histories");
  for (const Exclusion& exclusion : exclusions.excluded)
    model.left_out.push_back("history " + std::to_string(exclusion.number) + ": " + exclusion.reason);
  return model;
}

}  // namespace dualdamp::identify
