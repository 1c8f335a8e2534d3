#include "friction_models/laws/contact_compliance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "friction_models/formulas/slider.hpp"
#include "friction_models/formulas/static_parameter.hpp"
#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "friction_models/modifiers/modifiers.hpp"
#include "friction_models/state_sizes.hpp"

namespace dualdamp::friction {

namespace {

/// A creeping slider counts as stopped when the force that drives it is this fraction of the static friction.
constexpr double stopped = 1e-12;
/// A force is at its limit if it differs from it by less than the sum of the first fraction of the limit and the
/// second fraction of the terms of x and a.
constexpr double at_limit = 3e-10;
constexpr double rounded = 1e-13;

}  // namespace

const std::vector<Parameter>& ContactCompliance::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "kinetic", .unit = "N", .range = not_negative, .meaning = "friction force while the slider slides"},
      static_parameter("force at which the slider breaks away"),
      {.name = "contact_stiffness",
       .unit = "N/m",
       .range = positive,
       .meaning = "stiffness of the contact before it slides"},
      {.name = "contact_damping",
       .unit = "N.s/m",
       .fallback = 0.0,
       .range = not_negative,
       .meaning = "damper in parallel with the contact spring"},
  };
  return table;
}

int ContactCompliance::sliding_side(const Memory& memory) {
  const int side = memory.mode > 0 ? 1 : -1;
  return memory.mode == side * slipping || memory.mode == side * creeping ? side : 0;
}

Affine ContactCompliance::affine_force(const Memory& memory, const Instant& now, Direction) const {
  if (const int side = sliding_side(memory); side != 0) return side * now.force_limit(kinetic_);
  return {.constant = -stiffness_ * memory.state[0], .position = stiffness_, .velocity = damping_};
}

Affine ContactCompliance::break_away(const Memory& memory, const Instant& now, int side) const {
  return now.force_limit(memory.mode == side * halted ? kinetic_ : static_);
}

ContactCompliance::Relaxation ContactCompliance::relaxation(const Memory& memory, const Instant& now) const {
  const double settled = sliding_side(memory) * now.force_limit(kinetic_).rate / stiffness_;
  return {settled, memory.state[0] - settled, stiffness_ / damping_};
}

/// A damped slider, and a slider under a force limit that varies, stop at a guard of their own.
bool ContactCompliance::slider_stops_by_itself(const Instant& now) const {
  return is_damped() || stops_by_itself(now.force_limit(kinetic_), stiffness_);
}

/// Speed of a slider that slips, positive in the direction of the force.
Affine ContactCompliance::slider_speed(const Memory& memory, const Instant& now) const {
  const int side = sliding_side(memory);
  if (!is_damped()) return dragged_speed(now.force_limit(kinetic_), side, stiffness_);
  const Relaxation q = relaxation(memory, now);
  const double v = memory.mode == side * slipping ? 1.0 : 0.0;
  return side * Affine{.constant = -q.settled, .velocity = v, .transient = -q.relaxing, .decay = q.decay};
}

/// The speed below which a slider that creeps has stopped.
double ContactCompliance::slowest_creep(double static_level) const { return stopped * static_level / damping_; }

void ContactCompliance::affine_guards(const Memory& memory, const Instant& now, Direction direction,
                                      std::vector<Affine>& guards) const {
  const int side = sliding_side(memory);
  if (side == 0) {
    Affine force = affine_force(memory, now, direction);
    // The force limit may have nearly the same slope over position: then the difference is small, its rounding
    // error not.
    force.cancelled = std::abs(force.constant);
    guards.push_back(break_away(memory, now, 1) - force);
    guards.push_back(break_away(memory, now, -1) + force);
  } else if (slider_stops_by_itself(now) || is_left_behind(side, direction)) {
    guards.push_back(slider_speed(memory, now));
    // Under a falling limit the slider creeps on beside a mass at rest, from zero speed at its break-away.
    const bool comes_to_rest = memory.mode == side * creeping && now.force_limit(kinetic_).rate >= 0.0;
    if (comes_to_rest) guards.back().constant -= slowest_creep(now.force_limit_now(static_));
  }
}

/// u' just after a break-away: u is continuous. The force is at its limit; a small excess is rounding of x, which
/// divided by the damping could exceed v, so it is dropped. Only a step of the limits leaves a clear excess.
double ContactCompliance::stretching_at_break_away(const Memory& memory, const Instant& now, int side) const {
  const double level = value(break_away(memory, now, side), now);
  const double beyond = side * value(affine_force(memory, now, {}), now) - level;
  const double terms = stiffness_ * (std::abs(now.x) + std::abs(memory.state[0])) + damping_ * std::abs(now.v);
  const double force = level + (std::abs(beyond) > at_limit * level + rounded * terms ? beyond : 0.0);
  return now.v - side * (force - now.force_limit_now(kinetic_)) / damping_;
}

