#pragma once
/// Means of marks over one resample of a stress test, method by method.
///
/// Cases that differ by noise alone, those of one motion and set of sensors, are a group. Groups are added up to
/// cells, and to the intervals of distance and harm; both are averaged within departures, within families, and over
/// families.

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "bench/grid.hpp"
#include "bench/score/metrics.hpp"
#include "bench/score/resample.hpp"
#include "bench/score/scores.hpp"

namespace dualdamp::bench {

/// An axis of consequences, cut into intervals.
struct ConsequenceAxis {
  const char* name;
  double CaseConsequence::* value;
  std::vector<double> edges;  ///< ascending; the last interval is open

  [[nodiscard]] std::size_t intervals() const { return edges.size(); }
  /// The interval of a value; `intervals()` below the first edge or for NaN.
  [[nodiscard]] std::size_t interval_of(double value) const;
};

/// Distance, then harm.
[[nodiscard]] const std::vector<ConsequenceAxis>& consequence_axes();

/// The data that do not depend on the resample: the groups, their cells and intervals, and the cases in the order
/// of each method's confidence.
class Plan {
 public:
  Plan(const MarkedCases& cases, const Grid& grid);

  struct Group {
    std::size_t cell = 0;
    std::size_t departure = 0;           ///< among those of the question; the truth comes after the last
    std::vector<std::size_t> intervals;  ///< on each axis
  };

  [[nodiscard]] const std::vector<Group>& groups() const { return groups_; }
  [[nodiscard]] std::size_t group_of(std::size_t number) const { return number / seeds_; }
  [[nodiscard]] std::size_t seeds() const { return seeds_; }
  [[nodiscard]] const std::vector<Family>& families() const { return family_of_; }  ///< of the cells
  [[nodiscard]] std::size_t departure_of(std::size_t cell) const { return departure_of_[cell]; }
  [[nodiscard]] const Mark& mark(std::size_t entrant, std::size_t number) const {
    return cases_.marks[entrant][number];
  }
  [[nodiscard]] const CaseConsequence& consequence(std::size_t group) const { return cases_.consequences[group]; }
  /// All cases by falling confidence.
  [[nodiscard]] const std::vector<std::uint32_t>& order(std::size_t entrant) const { return order_[entrant]; }
  [[nodiscard]] const Grid& grid() const { return grid_; }

 private:
  const MarkedCases& cases_;
  const Grid& grid_;
  std::size_t seeds_;
  std::vector<Group> groups_;
  std::vector<std::vector<std::uint32_t>> order_;
  std::vector<std::size_t> departure_of_;
  std::vector<Family> family_of_;
};

/// One resample of one method.
struct Aggregate {
  std::vector<Metrics> cells;
  std::map<Family, Metrics> families;
  Metrics all;
  /// By axis, interval; without the truth, and without the area of risk.
  std::vector<std::vector<Metrics>> intervals;
};

/// By method.
[[nodiscard]] std::vector<Aggregate> aggregates_of(const Plan& plan, const Resample& resample);

}  // namespace dualdamp::bench
