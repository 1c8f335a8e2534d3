#include "sim/orbits/recurrence.hpp"

#include <algorithm>

#include "sim/orbits/period_map.hpp"

namespace dualdamp::sim {

void Recurrence::add(const State& state, double size) {
  const auto place = static_cast<std::size_t>(count_++) % kept;
  states_[place] = state;
  sizes_[place] = size;
  size_ = *std::ranges::max_element(sizes_);
}

double Recurrence::closure(int periods) const {
  if (periods >= count_) return std::numeric_limits<double>::infinity();
  const State& now = states_[static_cast<std::size_t>(count_ - 1) % kept];
  const State& then = states_[static_cast<std::size_t>(count_ - 1 - periods) % kept];
  return distance(then, now, size_, omega_);
}

int Recurrence::shortest(double limit) const {
  for (int periods = 1; periods <= longest_period && periods < count_; ++periods) {
    if (closure(periods) <= limit) return periods;
  }
  return 0;
}

}  // namespace dualdamp::sim
