#include "friction_models/friction_lag.hpp"

#include <algorithm>
#include <iterator>

namespace dualdamp::friction {

const std::vector<Parameter>& FrictionLag::parameters() {
  static const std::vector<Parameter> table = [] {
    std::vector<Parameter> list = StribeckCurve::parameters({.low = 0.0});
    std::ranges::copy(StribeckCurve::shape_parameters(), std::back_inserter(list));
    list.push_back({.name = "lag",
                    .unit = "s",
                    .range = {.low = 0.0, .low_open = true},
                    .meaning = "time by which the level follows the speed late"});
    list.push_back({.name = "delay",
                    .kind = ParameterKind::flag,
                    .fallback = false,
                    .meaning = "whether the lag is a pure delay instead of one of first order"});
    return list;
  }();
  return table;
}

Memory FrictionLag::start(const Instant& now) const {
  return {.mode = now.v > 0.0 ? 1 : now.v < 0.0 ? -1 : 0, .state = {now.v}};
}

void FrictionLag::jump(Memory& memory, Trigger trigger, const Instant&, Direction direction) const {
  if (trigger.cause == 0) {
    memory.mode = -memory.mode;
  } else if (trigger.cause == Trigger::direction_change && memory.mode == 0) {
    memory.mode = static_cast<int>(direction);
  }
}

}  // namespace dualdamp::friction
