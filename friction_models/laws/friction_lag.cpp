#include "friction_models/laws/friction_lag.hpp"

#include <algorithm>
#include <iterator>

#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "friction_models/modifiers/modifiers.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& FrictionLag::parameters() {
  static const std::vector<Parameter> table = [] {
    std::vector<Parameter> list = StribeckCurve::parameters(not_negative);
    std::ranges::copy(StribeckCurve::shape_parameters(), std::back_inserter(list));
    list.push_back(
        {.name = "lag", .unit = "s", .range = positive, .meaning = "time by which the friction lags the speed"});
    list.push_back({.name = "delay",
                    .kind = ParameterKind::flag,
                    .fallback = false,
                    .meaning = "true: the lag is a pure delay; false: it is of first order"});
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

namespace {

std::vector<Law> make_friction_lag(const ParameterValues& p) {
  const StribeckCurve curve(p);
  const double lag = p.number("lag");
  const Law law = p.flag("delay") ? Law(DelayedFriction(curve, lag)) : Law(FrictionLag(curve, lag));
  return {modified(law, p, {p.number("kinetic"), p.number("static")}, {.states_move = true})};
}

}  // namespace

LawEntry friction_lag_entry() {
  return {.name = "friction_lag",
          .summary = "friction force that follows the speed with a lag",
          .equation =
              "slip: F = level sgn v;  stick: F = pull while |pull| <= level, level = g(|w|), w' = (v - w)/lag, or "
              "with delay g(|v(t - lag)|), g as the level of stribeck",
          .engine = EngineKind::smooth,
          .states = "late velocity w; with delay the velocities of the last lag",
          .sources = "rice1983, hess1990",
          .modifiers = all_modifiers(),
          .parameters = FrictionLag::parameters(),
          .make = make_friction_lag,
          .check = StribeckCurve::check_shape};
}

}  // namespace dualdamp::friction
