#include "bench/mechanisms/study.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bench/mechanisms/answer.hpp"
#include "core/constants.hpp"
#include "identify/methods/decays/free_decay.hpp"
#include "sim/motion/free_decay.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::bench {

namespace {

/// The whole study; its parts are independent and are computed in parallel.
class Study {
 public:
  Study(const MechanismStudy& study, const sim::Model& model, Levels levels)
      : study_(study),
        levels_(std::move(levels)),
        apparatus_(apparatus_of(model, levels_)),
        constants_{apparatus_.oscillator.mass, apparatus_.oscillator.stiffness, apparatus_.reference.frequency} {
    for (const Departure* mechanism : study_.mechanisms)
      searches_.emplace_back(*mechanism, study_, apparatus_, levels_);
  }

  [[nodiscard]] std::vector<Explanation> explain() const;
  [[nodiscard]] std::vector<Effect> effects() const;

 private:
  static Apparatus apparatus_of(const sim::Model& model, const Levels& levels);
  [[nodiscard]] std::vector<MechanismFit> rough_fits() const;
  void finish(Explanation& explanation) const;
  [[nodiscard]] std::optional<DecayReading> decay(const Explanation& explanation) const;
  [[nodiscard]] double misfit(const std::vector<PartReading>& readings) const;
  [[nodiscard]] double stretch(const Explanation& explanation) const;

  const MechanismStudy& study_;
  Levels levels_;
  Apparatus apparatus_;
  identify::KnownConstants constants_;
  std::vector<MechanismSearch> searches_;
};

Apparatus Study::apparatus_of(const sim::Model& model, const Levels& levels) {
  // In a steady state slow warming depends only on the mean power; a time constant of five periods gives four
  // digits.
  constexpr double warming_periods = 5.0;
  const std::size_t middle = levels.Y.size() / 2;
  const double frequency = model.excitation.frequency;
  return {.oscillator = model.oscillator,
          .reference = {.amplitude = levels.x[middle], .frequency = frequency, .Y = levels.Y[middle]},
          .warming_time = warming_periods * core::two_pi / frequency};
}

/// The best of all starts of each mechanism.
std::vector<MechanismFit> Study::rough_fits() const {
  std::vector<std::pair<std::size_t, std::size_t>> tasks;
  for (std::size_t i = 0; i < searches_.size(); ++i)
    for (std::size_t start = 0; start < searches_[i].starts(); ++start) tasks.emplace_back(i, start);
  std::vector<MechanismFit> fits(tasks.size());
  sim::in_parts(tasks.size(), 1, 0, [&](std::size_t first, std::size_t) {
    fits[first] = searches_[tasks[first].first].begin(tasks[first].second);
  });
  std::vector<MechanismFit> best(searches_.size());
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    MechanismFit& held = best[tasks[t].first];
    const bool is_first = tasks[t].second == 0;
    if (is_first || (fits[t].outcome.ok() && (!held.outcome.ok() || fits[t].chi2 < held.chi2)))
      held = std::move(fits[t]);
  }
  return best;
}

double Study::misfit(const std::vector<PartReading>& readings) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    largest = std::max(largest, std::abs(readings[i].zeta / study_.estimates[i].zeta - 1.0));
    largest = std::max(largest, std::abs(readings[i].F0 / study_.estimates[i].F0 - 1.0));
  }
  return largest;
}

/// Stretch relative to the nearest plausible values.
double Study::stretch(const Explanation& explanation) const {
  double least = core::infinity;
  for (const PlausibleRig& plausible : study_.plausible) {
    if (plausible.mechanism != explanation.mechanism) continue;
    double largest = 1.0;
    for (std::size_t i = 0; i < plausible.values.size(); ++i) {
      const double ratio = explanation.fit.values[i] / plausible.values[i];
      largest = std::max(largest, ratio > 0.0 ? std::max(ratio, 1.0 / ratio) : core::infinity);
    }
    least = std::min(least, largest);
  }
  return least;
}

