#pragma once
/// How far the states of the laws reach within a period of a motion: the sizes by which a branch is measured. An
/// attached mass moves a hundred times as far as a mass that it holds at rest, and a state need not be a length.
/// Cost: a copy of the laws' memories for each interval.

#include <vector>

#include "sim/engine/engine.hpp"
#include "sim/orbits/period_map.hpp"

namespace dualdamp::sim {

class StateReach final : public PeriodObserver {
 public:
  /// `engine`: the one that computes the period.
  StateReach(const Model& model, const Engine& engine) : model_(model), engine_(engine) {}

  void begin(const State& start) override;
  void observe(const Interval& interval, double x) override;

  /// Of each state, in the order of `coordinates`, in steps of two: neighbouring orbits have the same ones.
  [[nodiscard]] std::vector<double> values() const;

 private:
  void add(const std::vector<friction::Memory>& memories);
  [[nodiscard]] std::vector<double> sizes_of(std::size_t law, const friction::Memory& memory) const;

  const Model& model_;
  const Engine& engine_;
  std::vector<std::vector<double>> sizes_;  ///< as each law states them, at the start
  std::vector<std::vector<double>> reach_;  ///< largest absolute values
};

}  // namespace dualdamp::sim
