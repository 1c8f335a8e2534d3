#include "friction_models/laws/free_play.hpp"

#include "friction_models/formulas/static_parameter.hpp"
#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "friction_models/modifiers/modifiers.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& FreePlay::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "kinetic",
       .unit = "N",
       .range = not_negative,
       .meaning = "friction force of the element while it is pushed"},
      static_parameter("force at which the element breaks away"),
      {.name = "play",
       .unit = "m",
       .range = positive,
       .meaning = "distance from one stop of the element to the other"},
  };
  return table;
}

/// While the mass sticks: the middle of the forces with which the element can hold it, from 0 to static.
Affine FreePlay::affine_force(const Memory& memory, const Instant& now, Direction direction) const {
  if (memory.mode == 0) return {};
  if (direction == Direction::none) return 0.5 * memory.mode * now.force_limit(static_);
  return static_cast<double>(memory.mode) * now.force_limit(kinetic_);
}

Affine FreePlay::affine_limit(const Memory& memory, const Instant& now) const {
  return memory.mode == 0 ? Affine{} : 0.5 * now.force_limit(static_);
}

void FreePlay::affine_guards(const Memory& memory, const Instant&, Direction, std::vector<Affine>& guards) const {
  if (memory.mode != 0) return;
  guards.push_back({.constant = memory.state[0] + half_, .position = -1.0});
  guards.push_back({.constant = half_ - memory.state[0], .position = 1.0});
}

void FreePlay::jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const {
  switch (trigger.cause) {
    case Trigger::direction_change:
      if (memory.mode != 0 && sign(direction) == -memory.mode) {
        memory.state = {now.x - memory.mode * half_};
        memory.mode = 0;
      }
      return;
    case Trigger::limit_change:
      // Where there was no force limit the element starts in the middle of its play.
      if (now.force_limit_now(static_) == 0.0) {
        memory.mode = 0;
        memory.state = {now.x};
      }
      return;
    default: {
      const int side = trigger.cause == 0 ? 1 : -1;
      // A mass that creeps away from a stop by less than its position is known to has not come back to it.
      if (sign(direction) == -side) {
        memory.state = {now.x - side * half_};
        return;
      }
      memory.mode = side;
      memory.state.clear();
    }
  }
}

LawEntry free_play_entry() {
  return {.name = "free_play",
          .summary = "Coulomb friction with free play: no friction until the play is crossed",
          .equation =
              "free: F = 0 while |x - a| < play/2;  pushing: F = s kinetic, at v = 0 F = pull while 0 <= s pull "
              "<= static",
          .states = "position of the friction element",
          .sources = "tao1996",
          .modifiers = all_modifiers(),
          .parameters = FreePlay::parameters(),
          .make = [](const ParameterValues& p) -> std::vector<Law> {
            const Law law(FreePlay(p.number("kinetic"), p.number("static"), p.number("play")));
            return {modified(law, p, {p.number("kinetic"), p.number("static")})};
          }};
}

}  // namespace dualdamp::friction