/// Decay of the fitted rig on the spring of the decay, cold, released from rest.
std::optional<DecayReading> Study::decay(const Explanation& explanation) const {
  const MeasuredDecay& measured = *study_.decay;
  Apparatus cold = apparatus_;
  cold.warming_time = Apparatus{}.warming_time;
  const sim::Model model = released(*explanation.mechanism, cold, explanation.fit.friction, explanation.fit.values,
                                    measured.stiffness, measured.displacement);
  constexpr int extremes = 5;
  const sim::FreeDecay motion = sim::free_decay(model, extremes);
  if (!motion.outcome.ok() || motion.extremes.size() < extremes) return std::nullopt;
  identify::KnownConstants constants = constants_;
  constants.stiffness = measured.stiffness;
  const auto segment = [&](std::size_t first) -> std::optional<MeasuredDecay::Segment> {
    identify::Record record;
    record.decay.emplace();
    for (std::size_t i = first; i < first + extremes - 1; ++i) {
      record.decay->extremes.push_back(motion.extremes[i].x);
      record.decay->times.push_back(motion.extremes[i].t);
    }
    const identify::Estimate estimate = identify::free_decay(record, constants, {});
    if (!estimate.outcome.ok()) return std::nullopt;
    return MeasuredDecay::Segment{estimate.value.zeta, estimate.value.x_f};
  };
  const auto high = segment(0);
  const auto low = segment(1);
  if (!high || !low) return std::nullopt;
  return DecayReading{*high, *low};
}

void Study::finish(Explanation& explanation) const {
  if (!explanation.fit.outcome.ok()) return;
  explanation.misfit = misfit(explanation.fit.readings);
  explanation.stretch = stretch(explanation);
  if (study_.decay) explanation.decay = decay(explanation);
  // A curve for the chart: the range of the levels and a little more.
  constexpr std::size_t points = 31;
  const std::vector<double>& Y = explanation.fit.levels.Y;
  const double margin = 0.1 * (Y.back() - Y.front());
  for (std::size_t i = 0; i < points; ++i) {
    const double input =
        Y.front() - margin + (Y.back() - Y.front() + 2.0 * margin) * static_cast<double>(i) / (points - 1);
    const auto output =
        response(*explanation.mechanism, apparatus_, explanation.fit.friction, explanation.fit.values, {input});
    if (!output) continue;
    explanation.curve.Y.push_back(input);
    explanation.curve.x.push_back(output->x.front());
  }
}

/// Finds fits that differ from one another by less than the standard errors of the estimates.
void find_aliases(std::vector<Explanation>& explanations, const MechanismStudy& study) {
  const auto distance = [&](const Explanation& a, const Explanation& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < study.estimates.size(); ++i) {
      const PartEstimate& estimate = study.estimates[i];
      sum += std::pow((a.fit.readings[i].zeta - b.fit.readings[i].zeta) / estimate.zeta_std, 2);
      sum += std::pow((a.fit.readings[i].F0 - b.fit.readings[i].F0) / estimate.F0_std, 2);
    }
    return sum;
  };
  for (Explanation& a : explanations)
    for (const Explanation& b : explanations)
      if (&a != &b && a.fit.outcome.ok() && b.fit.outcome.ok() &&
          distance(a, b) <= static_cast<double>(2 * study.estimates.size()))
        a.aliases.emplace_back(b.mechanism->name);
}

std::vector<Explanation> Study::explain() const {
  const std::vector<MechanismFit> rough = rough_fits();
  std::vector<Explanation> explanations(searches_.size());
  sim::in_parts(searches_.size(), 1, 0, [&](std::size_t first, std::size_t) {
    Explanation& explanation = explanations[first];
    explanation.mechanism = study_.mechanisms[first];
    explanation.unknowns = searches_[first].unknowns();
    explanation.fit = searches_[first].refine(rough[first]);
    finish(explanation);
  });
  find_aliases(explanations, study_);
  std::ranges::stable_sort(explanations, {}, [](const Explanation& explanation) {
    return std::pair(!explanation.fit.outcome.ok(), explanation.fit.chi2);
  });
  return explanations;
}

std::vector<Effect> Study::effects() const {
  std::vector<Effect> effects(study_.plausible.size());
  sim::in_parts(effects.size(), 1, 0, [&](std::size_t first, std::size_t) {
    const PlausibleRig& plausible = study_.plausible[first];
    Effect& effect = effects[first];
    effect.rig = &plausible;
    effect.response = response(*plausible.mechanism, apparatus_, study_.friction, plausible.values, levels_.Y);
    if (effect.response) effect.readings = read_parts({levels_.Y, effect.response->x}, study_, constants_);
  });
  return effects;
}

}  // namespace

scenarios::Answer run_mechanism_study(const MechanismStudy& study, const sim::Model& model) {
  const std::optional<Levels> levels =
      reconstruct(study, {model.oscillator.mass, model.oscillator.stiffness, model.excitation.frequency});
  if (!levels)
    return scenarios::failed(
        "no levels give these estimates to their standard errors: straight lines cannot have had them");
  const Study whole(study, model, *levels);
  const StudyAnswer found{*levels, whole.explain(), whole.effects()};
  scenarios::Answer answer;
  answer.result = result_of(found, study);
  answer.tables = tables_of(found, study);
  return answer;
}

}  // namespace dualdamp::bench
