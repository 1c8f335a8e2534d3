#include "friction_models/modifiers/modified.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "friction_models/modifiers/force_limits.hpp"

namespace dualdamp::friction {

namespace {

/// Beyond rounding, relative.
constexpr double clearly = 1e-12;
/// Of the heat that warms the contact, the least share that is not from its spring. At zero the spring relaxes by
/// its own heat without end; a change of mode leaves the contact below this, and a slip leads away from it.
constexpr double least_share = 1e-6;

/// The memory of a modified law in its parts: the memory of the law inside, and under warming, as the last state,
/// the mean power that the law turned to heat.
class Parts {
 public:
  Parts(const Memory& memory, bool warms) : whole_(memory) {
    if (!warms) return;
    // Copied member by member: most laws under warming have no state of their own, and then nothing is allocated.
    own_ = Memory{.mode = memory.mode,
                  .indices = memory.indices,
                  .state = {memory.state.begin(), memory.state.end() - 1},
                  .course = memory.course};
    power_ = memory.state.back();
  }

  [[nodiscard]] const Memory& inner() const { return own_ ? *own_ : whole_; }
  [[nodiscard]] const ModifierCourse& course() const { return whole_.course; }
  [[nodiscard]] double power() const { return power_; }  ///< W

 private:
  const Memory& whole_;
  std::optional<Memory> own_;
  double power_ = 0.0;
};

/// The parts of the memory of a modified law, to be changed. The law inside does not keep the course.
struct OpenParts {
  Memory& inner;
  ModifierCourse course;
  double power = 0.0;
};

class ModifiedLaw final : public LawModel,
                          public MemoryAbility,
                          public StickingAbility,
                          public AffineAbility,
                          public StateAbility,
                          public AdvanceAbility,
                          public DissipationAbility,
                          public ScheduleAbility,
                          public AperiodicAbility {
 public:
  ModifiedLaw(Law law, const ModifierSettings& settings, std::vector<double> limits, const WithoutLimits& without,
              StoredEnergy stored_energy)
      : law_(std::move(law)),
        limits_(settings, std::move(limits)),
        without_(without),
        stored_energy_(std::move(stored_energy)) {}

  [[nodiscard]] Abilities abilities() const override;
  [[nodiscard]] double force(const Memory& memory, const Instant& now, Direction direction) const override {
    const Parts parts = parts_of(memory);
    if (limits_.are_gone(parts.course())) return without_.force(now);
    return law_.force(parts.inner(), modify(parts, now, direction), direction);
  }

  [[nodiscard]] Memory start(const Instant& now) const override;
  void guards(const Memory& memory, const Instant& now, Direction direction,
              std::vector<double>& values) const override {
    const Parts parts = parts_of(memory);
    for (const Affine& guard : limits_.guards(parts.course(), parts.power(), now))
      values.push_back(value(guard, now));
    if (!stands(parts.course())) law_.guards(parts.inner(), modify(parts, now, direction), direction, values);
  }
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const override;

  [[nodiscard]] double static_limit(const Memory& memory, const Instant& now) const override {
    const Parts parts = parts_of(memory);
    return law_.static_limit(parts.inner(), limits_.at(parts.course(), parts.power(), now));
  }

  // The four functions below are called only if the force limits are affine.
  [[nodiscard]] Affine affine_force(const Memory& memory, const Instant& now, Direction direction) const override {
    if (limits_.are_gone(memory.course)) return {};
    return law_.affine_force(memory, limits_.at(memory.course, 0.0, now), direction);
  }
  [[nodiscard]] Affine affine_limit(const Memory& memory, const Instant& now) const override {
    return law_.affine_limit(memory, limits_.at(memory.course, 0.0, now));
  }
  void affine_guards(const Memory& memory, const Instant& now, Direction direction,
                     std::vector<Affine>& guards) const override {
    for (const Affine& guard : limits_.guards(memory.course, 0.0, now)) guards.push_back(guard);
    if (!limits_.are_gone(memory.course))
      law_.affine_guards(memory, limits_.at(memory.course, 0.0, now), direction, guards);
  }
  void advance(Memory& memory, const Instant& begin, const Instant& end, double duration,
               Direction direction) const override {
    if (limits_.are_gone(memory.course)) return;
    law_.advance(memory, limits_.at(memory.course, 0.0, begin), limits_.at(memory.course, 0.0, end), duration,
                 direction);
  }

  [[nodiscard]] double respond(const Memory& memory, const Instant& now, Direction direction,
                               std::span<double> rates) const override;
  void scales(const Memory& memory, std::span<double> scales) const override {
    const std::span<double> inner = scales.first(scales.size() - (warms() ? 1 : 0));
    law_.scales(parts_of(memory).inner(), inner);
    if (warms()) scales.back() = limits_.settings().warming_power;
  }
  [[nodiscard]] double dissipation(const Memory& memory, const Instant& now, Direction direction) const override {
    const Parts parts = parts_of(memory);
    if (limits_.are_gone(parts.course())) return without_.heat(now);
    return law_.dissipation(parts.inner(), modify(parts, now, direction), direction);
  }

  [[nodiscard]] double next_change(const Memory& memory) const override {
    return std::min(law_.next_change(parts_of(memory).inner()), limits_.next_change(memory.course));
  }
  [[nodiscard]] std::string_view aperiodic() const override;
  [[nodiscard]] bool drifts() const override { return limits_.settings().drift != 0.0; }

 private:
  [[nodiscard]] bool warms() const { return limits_.settings().warms(); }
  /// The states of the law stand still.
  [[nodiscard]] bool stands(const ModifierCourse& course) const {
    return !without_.states_move && limits_.are_gone(course);
  }
  [[nodiscard]] Parts parts_of(const Memory& memory) const { return {memory, warms()}; }

  /// The instant as the law inside sees it.
  [[nodiscard]] Instant modify(const Memory& inner, const ModifierCourse& course, double power, const Instant& now,
                               Direction direction) const;
  [[nodiscard]] Instant modify(const Parts& parts, const Instant& now, Direction direction) const {
    return modify(parts.inner(), parts.course(), parts.power(), now, direction);
  }
  [[nodiscard]] Instant modify(const OpenParts& parts, const Instant& now, Direction direction) const {
    return modify(parts.inner, parts.course, parts.power, now, direction);
  }
  void warm(Instant& modified, double rate) const;
  [[nodiscard]] double warming_rate(const Memory& inner, const ModifierCourse& course, double power,
                                    const Instant& now, Direction direction) const;

  [[nodiscard]] double relaxing_heat(const Memory& inner, const Instant& now, Direction direction,
                                     double heat) const;
  [[nodiscard]] double stored_energy(const Memory& inner, const ModifierCourse& course, double power,
                                     const Instant& now) const;
  void add_heat_of_change(double before, OpenParts& parts, const Instant& now) const;

  void look_again(OpenParts& parts, const Instant& now, Direction direction) const;
  void settle(OpenParts& parts, const Instant& now, Direction direction) const;
  void pass_guard(OpenParts& parts, int guard, const Instant& now, Direction direction) const;
  void change_by_schedule(OpenParts& parts, const Instant& now, Direction direction) const;
  void step_to(ModifierCourse next, OpenParts& parts, const Instant& now, Direction direction) const;

  Law law_;
  ForceLimits limits_;
  WithoutLimits without_;
  StoredEnergy stored_energy_;
};

Abilities ModifiedLaw::abilities() const {
  const bool is_affine = law_.is_affine() && limits_.settings().are_affine();
  return {.memory = this,
          .sticking = law_.holds_mass() ? this : nullptr,
          .affine = is_affine ? this : nullptr,
          .states = law_.has_rates() || warms() ? this : nullptr,
          .advance = is_affine && law_.advances() ? this : nullptr,
          .dissipation = this,
          .delay = law_.abilities().delay,
          .schedule = this,
          .aperiodic = this,
          .remembers_path = law_.remembers_path()};
}

Memory ModifiedLaw::start(const Instant& now) const {
  const ModifierCourse course = limits_.start(now);
  Memory memory = law_.start(limits_.at(course, 0.0, now));
  memory.course = course;
  if (warms()) memory.state.push_back(0.0);
  return memory;
}

std::string_view ModifiedLaw::aperiodic() const {
  const ModifierSettings& settings = limits_.settings();
  if (settings.fluctuates() && !settings.fluctuates_over_position()) return "its force limits fluctuate at random";
  return settings.drift != 0.0 ? "its force limits drift" : law_.aperiodic();
}

Instant ModifiedLaw::modify(const Memory& inner, const ModifierCourse& course, double power, const Instant& now,
                            Direction direction) const {
  Instant modified = limits_.at(course, power, now);
  if (warms()) warm(modified, warming_rate(inner, course, power, modified, direction));
  return modified;
}

/// The force limits fall at d(power)/dt = `rate` [W/s]. Also where the power is steady at this instant, or where
/// the load is just gone, they count as varying (`varying_rate`).
void ModifiedLaw::warm(Instant& modified, double rate) const {
  Modification& m = modified.modification;
  m.factor_rate -= (m.factor + m.factor_slope * modified.x) * rate / limits_.settings().warming_power;
  m.factor_rate = varying_rate(m.factor_rate);
}

/// d(power)/dt [W/s]. `now`: under the force limits without their fall by warming.
double ModifiedLaw::warming_rate(const Memory& inner, const ModifierCourse& course, double power,
                                 const Instant& now, Direction direction) const {
  const double time = limits_.settings().warming_time;
  if (limits_.are_gone(course)) return (without_.heat(now) - power) / time;
  const double heat = law_.dissipation(inner, now, direction);
  const double rate = (heat - power) / time;
  // The stretch of an undamped spring follows its force limit at once; other stretches are states.
  if (!law_.is_affine() || law_.abilities().dissipation == nullptr) return rate;
  return rate / std::max(least_share, 1.0 - relaxing_heat(inner, now, direction, heat) / time);
}

/// J: what the heat gains with d(power)/dt, in proportion to it, because a spring relaxes with its force limit.
/// `heat`: without this gain [W].
double ModifiedLaw::relaxing_heat(const Memory& inner, const Instant& now, Direction direction, double heat) const {
  const ModifierSettings& settings = limits_.settings();
  const double trial = (settings.warming_power + std::abs(heat)) / settings.warming_time;
  Instant warming = now;
  warm(warming, trial);
  return (law_.dissipation(inner, warming, direction) - heat) / trial;
}

double ModifiedLaw::stored_energy(const Memory& inner, const ModifierCourse& course, double power,
                                  const Instant& now) const {
  if (!stored_energy_ || limits_.are_gone(course)) return 0.0;
  return stored_energy_(inner, limits_.at(course, power, now));
}

/// The law has changed in an instant, and what its springs have lost is heat. `before`: their energy before [J].
/// The force limits fall with the heat, and springs at their limits then lose more: of the solutions of
/// time_constant rise = before - energy(rise) the largest is the one that ends the fall. The energy is convex, so
/// secants from above lead down to it.
void ModifiedLaw::add_heat_of_change(double before, OpenParts& parts, const Instant& now) const {
  constexpr int most_steps = 100;
  const auto rise_by = [&](double rise) {
    const double after = stored_energy(parts.inner, parts.course, parts.power + rise, now);
    return (before - after) / limits_.settings().warming_time;
  };
  double above = before / limits_.settings().warming_time;
  double found_above = rise_by(above);
  double rise = found_above;
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * above;
  for (int step = 0; step < most_steps && above - rise > rounding; ++step) {
    const double found = rise_by(rise);
    const double share = (found_above - found) / (above - rise);
    above = std::exchange(rise, share < 1.0 ? rise - (rise - found) / (1.0 - share) : found);
    found_above = found;
  }
  parts.power += rise;
}

double ModifiedLaw::respond(const Memory& memory, const Instant& now, Direction direction,
                            std::span<double> rates) const {
  const Parts parts = parts_of(memory);
  std::ranges::fill(rates, 0.0);
  Instant modified = limits_.at(parts.course(), parts.power(), now);
  if (warms()) {
    const double rate = warming_rate(parts.inner(), parts.course(), parts.power(), modified, direction);
    warm(modified, rate);
    rates.back() = rate;
    rates = rates.first(rates.size() - 1);
  }
  if (stands(parts.course())) return without_.force(now);
  const double force = law_.respond(parts.inner(), modified, direction, rates);
  return limits_.are_gone(parts.course()) ? without_.force(now) : force;
}

/// The law inside decides again, under the force limits of the present course.
void ModifiedLaw::look_again(OpenParts& parts, const Instant& now, Direction direction) const {
  law_.jump(parts.inner, {Trigger::limit_change}, modify(parts, now, direction), direction);
}

/// At a guard of the force limits: x enters another cell, or the limits continue from the same value.
void ModifiedLaw::pass_guard(OpenParts& parts, int guard, const Instant& now, Direction direction) const {
  const ModifierCourse next = limits_.after_guard(parts.course, guard);
  const ForceLimits::Ending ending = limits_.ending(guard);
  if (ending == ForceLimits::Ending::cell) return step_to(next, parts, now, direction);
  // A slip may end in another way under a constant limit than under a changing one. Where a limit falls to zero the
  // law sees it as zero: what its formula leaves there is rounding.
  const bool falls = next.vanished > parts.course.vanished || (next.unloaded && !parts.course.unloaded);
  if (falls) parts.course = next;
  if (ending == ForceLimits::Ending::force_limit || ending == ForceLimits::Ending::load)
    look_again(parts, now, direction);
  parts.course = next;
}

/// At a scheduled time, of the law or of the force limits.
void ModifiedLaw::change_by_schedule(OpenParts& parts, const Instant& now, Direction direction) const {
  const double own = law_.next_change(parts.inner);
  const double due = std::min(own, limits_.next_change(parts.course));
  if (own == due) law_.jump(parts.inner, {Trigger::scheduled}, modify(parts, now, direction), direction);
  step_to(limits_.after_change(parts.course, due), parts, now, direction);
}

/// The force limits change by a step.
void ModifiedLaw::step_to(ModifierCourse next, OpenParts& parts, const Instant& now, Direction direction) const {
  next.vanished = limits_.vanished(next, parts.power, now);
  // Under a falling limit a slider goes on sliding; moving states may be valid for one limit only.
  const bool rises = limits_.fluctuation(next) > limits_.fluctuation(parts.course);
  if (rises || law_.advances() || next.vanished != parts.course.vanished) look_again(parts, now, direction);
  parts.course = next;
  if (!limits_.are_gone(next)) settle(parts, modify(parts, now, direction), direction);
}

/// After a step: the law passes those of its guards that are clearly violated. So several laws that step together
/// need only one event.
void ModifiedLaw::settle(OpenParts& parts, const Instant& now, Direction direction) const {
  if (!law_.is_affine()) return;
  std::vector<Affine> guards;
  for (int repeats = 0; repeats < 4; ++repeats) {
    guards.clear();
    law_.affine_guards(parts.inner, now, direction, guards);
    const auto violated = std::ranges::find_if(guards, [&](const Affine& g) {
      const double size = std::abs(g.constant) + std::abs(g.position * now.x) + std::abs(g.velocity * now.v);
      return value(g, now) < -clearly * size;
    });
    if (violated == guards.end()) return;
    law_.jump(parts.inner, {static_cast<int>(violated - guards.begin())}, now, direction);
  }
}

void ModifiedLaw::jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const {
  OpenParts parts{.inner = memory, .course = memory.course};
  double stored = 0.0;
  if (warms()) {
    parts.power = memory.state.back();
    memory.state.pop_back();
    stored = stored_energy(parts.inner, parts.course, parts.power, now);
  }
  const int own = static_cast<int>(limits_.guards(parts.course, parts.power, now).size());
  if (trigger.cause == Trigger::scheduled) {
    change_by_schedule(parts, now, direction);
  } else if (trigger.cause >= 0 && trigger.cause < own) {
    pass_guard(parts, trigger.cause, now, direction);
  } else {
    const int cause = trigger.cause < 0 ? trigger.cause : trigger.cause - own;
    law_.jump(memory, {cause}, modify(parts, now, direction), direction);
  }
  memory.course = parts.course;
  if (!warms()) return;
  add_heat_of_change(stored, parts, now);
  memory.state.push_back(parts.power);
}

}  // namespace

Law modified(const Law& law, const ParameterValues& values, std::vector<double> limits,
             const WithoutLimits& without, StoredEnergy stored_energy) {
  const ModifierSettings settings(values);
  if (settings.do_nothing()) return law;
  return Law(
      std::make_shared<const ModifiedLaw>(law, settings, std::move(limits), without, std::move(stored_energy)));
}

}  // namespace dualdamp::friction
