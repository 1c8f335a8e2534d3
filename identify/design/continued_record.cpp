#include "identify/design/continued_record.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/angle.hpp"
#include "core/random.hpp"
#include "identify/methods/any_law/decay_readings.hpp"
#include "identify/methods/any_law/joined_readings.hpp"
#include "identify/methods/any_law/steady_readings.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::identify {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int phase_channel = 1;
constexpr double quarter_turn = 0.5 * std::numbers::pi;

bool reads_phases(const ReadingModel& model) {
  return std::ranges::find(model.channels(), phase_channel) != model.channels().end();
}

/// Deviations of an amplitude and of a phase. A phase that was not measured gets the relative deviation of the
/// amplitude in the middle of the range.
std::array<double, 2> deviations_of(const StudiedRecord& record) {
  const std::vector<double>& own = record.study.plain.own_deviations;
  return {own[0], reads_phases(record.model) ? own[1] : own[0] / record.model.reference().amplitude};
}

/// The unknowns `of` a fit to the record, as the first of `count` unknowns.
VectorXd extended(const VectorXd& of, Index count) {
  VectorXd unknowns = VectorXd::Zero(count);
  unknowns.head(std::min(of.size(), count)) = of.head(std::min(of.size(), count));
  return unknowns;
}

/// The states of a plan, with about the amplitudes that they will have; all with phases.
std::vector<Pair> states_of(const StudiedRecord& record, const std::vector<PlannedState>& planned) {
  const departures::ReferenceMotion& reference = record.model.reference();
  std::vector<Pair> states;
  for (const PlannedState& state : planned) {
    Pair pair{.Y = state.Y,
              .x = reference.amplitude * state.Y / reference.Y,
              .number = static_cast<int>(states.size()) + 1};
    pair.omega = state.omega;
    pair.phase = quarter_turn;
    states.push_back(pair);
  }
  return states;
}

std::vector<PlannedState> plan_of(const std::vector<Pair>& states) {
  std::vector<PlannedState> plan;
  for (const Pair& state : states) plan.push_back({state.Y, state.omega});
  return plan;
}

/// What a rival predicts at its fits. Orbits are found next to those of the last severity of the same sign.
std::vector<std::optional<Outlook>> outlook_of(const ReadingModel& block, const Rival& rival, bool friction_only) {
  std::vector<std::optional<Outlook>> list;
  std::unique_ptr<NearbyOrbits> near;
  double last = 0.0;
  for (const SeverityFit& fit : rival.fits) {
    list.emplace_back();
    // At severity zero each law is plain friction.
    if (fit.severity == 0.0 && rival.law->law.departure != nullptr) continue;
    if (near == nullptr || !(fit.severity * last > 0.0)) near = block.no_orbits(block.known_deviations());
    last = 0.0;
    const LawAt law{rival.law->law.departure, fit.severity};
    const VectorXd unknowns =
        extended(friction_only ? VectorXd(fit.unknowns.head(2)) : fit.unknowns, block.unknowns());
    const std::optional<VectorXd> residuals = block.residuals(law, unknowns, *near);
    if (!residuals) continue;
    const std::optional<MatrixXd> slopes = block.derivatives(law, unknowns, *residuals, *near);
    if (!slopes) continue;
    last = fit.severity;
    list.back() = Outlook{block.readings() - *residuals, *slopes};
  }
  return list;
}

}  // namespace

Outlooks outlooks_of(const StudiedRecord& record, const std::vector<Rival>& rivals) {
  const std::unique_ptr<const ReadingModel> block = planned_states(
      record.model, states_of(record, plan_of(record.states)), record.constants, deviations_of(record));
  Outlooks outlooks(rivals.size());
  sim::in_parts(rivals.size(), 1, 0, [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) outlooks[i] = outlook_of(*block, rivals[i], false);
  });
  return outlooks;
}

