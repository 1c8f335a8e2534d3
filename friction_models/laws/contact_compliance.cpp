#include "friction_models/laws/contact_compliance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "friction_models/formulas/slider.hpp"
#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "friction_models/modifiers/modifiers.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& ContactCompliance::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "kinetic", .unit = "N", .range = {.low = 0.0}, .meaning = "friction force while the slider slides"},
      {.name = "static",
       .unit = "N",
       .same_as = "kinetic",
       .range = {.low = 0.0},
       .at_least = "kinetic",
       .meaning = "force at which the slider breaks away"},
      {.name = "contact_stiffness",
       .unit = "N/m",
       .range = {.low = 0.0, .low_open = true},
       .meaning = "stiffness of the contact before it slides"},
      {.name = "contact_damping",
       .unit = "N.s/m",
       .fallback = 0.0,
       .range = {.low = 0.0},
       .meaning = "damper beside the contact spring"},
  };
  return table;
}

Affine ContactCompliance::affine_force(const Memory& memory, const Instant& now, Direction) const {
  if (std::abs(memory.mode) == slipping) return memory.mode * now.force_limit(kinetic_);
  return {.constant = -stiffness_ * memory.state[0], .position = stiffness_, .velocity = damping_};
}

Affine ContactCompliance::break_away(const Memory& memory, const Instant& now, int side) const {
  return now.force_limit(memory.mode == side * halted ? kinetic_ : static_);
}

ContactCompliance::Relaxation ContactCompliance::relaxation(const Memory& memory, const Instant& now) const {
  const Affine level = memory.mode * now.force_limit(kinetic_);
  const double rate = level.rate / stiffness_;
  const double settled = (level.constant - damping_ * rate) / stiffness_;
  return {settled, rate, memory.state[0] - settled, stiffness_ / damping_};
}

/// A damped slider, and a slider under a force limit that varies, stop at a guard of their own.
bool ContactCompliance::slider_stops_by_itself(const Instant& now) const {
  return is_damped() || stops_by_itself(now.force_limit(kinetic_), stiffness_);
}

/// Speed of a slider that slips, positive in the direction of the force.
Affine ContactCompliance::slider_speed(const Memory& memory, const Instant& now) const {
  if (!is_damped()) return dragged_speed(now.force_limit(kinetic_), memory.mode, stiffness_);
  const Relaxation u = relaxation(memory, now);
  // The stretch is a difference of positions. A large decay multiplies its rounding error.
  const double rounded = u.decay * (std::abs(now.x) + std::abs(memory.state[0]) + std::abs(u.settled));
  return memory.mode * Affine{.constant = -u.rate,
                              .velocity = 1.0,
                              .transient = u.decay * u.relaxing,
                              .decay = u.decay,
                              .cancelled = rounded};
}

void ContactCompliance::affine_guards(const Memory& memory, const Instant& now, Direction direction,
                                      std::vector<Affine>& guards) const {
  if (std::abs(memory.mode) != slipping) {
    Affine force = affine_force(memory, now, direction);
    // The difference from a force limit of nearly the same slope over position is small; its rounding error is not.
    force.cancelled = std::abs(force.constant);
    guards.push_back(break_away(memory, now, 1) - force);
    guards.push_back(break_away(memory, now, -1) + force);
  } else if (slider_stops_by_itself(now) || is_left_behind(memory.mode, direction)) {
    guards.push_back(slider_speed(memory, now));
  }
}

void ContactCompliance::slide(Memory& memory, const Instant& now, int side) const {
  memory.mode = side * slipping;
  if (is_damped()) {
    memory.state[0] = now.x - memory.state[0];
  } else {
    memory.state.clear();
  }
}

void ContactCompliance::stop_slider(Memory& memory, const Instant& now, int next_mode) const {
  const double u = is_damped() ? memory.state[0] : memory.mode * now.force_limit_now(kinetic_) / stiffness_;
  memory.mode = next_mode;
  memory.state = {now.x - u};
}

void ContactCompliance::jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const {
  const bool slips = std::abs(memory.mode) == slipping;
  switch (trigger.cause) {
    case Trigger::direction_change:
      if (!slips) {
        memory.mode = stuck;
      } else if (!slider_stops_by_itself(now) && sign(direction) != memory.mode) {
        stop_slider(memory, now, stuck);
      }
      return;
    case Trigger::limit_change:
      // A damped spring relaxes to its new force limit without a halt. Where there was no force limit the contact
      // starts unstretched.
      if (now.force_limit_now(static_) == 0.0) {
        memory = start(now);
      } else if (slips && !is_damped()) {
        stop_slider(memory, now, memory.mode * halted);
      }
      return;
    default:
      if (slips) return stop_slider(memory, now, stuck);
      slide(memory, now, trigger.cause == 0 ? 1 : -1);
  }
}

void ContactCompliance::rates(const Memory& memory, const Instant& now, Direction, std::span<double> rates) const {
  std::ranges::fill(rates, 0.0);
  if (std::abs(memory.mode) == slipping && is_damped()) {
    rates[0] = (memory.mode * now.force_limit_now(kinetic_) - stiffness_ * memory.state[0]) / damping_;
  }
}

double ContactCompliance::dissipation(const Memory& memory, const Instant& now, Direction) const {
  if (std::abs(memory.mode) != slipping) return damping_ * now.v * now.v;
  const double speed = value(slider_speed(memory, now), now);
  const double slider = now.force_limit_now(kinetic_) * speed;
  const double stretching = now.v - memory.mode * speed;
  return slider + damping_ * stretching * stretching;
}

void ContactCompliance::advance(Memory& memory, const Instant& begin, const Instant&, double duration,
                                Direction) const {
  if (std::abs(memory.mode) != slipping || !is_damped()) return;
  const Relaxation u = relaxation(memory, begin);
  memory.state[0] = u.settled + u.rate * duration + u.relaxing * std::exp(-u.decay * duration);
}

LawEntry contact_compliance_entry() {
  return {.name = "contact_compliance",
          .summary = "Coulomb slider behind a contact spring, which may be damped",
          .equation =
              "stuck: F = contact_stiffness (x - a) + contact_damping v, |F| < static;  slipping: F = +-kinetic",
          .states = "position of the slider",
          .sources = "liang2004identifying, jenkins1962, iwan1966",
          .modifiers = all_modifiers(),
          .parameters = ContactCompliance::parameters(),
          .make = [](const ParameterValues& p) -> std::vector<Law> {
            const Law law(ContactCompliance(p.number("kinetic"), p.number("static"), p.number("contact_stiffness"),
                                            p.number("contact_damping")));
            return {modified(law, p, {p.number("kinetic"), p.number("static")})};
          }};
}

}  // namespace dualdamp::friction
