#include "friction_models/laws/gap_spring.hpp"

#include "friction_models/law_entry.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& GapSpring::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "stiffness", .unit = "N/m", .range = positive, .meaning = "stiffness beyond the gap"},
      {.name = "gap",
       .unit = "m",
       .range = not_negative,
       .meaning = "distance from x = 0 to the spring, on either side"},
  };
  return table;
}

Affine GapSpring::affine_force(const Memory& memory, const Instant&, Direction) const {
  if (memory.mode == 0) return {};
  return {.constant = -memory.mode * stiffness_ * gap_, .position = stiffness_};
}

void GapSpring::affine_guards(const Memory& memory, const Instant&, Direction, std::vector<Affine>& guards) const {
  if (memory.mode != 0) {
    guards.push_back({.constant = -gap_, .position = static_cast<double>(memory.mode)});
    return;
  }
  guards.push_back({.constant = gap_, .position = -1.0});
  guards.push_back({.constant = gap_, .position = 1.0});
}

void GapSpring::jump(Memory& memory, Trigger trigger, const Instant&, Direction) const {
  if (trigger.cause < 0) return;
  memory.mode = memory.mode != 0 ? 0 : trigger.cause == 0 ? 1 : -1;
}

LawEntry gap_spring_entry() {
  return {.name = "gap_spring",
          .summary = "spring with free play: no force within the gap, elastic stops beyond it; no friction",
          .equation = "F = stiffness (x - s gap) for s x > gap, s = +-1;  F = 0 for |x| <= gap",
          .states = "the side that x is beyond the gap",
          .sources = "shaw1983",
          .parameters = GapSpring::parameters(),
          .make = [](const ParameterValues& p) -> std::vector<Law> {
            return {Law(GapSpring(p.number("stiffness"), p.number("gap")))};
          }};
}

}  // namespace dualdamp::friction