/// Record and plan as one record: the readings of one truth, and which parts of the outlooks predict them.
class ContinuedRecord::Joint {
 public:
  Joint(const StudiedRecord& record, const CandidateMeasurement& candidate, const Outlook& of_record,
        const Outlook& of_plan, std::uint64_t draw)
      : record_(record),
        deviations_(deviations_of(record)),
        noise_{.seed = 1, .stream = static_cast<std::uint32_t>(draw)} {
    const VectorXd& start = record.study.plain.fit.unknowns;
    if (const auto* decay = std::get_if<PlannedDecay>(&candidate.plan)) {
      VectorXd extremes = of_plan.readings;
      for (double& extreme : extremes) extreme += error(0);
      model_ = joined_readings(
          record.model,
          planned_decay(record.model, decay->release, std::move(extremes), record.constants, deviations_[0]),
          start);
    } else {
      model_ = continued_states(record.model, states(candidate, of_record, of_plan), record.constants, record.known,
                                start);
    }
    find_rows(candidate, of_plan);
  }

  [[nodiscard]] const ReadingModel& model() const { return *model_; }

  /// The fit of a law at a severity.
  [[nodiscard]] std::optional<SeverityFit> fit(const SeverityFit& before, const Outlook& of_record,
                                               const Outlook& of_plan, const ChannelNoise& noise) const {
    const Index unknowns = model_->unknowns();
    const Index own = std::min<Index>(record_columns_, of_record.slopes.cols());
    VectorXd residuals(static_cast<Index>(rows_.size()));
    MatrixXd slopes = MatrixXd::Zero(residuals.size(), unknowns);
    for (Index i = 0; i < residuals.size(); ++i) {
      const auto& [planned, row] = rows_[static_cast<std::size_t>(i)];
      const Outlook& of = planned ? of_plan : of_record;
      residuals[i] = model_->readings()[i] - of.readings[row];
      if (model_->channels()[static_cast<std::size_t>(i)] == phase_channel)
        residuals[i] = core::wrapped(residuals[i]);
      if (!planned || !released_) {
        slopes.row(i).head(own) = of.slopes.row(row).head(own);
      } else {
        slopes.row(i).head(2) = of.slopes.row(row).head(2);
        slopes.row(i).tail(2) = of.slopes.row(row).tail(2);
      }
    }
    return stepped_fit(*model_, before.severity, noise, extended(before.unknowns, unknowns), residuals, slopes);
  }

 private:
  double error(std::size_t channel) { return deviations_.at(channel) * noise_.normal(drawn_++); }

  [[nodiscard]] std::vector<Pair> states(const CandidateMeasurement& candidate, const Outlook& of_record,
                                         const Outlook& of_plan) {
    std::vector<Pair> all = record_.states;
    if (candidate.only_phases) {
      const auto count = static_cast<Index>(all.size());
      for (Index i = 0; i < count; ++i)
        all[static_cast<std::size_t>(i)].phase = of_record.readings[count + i] + error(phase_channel);
      return all;
    }
    const std::vector<Pair> planned = states_of(record_, std::get<std::vector<PlannedState>>(candidate.plan));
    const auto count = static_cast<Index>(planned.size());
    for (Index i = 0; i < count; ++i) {
      Pair state = planned[static_cast<std::size_t>(i)];
      state.x = of_plan.readings[i] + error(0);
      const double late = error(phase_channel);
      state.phase = candidate.phases ? of_plan.readings[count + i] + late : unknown;
      state.number = static_cast<int>(all.size()) + 1;
      all.push_back(state);
    }
    return all;
  }

  void find_rows(const CandidateMeasurement& candidate, const Outlook& of_plan) {
    const auto own = static_cast<Index>(record_.states.size());
    released_ = std::holds_alternative<PlannedDecay>(candidate.plan);
    record_columns_ = released_ ? record_.model.unknowns() : model_->unknowns();
    const Index planned = released_ ? of_plan.readings.size() : of_plan.readings.size() / 2;
    const bool phases = reads_phases(*model_);
    for (Index i = 0; i < own; ++i) rows_.emplace_back(false, i);
    if (!released_ && !candidate.only_phases)
      for (Index i = 0; i < planned; ++i) rows_.emplace_back(true, i);
    if (phases)
      for (Index i = 0; i < own; ++i)
        if (candidate.only_phases || !std::isnan(record_.states[static_cast<std::size_t>(i)].phase))
          rows_.emplace_back(false, own + i);
    if (released_)
      for (Index i = 0; i < planned; ++i) rows_.emplace_back(true, i);
    else if (phases && candidate.phases && !candidate.only_phases)
      for (Index i = 0; i < planned; ++i) rows_.emplace_back(true, planned + i);
  }

