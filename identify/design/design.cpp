#include "identify/design/design.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "core/numbers.hpp"
#include "identify/design/continued_record.hpp"
#include "identify/methods/amplitudes/steady_states.hpp"
#include "identify/methods/any_law/any_law.hpp"
#include "identify/methods/any_law/steady_readings.hpp"
#include "identify/statistics/distributions.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::identify {

namespace {

/// Sizes of the ranges.
struct Widths {
  double hull_zeta = 0.0, hull_F0 = 0.0, average_zeta = 0.0, average_F0 = 0.0;

  void add(const Widths& other) {
    hull_zeta += other.hull_zeta;
    hull_F0 += other.hull_F0;
    average_zeta += other.average_zeta;
    average_F0 += other.average_F0;
  }
};

double width(const Interval& ends) { return ends[1] - ends[0]; }

/// `moved`: deviations of zeta and F0 by the constants.
Widths widths_of(const LawIntervals& laws, const ParameterSet& moved) {
  const double both_sides = 2.0 * normal95();
  return {std::hypot(width(laws.zeta_hull), both_sides * moved.zeta),
          std::hypot(width(laws.F0_hull), both_sides * moved.F0), std::hypot(laws.std.zeta, moved.zeta),
          std::hypot(laws.std.F0, moved.F0)};
}

class Advisor {
 public:
  Advisor(const StudiedRecord& record, const ParameterSet& moved)
      : record_(record), moved_(moved), rivals_(rivals_of(record)), own_(outlooks_of(record, rivals_)) {
    for (const Rival& rival : rivals_) allowed_ += rival.allowed ? 1 : 0;
    // Few truths need several draws of the noise each, so that the mean does not hang on one.
    constexpr std::size_t fewest = 12;
    draws_ = (fewest + allowed_ - 1) / allowed_;
  }

  /// Advice for candidates of the same plan: the engines compute their states, or their release, once.
  [[nodiscard]] std::vector<MeasurementAdvice> advice(std::span<const CandidateMeasurement> same) const {
    const ContinuedRecord continued(record_, rivals_, own_, same.front().plan);
    if (!continued.possible()) return {};
    std::vector<MeasurementAdvice> list;
    for (const CandidateMeasurement& candidate : same)
      if (auto one = advice(candidate, continued)) list.push_back(std::move(*one));
    return list;
  }

 private:
  [[nodiscard]] std::optional<MeasurementAdvice> advice(const CandidateMeasurement& candidate,
                                                        const ContinuedRecord& continued) const {
    const Widths before = widths_of(record_.study.intervals, moved_);
    MeasurementAdvice advice{.candidate = candidate};
    std::map<std::size_t, std::optional<LawIntervals>> shared;
    Widths after;
    double power = 0.0;
    double tests = 0.0;
    double answers = 0.0;
    for (std::size_t truth = 0; truth < rivals_.size(); ++truth) {
      if (!rivals_[truth].allowed) continue;
      Widths own;
      double count = 0.0;
      for (std::size_t draw = 0; draw < draws_; ++draw) {
        // Truths that are plain friction share some draws.
        constexpr std::size_t few = 4;
        const std::size_t number = truth * draws_ + draw;
        const bool plain = continued.is_plain(truth);
        std::optional<LawIntervals> answer;
        if (const auto known = shared.find(number % few); plain && known != shared.end())
          answer = known->second;
        else
          answer = continued.answer(candidate, truth, plain ? number % few : number);
        if (plain) shared.emplace(number % few, answer);
        if (!answer) continue;
        own.add(widths_of(*answer, moved_));
        if (const double share = rejected_share(*answer, truth); !std::isnan(share)) {
          power += share;
          tests += 1.0;
        }
        count += 1.0;
      }
      if (count == 0.0) continue;
      after.add(own);
      answers += count;
      advice.outcomes.push_back({rivals_[truth].law->law.name(),
                                 {own.hull_zeta / count / before.hull_zeta, own.hull_F0 / count / before.hull_F0}});
    }
    if (answers == 0.0) return std::nullopt;
    advice.hull = {after.hull_zeta / answers / before.hull_zeta, after.hull_F0 / answers / before.hull_F0};
    advice.average = {after.average_zeta / answers / before.average_zeta,
                      after.average_F0 / answers / before.average_F0};
    advice.power = power / tests;
    return advice;
  }

  /// Of the laws that the record allows, without the true one: the share that the continued record rejects. A law
  /// that is left out there, since the spring is free, counts as neither. NaN if there is no such law.
  [[nodiscard]] double rejected_share(const LawIntervals& laws, std::size_t truth) const {
    double wrong = 0.0;
    double rejected = 0.0;
    for (std::size_t i = 0; i < rivals_.size(); ++i) {
      if (i == truth || !rivals_[i].allowed) continue;
      const auto answer = std::ranges::find(laws.laws, rivals_[i].law->law.name(), &LawAnswer::name);
      if (answer == laws.laws.end()) continue;
      wrong += 1.0;
      rejected += answer->rejected ? 1.0 : 0.0;
    }
    return rejected / wrong;
  }

