#include "sim/engine/state.hpp"

#include <algorithm>

namespace dualdamp::sim {

namespace {

bool same_modes_of_laws(const State& a, const State& b) {
  return std::equal(a.memories.begin(), a.memories.end(), b.memories.begin(), b.memories.end(),
                    [](const friction::Memory& m, const friction::Memory& n) {
                      return m.mode == n.mode && m.indices == n.indices && m.course == n.course &&
                             m.state.size() == n.state.size();
                    });
}

}  // namespace

bool same_mode(const State& a, const State& b) { return a.direction == b.direction && same_modes_of_laws(a, b); }

bool have_distance(const State& a, const State& b) {
  const auto sticks = [](const State& state) { return state.direction == friction::Direction::none; };
  return sticks(a) == sticks(b) && same_modes_of_laws(a, b);
}

}  // namespace dualdamp::sim
