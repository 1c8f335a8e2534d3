#include "friction_models/modifiers/modified.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "friction_models/modifiers/fluctuation.hpp"

namespace dualdamp::friction {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Modifiers {
  double drift = 0.0;  ///< 1/s
  double slope = 0.0;  ///< N/m
  double ratio = 0.0;
  double correlation_time = infinity;    ///< s
  double correlation_length = infinity;  ///< m
  std::uint64_t seed = 0;
  double warming_power = infinity;  ///< W
  double warming_time = infinity;   ///< s

  [[nodiscard]] bool warms() const { return warming_power < infinity; }
  [[nodiscard]] bool fluctuates() const { return ratio != 0.0; }
  [[nodiscard]] bool varies_over_position() const { return correlation_length < infinity; }
  [[nodiscard]] bool does_nothing() const { return drift == 0.0 && slope == 0.0 && !fluctuates() && !warms(); }
};

/// What the wrapper remembers beside the law. The level of the present cell is no state that a driver may displace,
/// so all but the power goes into Memory::indices, behind those of the law; the power is the last state.
struct Course {
  bool drift_ended = false;
  int cell = 0;        ///< of the fluctuation, over time or position
  double level = 0.0;  ///< n in this cell
  int side = 1;        ///< sign of x
  int vanished = 0;    ///< limits that are zero, the smallest nominal ones first
  double power = 0.0;  ///< dissipated of late [W]
};

constexpr std::size_t course_size = 6;

/// Beyond rounding, relative.
constexpr double clearly = 1e-12;

Memory joined(Memory memory, const Course& course, bool warms) {
  if (warms) memory.state.push_back(course.power);
  const auto level = std::bit_cast<std::array<int, 2>>(course.level);
  memory.indices.insert(memory.indices.end(), {course.drift_ended ? 1 : 0, course.cell, level[0], level[1],
                                               course.side, course.vanished});
  return memory;
}

/// The memory of the law, and the course.
std::pair<Memory, Course> split(const Memory& memory, bool warms) {
  std::pair<Memory, Course> parts{memory, {}};
  const auto own = memory.indices.end() - static_cast<std::ptrdiff_t>(course_size);
  parts.first.indices.resize(memory.indices.size() - course_size);
  parts.second = {.drift_ended = own[0] != 0,
                  .cell = own[1],
                  .level = std::bit_cast<double>(std::array<int, 2>{own[2], own[3]}),
                  .side = own[4],
                  .vanished = own[5]};
  if (warms) {
    parts.second.power = memory.state.back();
    parts.first.state.pop_back();
  }
  return parts;
}

class ModifiedLaw final : public LawModel {
 public:
  ModifiedLaw(Law law, const Modifiers& modifiers, std::vector<double> limits)
      : law_(std::move(law)), modifiers_(modifiers), limits_(std::move(limits)), fluctuation_(modifiers.seed) {
    std::ranges::sort(limits_);
    const auto repeated = std::ranges::unique(limits_);
    limits_.erase(repeated.begin(), repeated.end());
  }

  [[nodiscard]] double force(const Memory& memory, const Instant& now, Direction direction) const override {
    const auto [inner, course] = parted(memory);
    if (is_gone(course)) return 0.0;
    return law_.force(inner, modify(inner, course, now, direction), direction);
  }

  [[nodiscard]] bool is_modal() const override { return true; }
  [[nodiscard]] Memory start(const Instant& now) const override;
  void guards(const Memory& memory, const Instant& now, Direction direction,
              std::vector<double>& values) const override {
    const auto [inner, course] = parted(memory);
    for (const Affine& guard : own_guards(course, now)) values.push_back(value(guard, now));
    if (!is_gone(course)) law_.guards(inner, modify(inner, course, now, direction), direction, values);
  }
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const override;

  [[nodiscard]] bool holds_mass() const override { return law_.holds_mass(); }
  [[nodiscard]] double static_limit(const Memory& memory, const Instant& now) const override {
    const auto [inner, course] = parted(memory);
    return law_.static_limit(inner, levels(course, now));
  }

  /// Power dissipated is no affine function of the motion.
  [[nodiscard]] bool is_affine() const override { return law_.is_affine() && !modifiers_.warms(); }
  [[nodiscard]] Affine affine_force(const Memory& memory, const Instant& now, Direction direction) const override {
    const auto [inner, course] = parted(memory);
    if (is_gone(course)) return {};
    return law_.affine_force(inner, modify(inner, course, now, direction), direction);
  }
  [[nodiscard]] Affine affine_limit(const Memory& memory, const Instant& now) const override {
    const auto [inner, course] = parted(memory);
    return law_.affine_limit(inner, levels(course, now));
  }
  void affine_guards(const Memory& memory, const Instant& now, Direction direction,
                     std::vector<Affine>& guards) const override {
    const auto [inner, course] = parted(memory);
    for (const Affine& guard : own_guards(course, now)) guards.push_back(guard);
    if (!is_gone(course)) law_.affine_guards(inner, modify(inner, course, now, direction), direction, guards);
  }

