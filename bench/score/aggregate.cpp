#include "bench/score/aggregate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dualdamp::bench {

namespace {

/// Weights of cases, cells and departures.
struct Weights {
  std::vector<double> cases;
  std::vector<double> cells;       ///< sums of the weights of their cases
  std::vector<double> departures;  ///< and then of the truth
  /// Of the cells in the area of risk of their family: equal for departures, and for the cells of each; 0 for cells
  /// without a loss.
  std::vector<double> of_risk;
};

/// Whether the cases of a cell have a loss: there is a true zeta or F0.
bool has_loss(const Plan& plan, std::size_t cell) {
  const Grid& grid = plan.grid();
  return grid.parameters(grid.motion(grid.first_of_cell(cell).motion)).is_given();
}

/// `Weights::of_risk` from the others.
std::vector<double> weights_of_risk(const Plan& plan, const Weights& weights) {
  std::vector<double> shares(weights.cells.size(), 0.0);
  std::vector<double> members(weights.departures.size(), 0.0);
  const auto counts = [&](std::size_t cell) { return weights.cells[cell] > 0.0 && has_loss(plan, cell); };
  for (std::size_t cell = 0; cell < shares.size(); ++cell)
    if (counts(cell)) members[plan.departure_of(cell)] += 1.0;
  std::map<Family, double> sums;
  for (std::size_t cell = 0; cell < shares.size(); ++cell) {
    if (!counts(cell)) continue;
    shares[cell] = weights.departures[plan.departure_of(cell)] / members[plan.departure_of(cell)];
    sums[plan.families()[cell]] += shares[cell];
  }
  for (std::size_t cell = 0; cell < shares.size(); ++cell)
    if (shares[cell] > 0.0) shares[cell] /= sums[plan.families()[cell]];
  return shares;
}

Weights weights_of(const Plan& plan, const Resample& resample) {
  Weights weights;
  weights.cases = resample.case_weights(plan.grid());
  for (std::size_t i = 0; i < plan.grid().question().departures.size(); ++i)
    weights.departures.push_back(resample.departure_weight(i));
  weights.departures.push_back(1.0);
  weights.cells.assign(plan.grid().cells(), 0.0);
  for (std::size_t number = 0; number < weights.cases.size(); ++number)
    weights.cells[plan.groups()[plan.group_of(number)].cell] += weights.cases[number];
  weights.of_risk = weights_of_risk(plan, weights);
  return weights;
}

std::vector<MetricMeans> group_means(const Plan& plan, const Weights& weights, std::size_t entrant) {
  std::vector<MetricMeans> means(plan.groups().size());
  const std::size_t truth = plan.grid().question().departures.size();
  for (std::size_t group = 0; group < means.size(); ++group) {
    const bool is_truth = plan.groups()[group].departure == truth;
    const double attainable = plan.consequence(group).attainable_power;
    for (std::size_t number = group * plan.seeds(); number < (group + 1) * plan.seeds(); ++number)
      if (weights.cases[number] > 0.0)
        means[group].add(plan.mark(entrant, number), weights.cases[number], is_truth, attainable);
  }
  return means;
}

/// The means over the departures of each family. `metrics`: of the departures, then perhaps of the truth.
std::map<Family, Metrics> over_departures(const Plan& plan, const Weights& weights,
                                          const std::vector<Metrics>& metrics) {
  const std::vector<CaseDeparture>& departures = plan.grid().question().departures;
  std::map<Family, MetricMeans> means;
  for (std::size_t i = 0; i < metrics.size(); ++i)
    if (weights.departures[i] > 0.0)
      means[i < departures.size() ? departures[i].family() : Family::none].add(weights.departures[i], metrics[i]);
  std::map<Family, Metrics> families;
  for (const auto& [family, mean] : means) families[family] = mean.value();
  return families;
}

Metrics over_families(const std::map<Family, Metrics>& families) {
  MetricMeans all;
  for (const auto& [family, metrics] : families) all.add(1.0, metrics);
  return all.value();
}

/// Metrics of one interval of an axis: groups are added up within departures, and departures are averaged within
/// families.
Metrics interval_metrics(const Plan& plan, const Weights& weights, const std::vector<MetricMeans>& groups,
                         std::size_t axis, std::size_t interval) {
  std::vector<MetricMeans> sums(plan.grid().question().departures.size());
  for (std::size_t group = 0; group < groups.size(); ++group) {
    const Plan::Group& place = plan.groups()[group];
    if (place.departure < sums.size() && place.intervals[axis] == interval)
      sums[place.departure].add(groups[group]);
  }
  std::vector<Metrics> departures;
  for (const MetricMeans& sum : sums) departures.push_back(sum.value());
  return over_families(over_departures(plan, weights, departures));
}

/// An area of risk under construction, and the confidence of its last case.
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

/// Adds the areas of risk of cells, families and all cases, in one pass over all cases.
void add_areas(const Plan& plan, const Weights& weights, std::size_t entrant, Aggregate& aggregate) {
  std::map<Family, OpenArea> families;
  std::vector<OpenArea> cells(plan.grid().cells());
  std::vector<OpenArea*> family_of;
  for (const Family family : plan.families()) family_of.push_back(&families[family]);
  OpenArea all;
  for (const std::uint32_t number : plan.order(entrant)) {
    const double weight = weights.cases[number];
    if (weight == 0.0) continue;
    const Mark& mark = plan.mark(entrant, number);
    const std::size_t cell = plan.groups()[plan.group_of(number)].cell;
    if (std::isnan(mark.loss)) continue;
    cells[cell].add(mark, weight);
    if (weights.of_risk[cell] == 0.0) continue;
    const double share = weight * weights.of_risk[cell] / weights.cells[cell];
    family_of[cell]->add(mark, share);
    all.add(mark, share);
  }
  constexpr Metric metric = Metric::selective_risk_area;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) aggregate.cells[cell][metric] = cells[cell].close();
  for (auto& [family, metrics] : aggregate.families) metrics[metric] = families[family].close();
  aggregate.all[metric] = all.close();
}

