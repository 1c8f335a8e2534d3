#include "sim/engine/state.hpp"

#include <algorithm>

namespace dualdamp::sim {

namespace {

bool same_law_modes(const State& a, const State& b) {
  return std::equal(a.memories.begin(), a.memories.end(), b.memories.begin(), b.memories.end(),
                    [](const friction::Memory& m, const friction::Memory& n) {
                      return m.mode == n.mode && m.indices == n.indices && m.course == n.course &&
                             m.state.size() == n.state.size();
                    });
}

bool both_slip(const State& a, const State& b) {
  return a.direction != friction::Direction::none && b.direction != friction::Direction::none;
}

}  // namespace

bool same_mode(const State& a, const State& b) {
  const bool is_free = a.turns_freely && b.turns_freely && both_slip(a, b);
  return (is_free || a.direction == b.direction) && same_law_modes(a, b);
}

bool are_comparable(const State& a, const State& b) {
  return (both_slip(a, b) || a.direction == b.direction) && same_law_modes(a, b);
}

}  // namespace dualdamp::sim
