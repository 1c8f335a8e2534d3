#include "bench/score/scores.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>

#include "bench/score/resample.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::bench {

namespace {

constexpr double significant = 2.0;  // standard errors

double percentile_50(std::vector<double> values) {
  if (values.empty()) return not_stated;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Standard deviation over resamples of what exists in most of them.
class Spread {
 public:
  void add(double value) {
    if (std::isnan(value)) return;
    ++count_;
    const double step = value - mean_;
    mean_ += step / static_cast<double>(count_);
    squares_ += step * (value - mean_);
  }
  [[nodiscard]] double se() const {
    return 2 * count_ >= resamples ? std::sqrt(squares_ / static_cast<double>(count_ - 1)) : not_stated;
  }

 private:
  std::size_t count_ = 0;
  double mean_ = 0.0, squares_ = 0.0;
};

/// Standard errors of several metrics.
class Spreads {
 public:
  void add(const Metrics& metrics) {
    for (std::size_t i = 0; i < metric_count; ++i) spreads_[i].add(metrics.values[i]);
    interval_score_.add(metrics.interval_score());
  }
  [[nodiscard]] Metrics se() const {
    Metrics result;
    for (std::size_t i = 0; i < metric_count; ++i) result.values[i] = spreads_[i].se();
    return result;
  }
  [[nodiscard]] double interval_score_se() const { return interval_score_.se(); }

 private:
  std::array<Spread, metric_count> spreads_;
  Spread interval_score_;
};

/// What does not depend on the resample: the cells, and the cases in the order of each method's confidence.
class Plan {
 public:
  Plan(const MarkedCases& cases, const Grid& grid) : cases_(cases), grid_(grid) {
    const StressTest& question = grid.question();
    cases_of_.resize(grid.cells());
    cell_of_.resize(grid.cases());
    for (std::size_t number = 0; number < grid.cases(); ++number) {
      const Grid::Case place = grid.at(number);
      const Grid::Motion motion = grid.motion(place.motion);
      const std::size_t cell = grid.cell_of(motion, place.sensors);
      cases_of_[cell].push_back(static_cast<std::uint32_t>(number));
      cell_of_[number] = static_cast<std::uint32_t>(cell);
    }
    for (std::size_t cell = 0; cell < grid.cells(); ++cell) {
      const Grid::Motion motion = grid.motion(grid.first_of_cell(cell).motion);
      law_of_.push_back(static_cast<std::size_t>(std::ranges::find(question.departures, motion.departure) -
                                                 question.departures.begin()));
      family_of_.push_back(motion.departure.family());
    }
    order_.resize(question.entrants());
    for (std::size_t entrant = 0; entrant < order_.size(); ++entrant) {
      order_[entrant].resize(grid.cases());
      std::iota(order_[entrant].begin(), order_[entrant].end(), 0U);
      std::ranges::stable_sort(order_[entrant], std::ranges::greater{},
                               [&](std::uint32_t number) { return cases.marks[entrant][number].confidence; });
    }
  }

  [[nodiscard]] const Mark& mark(std::size_t entrant, std::size_t number) const {
    return cases_.marks[entrant][number];
  }
  [[nodiscard]] const CaseConsequence& consequence(std::size_t number) const {
    return cases_.consequences[number / static_cast<std::size_t>(grid_.question().seeds)];
  }
  [[nodiscard]] const Grid& grid() const { return grid_; }
  [[nodiscard]] const std::vector<std::uint32_t>& cases_of(std::size_t cell) const { return cases_of_[cell]; }
  /// All cases by falling confidence.
  [[nodiscard]] const std::vector<std::uint32_t>& order(std::size_t entrant) const { return order_[entrant]; }
  [[nodiscard]] std::size_t cell_of(std::size_t number) const { return cell_of_[number]; }
  [[nodiscard]] std::size_t law_of(std::size_t cell) const { return law_of_[cell]; }
  [[nodiscard]] Family family_of(std::size_t cell) const { return family_of_[cell]; }

 private:
  const MarkedCases& cases_;
  const Grid& grid_;
  std::vector<std::vector<std::uint32_t>> cases_of_;
  std::vector<std::vector<std::uint32_t>> order_;
  std::vector<std::uint32_t> cell_of_;
  std::vector<std::size_t> law_of_;
  std::vector<Family> family_of_;
};

void add_parameter(const ParameterMark& mark, double weight, Mean& coverage, Mean& score) {
  if (mark.has_interval) coverage.add(weight, mark.covers ? 1.0 : 0.0);
  score.add(weight, static_cast<double>(mark.score));
}

/// All but the area of risk, of one method in one cell.
Metrics cell_metrics(const Plan& plan, const std::vector<double>& weights, std::size_t cell, std::size_t entrant) {
  std::array<Mean, metric_count> means;
  const auto mean = [&](Metric metric) -> Mean& { return means[static_cast<std::size_t>(metric)]; };
  const bool is_truth = plan.family_of(cell) == Family::none;
  for (const std::uint32_t number : plan.cases_of(cell)) {
    const double weight = weights[number];
    if (weight == 0.0) continue;
    const Mark& mark = plan.mark(entrant, number);
    add_parameter(mark.zeta, weight, mean(Metric::coverage_zeta), mean(Metric::interval_score_zeta));
    add_parameter(mark.F0, weight, mean(Metric::coverage_F0), mean(Metric::interval_score_F0));
    mean(is_truth ? Metric::false_alarm : Metric::power).add(weight, mark.rejected ? 1.0 : 0.0);
    mean(Metric::prediction_error).add(weight, static_cast<double>(mark.prediction_error));
    if (!is_truth) mean(Metric::attainable_power).add(weight, plan.consequence(number).attainable_power);
  }
  Metrics metrics;
  for (std::size_t i = 0; i < metric_count; ++i) metrics.values[i] = means[i].value();
  return metrics;
}

/// Error statistics of one method in one cell.
void describe_errors(const Plan& plan, CellScore& score) {
  std::vector<double> zeta, F0;
  Mean zeta_bias, F0_bias, distance, harm;
  for (const std::uint32_t number : plan.cases_of(score.cell)) {
    const Mark& mark = plan.mark(score.entrant, number);
    ++score.cases;
    if (mark.given) ++score.estimates;
    distance.add(1.0, plan.consequence(number).distance);
    harm.add(1.0, plan.consequence(number).harm);
    for (const auto& [parameter, list, bias] :
         {std::tuple(&mark.zeta, &zeta, &zeta_bias), std::tuple(&mark.F0, &F0, &F0_bias)}) {
      if (!mark.given || std::isnan(parameter->error)) continue;
      bias->add(1.0, static_cast<double>(parameter->error));
      list->push_back(std::abs(static_cast<double>(parameter->error)));
    }
  }
  score.zeta_bias = zeta_bias.value();
  score.F0_bias = F0_bias.value();
  score.zeta_error = percentile_50(std::move(zeta));
  score.F0_error = percentile_50(std::move(F0));
  score.distance = distance.value();
  score.harm = harm.value();
}

using FamilyMetrics = std::map<Family, Metrics>;

/// One resample of one method: its cells, its families, and all of them.
struct Aggregate {
  std::vector<Metrics> cells;
  FamilyMetrics families;
  Metrics all;
};

/// Weights of the cases, and of the cells within their families: departures alike, and cells of a departure alike.
struct Weights {
  std::vector<double> cases;
  std::vector<double> cells;  ///< sums of the weights of their cases
  std::vector<double> in_family;
};

Weights weights_of(const Plan& plan, const Resample& resample) {
  const std::size_t laws = plan.grid().question().departures.size();
  Weights weights;
  weights.cases = resample.case_weights(plan.grid());
  std::map<Family, double> sums;
  for (std::size_t cell = 0; cell < plan.grid().cells(); ++cell) {
    const std::size_t law = plan.law_of(cell);
    weights.in_family.push_back(law == laws ? 1.0 : resample.law_weight(law));
    double sum = 0.0;
    for (const std::uint32_t number : plan.cases_of(cell)) sum += weights.cases[number];
    weights.cells.push_back(sum);
    if (sum > 0.0) sums[plan.family_of(cell)] += weights.in_family.back();
  }
  for (std::size_t cell = 0; cell < plan.grid().cells(); ++cell)
    weights.in_family[cell] /= std::max(sums[plan.family_of(cell)], 1e-300);
  return weights;
}

/// An area of risk, and the confidence of its last case.
struct OpenArea {
  RiskArea area;
  float confidence = std::numeric_limits<float>::quiet_NaN();

  void add(const Mark& mark, double weight) {
    if (mark.confidence != confidence) area.end_group();
    confidence = mark.confidence;
    area.add(weight, static_cast<double>(mark.loss));
  }
  [[nodiscard]] double close() {
    area.end_group();
    return area.area();
  }
};

/// Areas of risk of cells, families and all, in one walk over all cases.
void add_areas(const Plan& plan, const Weights& weights, std::size_t entrant, Aggregate& aggregate) {
  std::map<Family, OpenArea> families;
  std::vector<OpenArea> cells(plan.grid().cells());
  std::vector<OpenArea*> family_of;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) family_of.push_back(&families[plan.family_of(cell)]);
  OpenArea all;
  for (const std::uint32_t number : plan.order(entrant)) {
    const double weight = weights.cases[number];
    if (weight == 0.0) continue;
    const Mark& mark = plan.mark(entrant, number);
    const std::size_t cell = plan.cell_of(number);
    cells[cell].add(mark, weight);
    if (weights.in_family[cell] == 0.0) continue;
    const double share = weight * weights.in_family[cell] / weights.cells[cell];
    family_of[cell]->add(mark, share);
    all.add(mark, share);
  }
  constexpr Metric metric = Metric::selective_risk_area;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) aggregate.cells[cell][metric] = cells[cell].close();
  for (auto& [family, metrics] : aggregate.families) metrics[metric] = families[family].close();
  aggregate.all[metric] = all.close();
}