  [[nodiscard]] bool has_rates() const override { return law_.has_rates() || modifiers_.warms(); }
  void rates(const Memory& memory, const Instant& now, Direction direction,
             std::span<double> rates) const override {
    static_cast<void>(respond(memory, now, direction, rates));
  }
  [[nodiscard]] double respond(const Memory& memory, const Instant& now, Direction direction,
                               std::span<double> rates) const override;
  void scales(const Memory& memory, std::span<double> scales) const override {
    const std::span<double> inner = scales.first(scales.size() - (modifiers_.warms() ? 1 : 0));
    law_.scales(parted(memory).first, inner);
    if (modifiers_.warms()) scales.back() = modifiers_.warming_power;
  }
  [[nodiscard]] double delay() const override { return law_.delay(); }
  [[nodiscard]] double dissipation(const Memory& memory, const Instant& now, Direction direction) const override {
    const auto [inner, course] = parted(memory);
    return is_gone(course) ? 0.0 : law_.dissipation(inner, modify(inner, course, now, direction), direction);
  }
  [[nodiscard]] bool advances() const override { return law_.advances(); }
  void advance(Memory& memory, const Instant& begin, const Instant& end, double duration,
               Direction direction) const override {
    auto [inner, course] = parted(memory);
    if (is_gone(course)) return;
    const Instant from = modify(inner, course, begin, direction);
    law_.advance(inner, from, modify(inner, course, end, direction), duration, direction);
    memory = joined(std::move(inner), course, modifiers_.warms());
  }

  [[nodiscard]] double next_change(const Memory& memory) const override {
    const auto [inner, course] = parted(memory);
    return std::min({law_.next_change(inner), drift_end(course), cell_end(course)});
  }
  [[nodiscard]] std::string_view aperiodic() const override {
    if (modifiers_.fluctuates() && !modifiers_.varies_over_position())
      return "its force limits fluctuate at random";
    return modifiers_.drift != 0.0 ? "its force limits drift" : law_.aperiodic();
  }

 private:
  [[nodiscard]] std::pair<Memory, Course> parted(const Memory& memory) const {
    return split(memory, modifiers_.warms());
  }
  [[nodiscard]] double fluctuation(const Course& course) const {
    return std::max(0.0, 1.0 + modifiers_.ratio * course.level);
  }
  /// No limit is left: there is no contact, until one returns.
  [[nodiscard]] bool is_gone(const Course& course) const {
    if (modifiers_.slope == 0.0) return course.drift_ended || fluctuation(course) == 0.0;
    return !limits_.empty() && static_cast<std::size_t>(course.vanished) == limits_.size();
  }
  /// The limits now; how fast they move as far as warming has no part in it.
  [[nodiscard]] Instant levels(const Course& course, Instant now) const;
  [[nodiscard]] Instant modify(const Memory& inner, const Course& course, const Instant& now,
                               Direction direction) const;
  [[nodiscard]] double warming_rate(const Memory& inner, const Course& course, const Instant& now,
                                    Direction direction) const;

  [[nodiscard]] double drift_end(const Course& course) const {
    return modifiers_.drift < 0.0 && !course.drift_ended ? -1.0 / modifiers_.drift : infinity;
  }
  [[nodiscard]] double cell_end(const Course& course) const {
    if (modifiers_.varies_over_position()) return infinity;
    return (course.cell + 1) * (modifiers_.correlation_time / Fluctuation::cells_per_correlation);
  }
  /// Cell 0 lies about x = 0, which is a guard of the slope.
  [[nodiscard]] double cell_width() const {
    return modifiers_.correlation_length / Fluctuation::cells_per_correlation;
  }

  [[nodiscard]] std::vector<Affine> own_guards(const Course& course, const Instant& now) const;
  [[nodiscard]] int vanished_limits(const Course& course, const Instant& now) const;
  [[nodiscard]] Instant unclamped(Course course, const Instant& now) const {
    course.vanished = 0;
    return levels(course, now);
  }

