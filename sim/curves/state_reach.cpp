#include "sim/curves/state_reach.hpp"

#include <algorithm>
#include <cmath>

namespace dualdamp::sim {

namespace {

/// Whether two states have the same unit: both sizes are those of the position, of the velocity or of their own.
bool are_alike(double a, double b) { return std::isinf(a) == std::isinf(b) && (a > 0.0) == (b > 0.0); }

}  // namespace

void StateReach::begin(const State& start) {
  sizes_.clear();
  reach_.clear();
  for (std::size_t i = 0; i < start.memories.size(); ++i) {
    sizes_.push_back(sizes_of(i, start.memories[i]));
    reach_.emplace_back(start.memories[i].state.size(), 0.0);
  }
  add(start.memories);
}

void StateReach::observe(const Interval&, double) { add(engine_.Engine::state().memories); }

std::vector<double> StateReach::sizes_of(std::size_t law, const friction::Memory& memory) const {
  std::vector<double> sizes(memory.state.size(), 0.0);
  model_.friction[law].scales(memory, sizes);
  return sizes;
}

/// A law whose states mean something else in its present mode adds nothing.
void StateReach::add(const std::vector<friction::Memory>& memories) {
  for (std::size_t i = 0; i < memories.size(); ++i) {
    const std::vector<double>& state = memories[i].state;
    if (state.size() != reach_[i].size() || !std::ranges::equal(sizes_of(i, memories[i]), sizes_[i], are_alike))
      continue;
    for (std::size_t k = 0; k < state.size(); ++k) reach_[i][k] = std::max(reach_[i][k], std::abs(state[k]));
  }
}

std::vector<double> StateReach::values() const {
  std::vector<double> result;
  for (const std::vector<double>& of_law : reach_)
    for (const double value : of_law)
      result.push_back(value > 0.0 && std::isfinite(value) ? std::ldexp(1.0, std::ilogb(value)) : 0.0);
  return result;
}

}  // namespace dualdamp::sim