Aggregate aggregate_of(const Plan& plan, const Weights& weights, std::size_t entrant) {
  Aggregate result;
  std::map<Family, std::array<Mean, metric_count>> means;
  for (std::size_t cell = 0; cell < plan.grid().cells(); ++cell) {
    const Metrics& metrics = result.cells.emplace_back(cell_metrics(plan, weights.cases, cell, entrant));
    if (weights.in_family[cell] == 0.0 || weights.cells[cell] == 0.0) continue;
    std::array<Mean, metric_count>& family = means[plan.family_of(cell)];
    for (std::size_t i = 0; i < metric_count; ++i) family[i].add(weights.in_family[cell], metrics.values[i]);
  }
  std::array<Mean, metric_count> all;
  for (const auto& [family, list] : means) {
    Metrics& metrics = result.families[family];
    for (std::size_t i = 0; i < metric_count; ++i) {
      metrics.values[i] = list[i].value();
      all[i].add(1.0, metrics.values[i]);
    }
  }
  for (std::size_t i = 0; i < metric_count; ++i) result.all.values[i] = all[i].value();
  add_areas(plan, weights, entrant, result);
  return result;
}

/// By resample, method.
using Aggregates = std::vector<std::vector<Aggregate>>;

Aggregates aggregates_of(const Plan& plan, const std::vector<Resample>& draws) {
  const std::size_t entrants = plan.grid().question().entrants();
  Aggregates result(draws.size());
  sim::in_parts(draws.size(), 1, 0, [&](std::size_t i, std::size_t) {
    const Weights weights = weights_of(plan, draws[i]);
    for (std::size_t entrant = 0; entrant < entrants; ++entrant)
      result[i].push_back(aggregate_of(plan, weights, entrant));
  });
  return result;
}

std::vector<CellScore> cell_scores(const Plan& plan, const Aggregates& aggregates) {
  const std::size_t entrants = aggregates.front().size();
  std::vector<CellScore> result(plan.grid().cells() * entrants);
  sim::in_parts(result.size(), 1, 0, [&](std::size_t number, std::size_t) {
    CellScore& score = result[number];
    score.cell = number / entrants;
    score.entrant = number % entrants;
    describe_errors(plan, score);
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
        const FamilyMetrics& families = aggregates[i][entrant].families;
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

}  // namespace

Scores score(const MarkedCases& cases, const Grid& grid) {
  const Plan plan(cases, grid);
  std::vector<Resample> draws;
  for (std::size_t i = 0; i <= resamples; ++i) draws.emplace_back(grid, i);
  Scores result;
  result.failed_cases = cases.failed_cases;
  const Aggregates aggregates = aggregates_of(plan, draws);
  result.cells = cell_scores(plan, aggregates);
  result.families = family_scores(aggregates);
  result.differences = differences_of(aggregates);
  result.ranking = ranking_of(aggregates, result.differences);
  return result;
}

}  // namespace dualdamp::bench