  const StudiedRecord& record_;
  ParameterSet moved_;
  std::vector<Rival> rivals_;
  Outlooks own_;
  std::size_t allowed_ = 0;
  std::size_t draws_ = 1;
};

/// The record in one order, so that the advice does not depend on that of the file: by level, then by frequency.
Record in_order(Record record, const KnownConstants& constants) {
  std::ranges::stable_sort(record.pairs->pairs, {}, [&](const Pair& pair) {
    const auto known = [](double value) { return std::isnan(value) ? 0.0 : value; };
    return std::pair(known(pair.Y), known(frequency_of(pair, constants)));
  });
  return record;
}

/// Groups of neighbours in the list with the same plan, which differ only in what they read.
std::vector<std::span<const CandidateMeasurement>> by_plan(std::span<const CandidateMeasurement> candidates) {
  std::vector<std::span<const CandidateMeasurement>> groups;
  for (std::size_t first = 0, end = 0; first < candidates.size(); first = end) {
    while (end < candidates.size() && candidates[end].plan == candidates[first].plan) ++end;
    groups.push_back(candidates.subspan(first, end - first));
  }
  return groups;
}

std::string rounded_percent(double share) { return core::percent(share, 2); }

std::string text_of(const MeasurementAdvice& advice, const LawIntervals& now) {
  const auto half = [](const Interval& ends, double value) { return 0.5 * (ends[1] - ends[0]) / value; };
  const double zeta = half(now.zeta_hull, now.mean.zeta);
  const double F0 = half(now.F0_hull, now.mean.F0);
  const auto between = [&](double Shrinkage::* one, double now) {
    const auto by_law = [one](const LawOutcome& outcome) { return outcome.hull.*one; };
    const auto [least, most] = std::ranges::minmax(advice.outcomes, {}, by_law);
    return " (+-" + rounded_percent(now * by_law(least)) + " to +-" + rounded_percent(now * by_law(most)) +
           " by the true law)";
  };
  constexpr double little = 0.9;
  const bool helps = advice.hull.zeta < little || advice.hull.F0 < little;
  return advice.candidate.name + ": zeta's range goes from +-" + rounded_percent(zeta) + " to +-" +
         rounded_percent(zeta * advice.hull.zeta) + between(&Shrinkage::zeta, zeta) + ", F0's from +-" +
         rounded_percent(F0) + " to +-" + rounded_percent(F0 * advice.hull.F0) + between(&Shrinkage::F0, F0) +
         (std::isnan(advice.power)
              ? ""
              : "; a wrong law is rejected with probability " + rounded_percent(advice.power)) +
         (helps ? "" : "; this hardly helps");
}

}  // namespace

std::variant<Design, std::string> design_after(const Record& measured, const KnownConstants& constants,
                                               const KnownDeviations& known, const LawIntervalOptions& options,
                                               const ParameterSet& moved, const DriveLimits& limits) {
  if (!measured.pairs || measured.pairs->pairs.empty()) return "advice needs a record of steady states";
  const Record record = in_order(measured, constants);
  auto readings = steady_readings(record, constants, known);
  if (const auto* why = std::get_if<std::string>(&readings)) return *why;
  const ReadingModel& model = *std::get<0>(readings);
  std::variant<LawStudy, std::string> found = study_laws(model, constants, options);
  if (const auto* why = std::get_if<std::string>(&found)) return *why;
  const LawStudy& study = std::get<LawStudy>(found);
  Estimate taken;
  const StudiedRecord studied{.states = take_states(record, constants, false, taken).value_or(std::vector<Pair>{}),
                              .model = model,
                              .study = study,
                              .constants = constants,
                              .known = known,
                              .law_error = options.law_error};
  const Advisor advisor(studied, moved);
  Design design{.now = study.intervals};
  widen(moved, design.now);
  Candidates candidates = candidates_after(studied.states, constants, design.now.mean.zeta, limits);
  design.left_out = std::move(candidates.left_out);
  const std::vector<std::span<const CandidateMeasurement>> groups = by_plan(candidates.list);
  std::vector<std::vector<MeasurementAdvice>> advice(groups.size());
  sim::in_parts(groups.size(), 1, 0, [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i) advice[i] = advisor.advice(groups[i]);
  });
  for (std::vector<MeasurementAdvice>& group : advice) {
    for (MeasurementAdvice& one : group) {
      one.text = text_of(one, design.now);
      design.advice.push_back(std::move(one));
    }
  }
  if (design.advice.empty()) return "no law that the record allows has steady states under any candidate";
  std::ranges::stable_sort(design.advice, {},
                           [](const MeasurementAdvice& one) { return one.hull.zeta * one.hull.F0; });
  return design;
}

}  // namespace dualdamp::identify