void ContactCompliance::slide(Memory& memory, const Instant& now, int side, Direction direction) const {
  if (is_damped()) {
    memory.state[0] = stretching_at_break_away(memory, now, side);
  } else {
    memory.state.clear();
  }
  memory.mode = side * sliding_mode(direction);
}

/// u [m]
double ContactCompliance::stretch(const Memory& memory, const Instant& now) const {
  const int side = sliding_side(memory);
  if (side == 0) return now.x - memory.state[0];
  const double damper = is_damped() ? damping_ * memory.state[0] : 0.0;
  return (side * now.force_limit_now(kinetic_) - damper) / stiffness_;
}

void ContactCompliance::stop_slider(Memory& memory, const Instant& now, int next_mode) const {
  const double u = stretch(memory, now);
  memory.mode = next_mode;
  memory.state = {now.x - u};
}

void ContactCompliance::jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const {
  const int side = sliding_side(memory);
  switch (trigger.cause) {
    case Trigger::direction_change:
      if (side == 0) {
        memory.mode = stuck;
      } else if (slider_stops_by_itself(now)) {
        memory.mode = side * sliding_mode(direction);
      } else if (sign(direction) != side) {
        stop_slider(memory, now, stuck);
      }
      return;
    case Trigger::limit_change:
      // Where there was no force limit the contact starts unstretched.
      if (now.force_limit_now(static_) == 0.0) {
        memory = start(now);
      } else if (side != 0) {
        stop_slider(memory, now, side * halted);
      }
      return;
    default:
      if (side != 0) return stop_slider(memory, now, stuck);
      slide(memory, now, trigger.cause == 0 ? 1 : -1, direction);
  }
}

void ContactCompliance::rates(const Memory& memory, const Instant& now, Direction, std::span<double> rates) const {
  std::ranges::fill(rates, 0.0);
  if (sliding_side(memory) == 0 || !is_damped()) return;
  const Relaxation q = relaxation(memory, now);
  rates[0] = -q.decay * q.relaxing;
}

void ContactCompliance::scales(const Memory& memory, std::span<double> scales) const {
  if (memory.state.empty()) return;
  const int side = sliding_side(memory);
  scales[0] = side == 0                        ? static_ / stiffness_
              : memory.mode == side * slipping ? size_of_velocity
                                               : slowest_creep(static_);
}

double ContactCompliance::dissipation(const Memory& memory, const Instant& now, Direction) const {
  const int side = sliding_side(memory);
  if (side == 0) return damping_ * now.v * now.v;
  const double speed = value(slider_speed(memory, now), now);
  const double slider = now.force_limit_now(kinetic_) * speed;
  const double stretching = now.v - side * speed;
  return slider + damping_ * stretching * stretching;
}

double ContactCompliance::stored_energy(const Memory& memory, const Instant& now) const {
  const double u = stretch(memory, now);
  return 0.5 * stiffness_ * u * u;
}

void ContactCompliance::advance(Memory& memory, const Instant& begin, const Instant&, double duration,
                                Direction) const {
  if (sliding_side(memory) == 0 || !is_damped()) return;
  const Relaxation q = relaxation(memory, begin);
  const double left = q.relaxing * std::exp(-q.decay * duration);
  // Zero instead of subnormal numbers, which have fewer digits.
  memory.state[0] = q.settled + (std::abs(left) < std::numeric_limits<double>::min() ? 0.0 : left);
}

LawEntry contact_compliance_entry() {
  return {.name = "contact_compliance",
          .summary = "Coulomb slider in series with a contact spring, which may be damped",
          .equation =
              "stuck: F = contact_stiffness (x - a) + contact_damping v, |F| < static;  slipping: F = +-kinetic",
          .states = "position of the slider",
          .sources = "liang2004identifying, jenkins1962, iwan1966",
          // The slider would stop and go on many times in a period.
          .modifiers = all_modifiers_but("load_modulation"),
          .parameters = ContactCompliance::parameters(),
          .make = [](const ParameterValues& p) -> std::vector<Law> {
            const ContactCompliance law(p.number("kinetic"), p.number("static"), p.number("contact_stiffness"),
                                        p.number("contact_damping"));
            return {modified(law, p, {p.number("kinetic"), p.number("static")})};
          }};
}

}  // namespace dualdamp::friction
