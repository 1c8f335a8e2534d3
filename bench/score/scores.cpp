#include "bench/score/scores.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "bench/score/aggregate.hpp"
#include "bench/score/spread.hpp"
#include "identify/statistics/median.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::bench {

namespace {

constexpr double significant = 2.0;  // standard errors

double upper_median_error(std::vector<double> values) {
  return values.empty() ? not_stated : identify::upper_median(std::move(values));
}

/// Error statistics of one method in one cell.
void describe_errors(const Plan& plan, const std::vector<std::size_t>& groups, CellScore& score) {
  std::vector<double> zeta, F0;
  Mean zeta_bias, F0_bias, distance, harm;
  for (const std::size_t group : groups) {
    distance.add(1.0, plan.consequence(group).distance);
    harm.add(1.0, plan.consequence(group).harm);
    for (std::size_t number = group * plan.seeds(); number < (group + 1) * plan.seeds(); ++number) {
      const Mark& mark = plan.mark(score.entrant, number);
      ++score.cases;
      if (mark.given) ++score.estimates;
      for (const auto& [parameter, list, bias] :
           {std::tuple(&mark.zeta, &zeta, &zeta_bias), std::tuple(&mark.F0, &F0, &F0_bias)}) {
        if (!mark.given || std::isnan(parameter->error)) continue;
        bias->add(1.0, static_cast<double>(parameter->error));
        list->push_back(std::abs(static_cast<double>(parameter->error)));
      }
    }
  }
  score.zeta_bias = zeta_bias.value();
  score.F0_bias = F0_bias.value();
  score.zeta_error = upper_median_error(std::move(zeta));
  score.F0_error = upper_median_error(std::move(F0));
  score.distance = distance.value();
  score.harm = harm.value();
}

/// Aggregates by resample, method.
using Aggregates = std::vector<std::vector<Aggregate>>;

Aggregates all_aggregates(const Plan& plan) {
  Aggregates result(resamples + 1);
  sim::in_parts(result.size(), 1, 0,
                [&](std::size_t i, std::size_t) { result[i] = aggregates_of(plan, Resample(plan.grid(), i)); });
  return result;
}

std::vector<CellScore> cell_scores(const Plan& plan, const Aggregates& aggregates) {
  const std::size_t entrants = aggregates.front().size();
  std::vector<CellScore> result(plan.grid().cells() * entrants);
  std::vector<std::vector<std::size_t>> groups(plan.grid().cells());
  for (std::size_t group = 0; group < plan.groups().size(); ++group)
    groups[plan.groups()[group].cell].push_back(group);
  sim::in_parts(result.size(), 1, 0, [&](std::size_t number, std::size_t) {
    CellScore& score = result[number];
    score.cell = number / entrants;
    score.entrant = number % entrants;
    describe_errors(plan, groups[score.cell], score);
    score.value = aggregates.front()[score.entrant].cells[score.cell];
    Spreads spreads;
    for (std::size_t i = 1; i < aggregates.size(); ++i) spreads.add(aggregates[i][score.entrant].cells[score.cell]);
    score.se = spreads.se();
  });
  return result;
}

std::vector<FamilyScore> family_scores(const Aggregates& aggregates) {
  std::vector<FamilyScore> result;
  for (const auto& [family, unused] : aggregates.front().front().families) {
    for (std::size_t entrant = 0; entrant < aggregates.front().size(); ++entrant) {
      FamilyScore score;
      score.family = family;
      score.entrant = entrant;
      score.value = aggregates.front()[entrant].families.at(family);
      Spreads spreads;
      for (std::size_t i = 1; i < aggregates.size(); ++i) {
        const std::map<Family, Metrics>& families = aggregates[i][entrant].families;
        if (const auto found = families.find(family); found != families.end()) spreads.add(found->second);
      }
      score.se = spreads.se();
      result.push_back(score);
    }
  }
  return result;
}

std::vector<Difference> differences_of(const Aggregates& aggregates) {
  std::vector<Difference> result;
  const std::size_t entrants = aggregates.front().size();
  const auto score = [&](std::size_t i, std::size_t entrant) {
    return aggregates[i][entrant].all.interval_score();
  };
  for (std::size_t a = 0; a < entrants; ++a) {
    for (std::size_t b = a + 1; b < entrants; ++b) {
      Difference difference{a, b, score(0, b) - score(0, a)};
      if (std::isnan(difference.value)) continue;
      if (difference.value < 0.0) difference = {b, a, -difference.value};
      Spread spread;
      for (std::size_t i = 1; i < aggregates.size(); ++i)
        spread.add(score(i, difference.worse) - score(i, difference.better));
      difference.se = spread.se();
      difference.is_significant = difference.value > significant * difference.se;
      result.push_back(difference);
    }
  }
  return result;
}

std::vector<Rank> ranking_of(const Aggregates& aggregates, const std::vector<Difference>& differences) {
  std::vector<Rank> result;
  const auto entrants = static_cast<int>(aggregates.front().size());
  for (std::size_t entrant = 0; entrant < aggregates.front().size(); ++entrant) {
    Rank rank;
    rank.entrant = entrant;
    rank.value = aggregates.front()[entrant].all;
    rank.interval_score = rank.value.interval_score();
    Spreads spreads;
    for (std::size_t i = 1; i < aggregates.size(); ++i) spreads.add(aggregates[i][entrant].all);
    rank.se = spreads.se();
    rank.interval_score_se = spreads.interval_score_se();
    rank.to = entrants;
    for (const Difference& difference : differences) {
      if (!difference.is_significant) continue;
      if (difference.worse == entrant) ++rank.from;
      if (difference.better == entrant) --rank.to;
    }
    result.push_back(rank);
  }
  std::ranges::stable_sort(result, [](const Rank& a, const Rank& b) {
    return a.interval_score < b.interval_score || (!std::isnan(a.interval_score) && std::isnan(b.interval_score));
  });
  return result;
}

/// Departures and cases of an interval.
void count_cases(const Plan& plan, std::size_t axis, std::size_t interval, ConsequenceScore& score) {
  std::set<std::size_t> departures;
  for (const Plan::Group& group : plan.groups()) {
    if (group.intervals[axis] != interval || group.departure == plan.grid().question().departures.size()) continue;
    departures.insert(group.departure);
    score.cases += static_cast<int>(plan.seeds());
  }
  score.departures = static_cast<int>(departures.size());
}

std::vector<ConsequenceScore> scores_by_consequence(const Plan& plan, const Aggregates& aggregates) {
  std::vector<ConsequenceScore> result;
  for (std::size_t axis = 0; axis < consequence_axes().size(); ++axis) {
    const ConsequenceAxis& cut = consequence_axes()[axis];
    for (std::size_t interval = 0; interval < cut.intervals(); ++interval) {
      ConsequenceScore score;
      count_cases(plan, axis, interval, score);
      if (score.cases == 0) continue;
      score.axis = cut.name;
      score.from = cut.edges[interval];
      score.to = interval + 1 < cut.intervals() ? cut.edges[interval + 1] : not_stated;
      for (score.entrant = 0; score.entrant < aggregates.front().size(); ++score.entrant) {
        score.value = aggregates.front()[score.entrant].intervals[axis][interval];
        Spreads spreads;
        for (std::size_t i = 1; i < aggregates.size(); ++i)
          spreads.add(aggregates[i][score.entrant].intervals[axis][interval]);
        score.se = spreads.se();
        result.push_back(score);
      }
    }
  }
  return result;
}

}  // namespace

Scores score(const MarkedCases& cases, const Grid& grid) {
  const Plan plan(cases, grid);
  Scores result;
  result.failed_cases = cases.failed_cases;
  const Aggregates aggregates = all_aggregates(plan);
  result.cells = cell_scores(plan, aggregates);
  result.families = family_scores(aggregates);
  result.differences = differences_of(aggregates);
  result.by_consequence = scores_by_consequence(plan, aggregates);
  result.ranking = ranking_of(aggregates, result.differences);
  return result;
}

}  // namespace dualdamp::bench