Aggregate aggregate_of(const Plan& plan, const Weights& weights, std::size_t entrant) {
  const std::vector<MetricMeans> groups = group_means(plan, weights, entrant);
  std::vector<MetricMeans> cells(plan.grid().cells());
  for (std::size_t group = 0; group < groups.size(); ++group) cells[plan.groups()[group].cell].add(groups[group]);
  Aggregate result;
  std::vector<MetricMeans> means(weights.departures.size());
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    result.cells.push_back(cells[cell].value());
    means[plan.departure_of(cell)].add(1.0, result.cells.back());
  }
  std::vector<Metrics> departures;
  for (const MetricMeans& mean : means) departures.push_back(mean.value());
  result.families = over_departures(plan, weights, departures);
  result.all = over_families(result.families);
  add_areas(plan, weights, entrant, result);
  for (std::size_t axis = 0; axis < consequence_axes().size(); ++axis) {
    std::vector<Metrics>& list = result.intervals.emplace_back();
    for (std::size_t interval = 0; interval < consequence_axes()[axis].intervals(); ++interval)
      list.push_back(interval_metrics(plan, weights, groups, axis, interval));
  }
  return result;
}

}  // namespace

std::size_t ConsequenceAxis::interval_of(double at) const {
  const auto above = std::ranges::upper_bound(edges, at);  // NaN: the end
  if (std::isnan(at) || above == edges.begin()) return edges.size();
  return static_cast<std::size_t>(above - edges.begin()) - 1;
}

const std::vector<ConsequenceAxis>& consequence_axes() {
  static const std::vector<ConsequenceAxis> axes = {
      {"distance", &CaseConsequence::distance, {0.0, 1.0, 2.0, 3.0, 5.0, 10.0, 30.0, 100.0, 300.0}},
      {"harm", &CaseConsequence::harm, {0.0, 0.003, 0.01, 0.03, 0.1, 0.3}}};
  return axes;
}

Plan::Plan(const MarkedCases& cases, const Grid& grid)
    : cases_(cases),
      grid_(grid),
      seeds_(static_cast<std::size_t>(grid.question().seeds)),
      groups_(cases.consequences.size()) {
  const StressTest& question = grid.question();
  for (std::size_t cell = 0; cell < grid.cells(); ++cell) {
    const Grid::Motion motion = grid.motion(grid.first_of_cell(cell).motion);
    departure_of_.push_back(static_cast<std::size_t>(std::ranges::find(question.departures, motion.departure) -
                                                     question.departures.begin()));
    family_of_.push_back(motion.departure.family());
  }
  for (std::size_t group = 0; group < groups_.size(); ++group) {
    const Grid::Case place = grid.at(group * seeds_);
    groups_[group].cell = grid.cell_of(grid.motion(place.motion), place.sensors);
    groups_[group].departure = departure_of_[groups_[group].cell];
    for (const ConsequenceAxis& axis : consequence_axes())
      groups_[group].intervals.push_back(axis.interval_of(cases.consequences[group].*axis.value));
  }
  order_.resize(question.entrants());
  for (std::size_t entrant = 0; entrant < order_.size(); ++entrant) {
    order_[entrant].resize(grid.cases());
    std::iota(order_[entrant].begin(), order_[entrant].end(), 0U);
    std::ranges::stable_sort(order_[entrant], std::ranges::greater{},
                             [&](std::uint32_t number) { return cases.marks[entrant][number].confidence; });
  }
}

std::vector<Aggregate> aggregates_of(const Plan& plan, const Resample& resample) {
  const Weights weights = weights_of(plan, resample);
  std::vector<Aggregate> result;
  for (std::size_t entrant = 0; entrant < plan.grid().question().entrants(); ++entrant)
    result.push_back(aggregate_of(plan, weights, entrant));
  return result;
}

}  // namespace dualdamp::bench