  void settle(Memory& inner, const Instant& now, Direction direction) const;
  void pass_kink(Memory& inner, Course& course, int guard, const Instant& now, Direction direction) const;
  void change_by_schedule(Memory& inner, Course& course, const Instant& now, Direction direction) const;
  void step_to(Course next, Memory& inner, Course& course, const Instant& now, Direction direction) const;

  Law law_;
  Modifiers modifiers_;
  std::vector<double> limits_;
  Fluctuation fluctuation_;
};

Memory ModifiedLaw::start(const Instant& now) const {
  Course course{.level = fluctuation_.first(), .side = now.x < 0.0 ? -1 : 1};
  if (modifiers_.varies_over_position()) {
    constexpr double farthest = 1e9;  // an int holds this and a way beyond it
    course.cell = static_cast<int>(std::clamp(std::round(now.x / cell_width()), -farthest, farthest));
    course.level = fluctuation_.at(course.cell);
  }
  return joined(law_.start(levels(course, now)), course, modifiers_.warms());
}

Instant ModifiedLaw::levels(const Course& course, Instant now) const {
  double factor = course.drift_ended ? 0.0 : fluctuation(course);
  if (modifiers_.warms()) factor *= std::exp(-course.power / modifiers_.warming_power);
  now.modification = {
      .factor = (1.0 + modifiers_.drift * now.t) * factor,
      .factor_rate = modifiers_.drift * factor,
      .slope = course.side * modifiers_.slope,
      .vanished = course.vanished == 0 ? -1.0 : limits_[static_cast<std::size_t>(course.vanished) - 1]};
  return now;
}

Instant ModifiedLaw::modify(const Memory& inner, const Course& course, const Instant& now,
                            Direction direction) const {
  Instant modified = levels(course, now);
  if (!modifiers_.warms()) return modified;
  const double rate = warming_rate(inner, course, modified, direction);
  modified.modification.factor_rate -= modified.modification.factor * rate / modifiers_.warming_power;
  return modified;
}

/// d(power)/dt [W/s]. The heat of a stretched spring that relaxes with its limit, of second order in the
/// compliance, is left out: that would take the rate that is sought.
double ModifiedLaw::warming_rate(const Memory& inner, const Course& course, const Instant& now,
                                 Direction direction) const {
  const double heat = is_gone(course) ? 0.0 : law_.dissipation(inner, now, direction);
  return (heat - course.power) / modifiers_.warming_time;
}

double ModifiedLaw::respond(const Memory& memory, const Instant& now, Direction direction,
                            std::span<double> rates) const {
  const auto [inner, course] = parted(memory);
  std::ranges::fill(rates, 0.0);
  const Instant modified = modify(inner, course, now, direction);
  if (modifiers_.warms()) {
    rates.back() = warming_rate(inner, course, levels(course, now), direction);
    rates = rates.first(rates.size() - 1);
  }
  return is_gone(course) ? 0.0 : law_.respond(inner, modified, direction, rates);
}

/// They come before those of the law, which must not see limits below zero: x within its cell; x on its side; and
/// for limits that fall with |x|: the smallest not yet zero, the largest zero already.
std::vector<Affine> ModifiedLaw::own_guards(const Course& course, const Instant& now) const {
  std::vector<Affine> guards;
  if (modifiers_.varies_over_position()) {
    const double high = (course.cell + 0.5) * cell_width();
    const double low = (course.cell - 0.5) * cell_width();
    guards.push_back({.constant = high, .position = -1.0});
    guards.push_back({.constant = -low, .position = 1.0});
  }
  if (modifiers_.slope == 0.0) return guards;
  guards.push_back({.position = static_cast<double>(course.side)});
  if (modifiers_.slope > 0.0) return guards;
  const Instant all = unclamped(course, now);
  const auto zero = static_cast<std::size_t>(course.vanished);
  if (zero < limits_.size()) guards.push_back(all.limit(limits_[zero]));
  if (zero > 0) guards.push_back(-1.0 * all.limit(limits_[zero - 1]));
  return guards;
}

/// How many limits a step leaves at zero; the others go there at a guard.
int ModifiedLaw::vanished_limits(const Course& course, const Instant& now) const {
  if (modifiers_.slope >= 0.0) return course.vanished;
  const Instant all = unclamped(course, now);
  return static_cast<int>(
      std::ranges::count_if(limits_, [&](double limit) { return all.limit_now(limit) <= 0.0; }));
}

/// At a guard of the wrapper: x enters another cell, or the limits go on from the same value.
void ModifiedLaw::pass_kink(Memory& inner, Course& course, int guard, const Instant& now,
                            Direction direction) const {
  if (modifiers_.varies_over_position()) {
    if (guard < 2) {
      Course next = course;
      next.cell += guard == 0 ? 1 : -1;
      next.level = fluctuation_.at(next.cell);
      return step_to(next, inner, course, now, direction);
    }
    guard -= 2;
  }
  if (guard == 0) {
    course.side = -course.side;
    return;
  }
  // A limit that no longer moves may end a slip otherwise than one that does: the law looks again.
  law_.jump(inner, {Trigger::limit_change}, modify(inner, course, now, direction), direction);
  const bool vanishes = guard == 1 && static_cast<std::size_t>(course.vanished) < limits_.size();
  course.vanished += vanishes ? 1 : -1;
}

/// At a time of the schedule.
void ModifiedLaw::change_by_schedule(Memory& inner, Course& course, const Instant& now, Direction direction) const {
  const double due = std::min({law_.next_change(inner), drift_end(course), cell_end(course)});
  if (law_.next_change(inner) == due)
    law_.jump(inner, {Trigger::scheduled}, modify(inner, course, now, direction), direction);
  Course next = course;
  if (drift_end(course) == due) next.drift_ended = true;
  if (cell_end(course) == due) {
    ++next.cell;
    next.level = fluctuation_.after(course.level, next.cell);
  }
  step_to(next, inner, course, now, direction);
}

/// The limits change by a step.
void ModifiedLaw::step_to(Course next, Memory& inner, Course& course, const Instant& now,
                          Direction direction) const {
  next.vanished = vanished_limits(next, now);
  // What slides goes on sliding under a limit that falls.
  const bool looks_again = fluctuation(next) > fluctuation(course) || next.vanished != course.vanished;
  if (looks_again) law_.jump(inner, {Trigger::limit_change}, modify(inner, course, now, direction), direction);
  course = next;
  if (!is_gone(course)) settle(inner, modify(inner, course, now, direction), direction);
}

/// After a step: the law's guards that are clearly violated. So laws that step together need no more events than
/// one.
void ModifiedLaw::settle(Memory& inner, const Instant& now, Direction direction) const {
  std::vector<Affine> guards;
  for (int repeats = 0; repeats < 4; ++repeats) {
    guards.clear();
    law_.affine_guards(inner, now, direction, guards);
    const auto violated = std::ranges::find_if(guards, [&](const Affine& g) {
      const double size = std::abs(g.constant) + std::abs(g.position * now.x) + std::abs(g.velocity * now.v);
      return value(g, now) < -clearly * size;
    });
    if (violated == guards.end()) return;
    law_.jump(inner, {static_cast<int>(violated - guards.begin())}, now, direction);
  }
}

void ModifiedLaw::jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const {
  auto [inner, course] = parted(memory);
  const int own = static_cast<int>(own_guards(course, now).size());
  if (trigger.cause == Trigger::scheduled) {
    change_by_schedule(inner, course, now, direction);
  } else if (trigger.cause >= 0 && trigger.cause < own) {
    pass_kink(inner, course, trigger.cause, now, direction);
  } else {
    const int cause = trigger.cause < 0 ? trigger.cause : trigger.cause - own;
    law_.jump(inner, {cause}, modify(inner, course, now, direction), direction);
  }
  memory = joined(std::move(inner), course, modifiers_.warms());
}

Modifiers modifiers_of(const ParameterValues& values) {
  Modifiers modifiers;
  if (values.has("drift")) modifiers.drift = values.number("drift");
  if (values.has("position_slope")) modifiers.slope = values.number("position_slope");
  if (values.has("fluctuation")) {
    const ParameterValues& fluctuation = values.record("fluctuation");
    modifiers.ratio = fluctuation.number("ratio");
    modifiers.seed = fluctuation.seed("seed");
    const bool over_position = fluctuation.has("correlation_length");
    if (modifiers.fluctuates() && over_position)
      modifiers.correlation_length = fluctuation.number("correlation_length");
    if (modifiers.fluctuates() && !over_position)
      modifiers.correlation_time = fluctuation.number("correlation_time");
  }
  if (values.has("warming")) {
    const ParameterValues& warming = values.record("warming");
    modifiers.warming_power = warming.number("power");
    modifiers.warming_time = warming.number("time_constant");
  }
  return modifiers;
}

}  // namespace

Law modified(const Law& law, const ParameterValues& values, std::vector<double> limits) {
  const Modifiers modifiers = modifiers_of(values);
  if (modifiers.does_nothing()) return law;
  return Law(std::make_shared<const ModifiedLaw>(law, modifiers, std::move(limits)));
}

}  // namespace dualdamp::friction