  const StudiedRecord& record_;
  std::array<double, 2> deviations_;
  core::RandomStream noise_;
  std::uint64_t drawn_ = 0;
  std::unique_ptr<const ReadingModel> model_;
  bool released_ = false;
  Index record_columns_ = 0;  ///< unknowns of the states of the record
  std::vector<std::pair<bool, Index>>
      rows_;  ///< of each reading: whether it is planned, and its row in the outlook
};

ContinuedRecord::ContinuedRecord(const StudiedRecord& record, const std::vector<Rival>& rivals, const Outlooks& own,
                                 const MeasurementPlan& plan)
    : record_(record), rivals_(rivals), own_(own), plan_(plan) {
  const auto* states = std::get_if<std::vector<PlannedState>>(&plan);
  if (states != nullptr && *states == plan_of(record.states)) {
    planned_ = own;
    return;
  }
  std::unique_ptr<const ReadingModel> block;
  if (states != nullptr) {
    block = planned_states(record.model, states_of(record, *states), record.constants, deviations_of(record));
  } else {
    const auto& decay = std::get<PlannedDecay>(plan);
    block = planned_decay(record.model, decay.release, VectorXd::Zero(decay.extremes), record.constants,
                          deviations_of(record)[0]);
  }
  for (const Rival& rival : rivals) planned_.push_back(outlook_of(*block, rival, states == nullptr));
}

bool ContinuedRecord::possible() const {
  for (std::size_t i = 0; i < rivals_.size(); ++i) {
    const std::size_t best = rivals_[i].probable;
    if (rivals_[i].allowed && rivals_[i].fits[best].severity != 0.0 && !(planned_[i][best] && own_[i][best]))
      return false;
  }
  return planned_.front().front() && own_.front().front();
}

bool ContinuedRecord::is_plain(std::size_t truth) const {
  return rivals_[truth].fits[rivals_[truth].probable].severity == 0.0;
}

std::optional<LawIntervals> ContinuedRecord::answer(const CandidateMeasurement& candidate, std::size_t truth,
                                                    std::uint64_t draw) const {
  const std::size_t best = rivals_[truth].probable;
  // At severity zero each law is plain friction, which is the first rival.
  const bool plain_truth = is_plain(truth);
  const std::size_t of = plain_truth ? 0 : truth;
  const std::size_t at = plain_truth ? 0 : best;
  const Joint joint(record_, candidate, *own_[of][at], *planned_[of][at], draw);
  std::optional<PlainFit> plain = plain_fit(joint.model());
  if (plain) plain = with_law_error(joint.model(), std::move(*plain), record_.law_error);
  if (!plain) return std::nullopt;
  const bool spring_is_free = has_free_spring(joint.model());
  std::vector<LawFits> laws;
  for (std::size_t i = 0; i < rivals_.size(); ++i) {
    const LibraryLaw& law = rivals_[i].law->law;
    if (spring_is_free && law.departure != nullptr && is_of_spring(*law.departure)) continue;
    laws.push_back({law});
    for (std::size_t j = 0; j < rivals_[i].fits.size(); ++j) {
      if (rivals_[i].fits[j].severity == 0.0)
        laws.back().fits.push_back(plain->fit);
      else if (own_[i][j] && planned_[i][j])
        if (auto fit = joint.fit(rivals_[i].fits[j], *own_[i][j], *planned_[i][j], plain->noise))
          laws.back().fits.push_back(std::move(*fit));
    }
  }
  return intervals_of(joint.model(), record_.constants, *plain, laws);
}

}  // namespace dualdamp::identify
