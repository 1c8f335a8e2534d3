#include "sim/engine/state.hpp"

#include <algorithm>

namespace dualdamp::sim {

bool same_mode(const State& a, const State& b) {
  return a.direction == b.direction &&
         std::equal(a.memories.begin(), a.memories.end(), b.memories.begin(), b.memories.end(),
                    [](const friction::Memory& m, const friction::Memory& n) {
                      return m.mode == n.mode && m.indices == n.indices && m.course == n.course &&
                             m.state.size() == n.state.size();
                    });
}

}  // namespace dualdamp::sim
