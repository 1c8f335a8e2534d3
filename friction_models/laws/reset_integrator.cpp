#include "friction_models/laws/reset_integrator.hpp"

#include <algorithm>
#include <cmath>

#include "friction_models/formulas/slider.hpp"
#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& ResetIntegrator::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "kinetic", .unit = "N", .range = not_negative, .meaning = "friction force while slipping"},
      {.name = "stiffness",
       .unit = "N/m",
       .range = positive,
       .meaning = "stiffness of the bond without its static gain"},
      {.name = "static_gain",
       .unit = "1",
       .fallback = 0.0,
       .range = not_negative,
       .meaning = "the bond breaks at (1 + static_gain) kinetic"},
      {.name = "damping",
       .unit = "N.s/m",
       .fallback = 0.0,
       .range = not_negative,
       .meaning = "damper that acts in stick only"},
  };
  return table;
}

Affine ResetIntegrator::affine_force(const Memory& memory, const Instant& now, Direction) const {
  if (memory.mode != 0) return memory.mode * now.force_limit(kinetic_);
  const double bond = (1.0 + static_gain_) * stiffness_;
  return {.constant = -bond * memory.state[0], .position = bond, .velocity = damping_};
}

void ResetIntegrator::affine_guards(const Memory& memory, const Instant& now, Direction direction,
                                    std::vector<Affine>& guards) const {
  const Affine limit = now.force_limit(kinetic_);
  if (memory.mode == 0) {
    // The difference from a force limit of nearly the same slope over position is small; its rounding error is not.
    const double held = stiffness_ * memory.state[0];
    const Affine stretched{.constant = -held, .position = stiffness_, .cancelled = std::abs(held)};
    guards.push_back(limit - stretched);
    guards.push_back(limit + stretched);
  } else if (stops_by_itself(limit, stiffness_) || is_left_behind(memory.mode, direction)) {
    guards.push_back(dragged_speed(limit, memory.mode, stiffness_));
  }
}

void ResetIntegrator::hold(Memory& memory, const Instant& now) const {
  memory.state = {now.x - memory.mode * now.force_limit_now(kinetic_) / stiffness_};
  memory.mode = 0;
}

void ResetIntegrator::jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const {
  const bool slips = memory.mode != 0;
  switch (trigger.cause) {
    case Trigger::direction_change:
      // Under a force limit that varies the end of the bond stops at a guard of its own.
      if (slips && sign(direction) != memory.mode && !stops_by_itself(now.force_limit(kinetic_), stiffness_))
        hold(memory, now);
      return;
    case Trigger::limit_change:
      if (now.force_limit_now(kinetic_) == 0.0) memory = start(now);
      if (memory.mode != 0) hold(memory, now);
      return;
    default:
      if (slips) return hold(memory, now);
      memory = {.mode = trigger.cause == 0 ? 1 : -1};
  }
}

void ResetIntegrator::rates(const Memory&, const Instant&, Direction, std::span<double> rates) const {
  std::ranges::fill(rates, 0.0);
}

void ResetIntegrator::scales(const Memory&, std::span<double> scales) const {
  std::ranges::fill(scales, kinetic_ / stiffness_);
}

LawEntry reset_integrator_entry() {
  return {.name = "reset_integrator",
          .summary = "bond that stretches, breaks and then slides (Haessig and Friedland)",
          .equation =
              "stick: z' = v, F = (1 + static_gain) stiffness z + damping v, |z| < z0 = kinetic/stiffness;  "
              "slip: F = +-kinetic",
          .states = "other end of the bond",
          .sources = "haessig1991",
          .modifiers = {"drift", "position_slope", "fluctuation"},
          .parameters = ResetIntegrator::parameters(),
          .make = [](const ParameterValues& p) -> std::vector<Law> {
            const Law law(ResetIntegrator(p.number("kinetic"), p.number("stiffness"), p.number("static_gain"),
                                          p.number("damping")));
            return {modified(law, p, {p.number("kinetic")})};
          }};
}

}  // namespace dualdamp::friction
