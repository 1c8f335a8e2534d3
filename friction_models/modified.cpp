#include "friction_models/modified.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "core/random.hpp"

namespace dualdamp::friction {

namespace {

constexpr double cells_per_correlation_time = 10.0;

/// Away from the draws that a law of the same seed makes itself.
constexpr std::uint32_t fluctuation_stream = 1;

struct Modifiers {
  double drift = 0.0;  ///< 1/s
  double slope = 0.0;  ///< N/m
  double ratio = 0.0;
  double correlation_time = std::numeric_limits<double>::infinity();  ///< s
  std::uint64_t seed = 0;

  [[nodiscard]] bool change_with_time() const { return drift != 0.0 || ratio != 0.0; }
};

/// What the wrapper remembers beside the law. The level of the present cell is no state that a driver may displace,
/// so all of it goes into Memory::indices, behind those of the law.
struct Course {
  bool drift_ended = false;
  int cell = 0;
  double level = 0.0;  ///< n in this cell
  int side = 1;        ///< sign of x
  int vanished = 0;    ///< limits that are zero, the smallest nominal ones first
};

constexpr std::size_t course_size = 6;

/// Beyond rounding, relative.
constexpr double clearly = 1e-12;

Memory joined(Memory memory, const Course& course) {
  const auto level = std::bit_cast<std::array<int, 2>>(course.level);
  memory.indices.insert(memory.indices.end(), {course.drift_ended ? 1 : 0, course.cell, level[0], level[1],
                                               course.side, course.vanished});
  return memory;
}

/// The memory of the law, and the course.
std::pair<Memory, Course> split(const Memory& memory) {
  std::pair<Memory, Course> parts{memory, {}};
  const auto own = memory.indices.end() - static_cast<std::ptrdiff_t>(course_size);
  parts.first.indices.resize(memory.indices.size() - course_size);
  parts.second = {.drift_ended = own[0] != 0,
                  .cell = own[1],
                  .level = std::bit_cast<double>(std::array<int, 2>{own[2], own[3]}),
                  .side = own[4],
                  .vanished = own[5]};
  return parts;
}

class ModifiedLaw final : public LawModel {
 public:
  ModifiedLaw(Law law, const Modifiers& modifiers, std::vector<double> limits)
      : law_(std::move(law)),
        modifiers_(modifiers),
        limits_(std::move(limits)),
        draws_{modifiers.seed, fluctuation_stream} {
    std::ranges::sort(limits_);
    const auto repeated = std::ranges::unique(limits_);
    limits_.erase(repeated.begin(), repeated.end());
  }

  [[nodiscard]] double force(const Memory& memory, const Instant& now, Direction direction) const override {
    const auto [inner, course] = split(memory);
    if (is_gone(course)) return 0.0;
    return law_.force(inner, modify(course, now), direction);
  }

  [[nodiscard]] bool is_modal() const override { return true; }
  [[nodiscard]] Memory start(const Instant& now) const override {
    const Course course{.level = draws_.normal(0), .side = now.x < 0.0 ? -1 : 1};
    return joined(law_.start(modify(course, now)), course);
  }
  void guards(const Memory& memory, const Instant& now, Direction direction,
              std::vector<double>& values) const override {
    const auto [inner, course] = split(memory);
    for (const Affine& guard : own_guards(course, now)) values.push_back(value(guard, now));
    if (!is_gone(course)) law_.guards(inner, modify(course, now), direction, values);
  }
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction direction) const override;

  [[nodiscard]] bool holds_mass() const override { return law_.holds_mass(); }
  [[nodiscard]] double static_limit(const Memory& memory, const Instant& now) const override {
    const auto [inner, course] = split(memory);
    return law_.static_limit(inner, modify(course, now));
  }

  [[nodiscard]] bool is_affine() const override { return law_.is_affine(); }
  [[nodiscard]] Affine affine_force(const Memory& memory, const Instant& now, Direction direction) const override {
    const auto [inner, course] = split(memory);
    if (is_gone(course)) return {};
    return law_.affine_force(inner, modify(course, now), direction);
  }
  [[nodiscard]] Affine affine_limit(const Memory& memory, const Instant& now) const override {
    const auto [inner, course] = split(memory);
    return law_.affine_limit(inner, modify(course, now));
  }
  void affine_guards(const Memory& memory, const Instant& now, Direction direction,
                     std::vector<Affine>& guards) const override {
    const auto [inner, course] = split(memory);
    for (const Affine& guard : own_guards(course, now)) guards.push_back(guard);
    if (!is_gone(course)) law_.affine_guards(inner, modify(course, now), direction, guards);
  }

  [[nodiscard]] bool has_rates() const override { return law_.has_rates(); }
  void rates(const Memory& memory, const Instant& now, Direction direction,
             std::span<double> rates) const override {
    const auto [inner, course] = split(memory);
    std::ranges::fill(rates, 0.0);
    if (is_gone(course)) return;
    law_.rates(inner, modify(course, now), direction, rates);
  }
  [[nodiscard]] double respond(const Memory& memory, const Instant& now, Direction direction,
                               std::span<double> rates) const override {
    const auto [inner, course] = split(memory);
    std::ranges::fill(rates, 0.0);
    return is_gone(course) ? 0.0 : law_.respond(inner, modify(course, now), direction, rates);
  }
  void scales(const Memory& memory, std::span<double> scales) const override {
    law_.scales(split(memory).first, scales);
  }
  [[nodiscard]] double delay() const override { return law_.delay(); }
  [[nodiscard]] double dissipation(const Memory& memory, const Instant& now, Direction direction) const override {
    const auto [inner, course] = split(memory);
    return is_gone(course) ? 0.0 : law_.dissipation(inner, modify(course, now), direction);
  }
  [[nodiscard]] bool advances() const override { return law_.advances(); }
  void advance(Memory& memory, const Instant& begin, const Instant& end, double duration,
               Direction direction) const override {
    auto [inner, course] = split(memory);
    if (is_gone(course)) return;
    law_.advance(inner, modify(course, begin), modify(course, end), duration, direction);
    memory = joined(std::move(inner), course);
  }

  [[nodiscard]] double next_change(const Memory& memory) const override {
    const auto [inner, course] = split(memory);
    return std::min({law_.next_change(inner), drift_end(course), cell_end(course)});
  }
  [[nodiscard]] std::string_view aperiodic() const override {
    if (modifiers_.ratio != 0.0) return "its force limits fluctuate at random";
    return modifiers_.drift != 0.0 ? "its force limits drift" : law_.aperiodic();
  }

 private:
  [[nodiscard]] double fluctuation(const Course& course) const {
    return std::max(0.0, 1.0 + modifiers_.ratio * course.level);
  }
  /// No limit is left: there is no contact, until one returns.
  [[nodiscard]] bool is_gone(const Course& course) const {
    if (modifiers_.slope == 0.0) return course.drift_ended || fluctuation(course) == 0.0;
    return !limits_.empty() && static_cast<std::size_t>(course.vanished) == limits_.size();
  }
  [[nodiscard]] Instant modify(const Course& course, Instant now) const {
    const double factor = course.drift_ended ? 0.0 : fluctuation(course);
    now.modification = {
        .factor = (1.0 + modifiers_.drift * now.t) * factor,
        .factor_rate = modifiers_.drift * factor,
        .slope = course.side * modifiers_.slope,
        .vanished = course.vanished == 0 ? -1.0 : limits_[static_cast<std::size_t>(course.vanished) - 1]};
    return now;
  }

  [[nodiscard]] double drift_end(const Course& course) const {
    return modifiers_.drift < 0.0 && !course.drift_ended ? -1.0 / modifiers_.drift
                                                         : std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] double cell_end(const Course& course) const {
    return (course.cell + 1) * (modifiers_.correlation_time / cells_per_correlation_time);
  }

  /// They come before those of the law, which must not see limits below zero: x on its side; and for limits that
  /// fall with |x|: the smallest not yet zero, the largest zero already.
  [[nodiscard]] std::vector<Affine> own_guards(const Course& course, const Instant& now) const {
    if (modifiers_.slope == 0.0) return {};
    std::vector<Affine> guards = {{.position = static_cast<double>(course.side)}};
    if (modifiers_.slope > 0.0) return guards;
    Course all = course;
    all.vanished = 0;
    const Instant unclamped = modify(all, now);
    const auto zero = static_cast<std::size_t>(course.vanished);
    if (zero < limits_.size()) guards.push_back(unclamped.limit(limits_[zero]));
    if (zero > 0) guards.push_back(-1.0 * unclamped.limit(limits_[zero - 1]));
    return guards;
  }

  /// How many limits a step leaves at zero; the others go there at a guard.
  [[nodiscard]] int vanished_limits(const Course& course, const Instant& now) const {
    if (modifiers_.slope >= 0.0) return course.vanished;
    Course all = course;
    all.vanished = 0;
    const Instant unclamped = modify(all, now);
    return static_cast<int>(
        std::ranges::count_if(limits_, [&](double limit) { return unclamped.limit_now(limit) <= 0.0; }));
  }

  void settle(Memory& inner, const Instant& now, Direction direction) const;
  void pass_kink(Memory& inner, Course& course, int guard, const Instant& now, Direction direction) const;
  void change_step(Memory& inner, Course& course, const Instant& now, Direction direction) const;

  Law law_;
  Modifiers modifiers_;
  std::vector<double> limits_;
  core::RandomStream draws_;
};

/// At a guard of the wrapper: the limits go on from the same value.
void ModifiedLaw::pass_kink(Memory& inner, Course& course, int guard, const Instant& now,
                            Direction direction) const {
  if (guard == 0) {
    course.side = -course.side;
    return;
  }
  // A limit that no longer moves may end a slip otherwise than one that does: the law looks again.
  law_.jump(inner, {Trigger::limit_change}, modify(course, now), direction);
  const bool vanishes = guard == 1 && static_cast<std::size_t>(course.vanished) < limits_.size();
  course.vanished += vanishes ? 1 : -1;
}

/// At a time of the schedule.
void ModifiedLaw::change_step(Memory& inner, Course& course, const Instant& now, Direction direction) const {
  const double due = std::min({law_.next_change(inner), drift_end(course), cell_end(course)});
  const Instant old = modify(course, now);
  if (law_.next_change(inner) == due) law_.jump(inner, {Trigger::scheduled}, old, direction);
  Course next = course;
  if (drift_end(course) == due) next.drift_ended = true;
  if (cell_end(course) == due) {
    const double correlation = std::exp(-1.0 / cells_per_correlation_time);
    const double draw = draws_.normal(static_cast<std::uint64_t>(++next.cell));
    next.level = correlation * course.level + std::sqrt(1.0 - correlation * correlation) * draw;
  }
  next.vanished = vanished_limits(next, now);
  // What slides goes on sliding under a limit that falls.
  const bool looks_again = fluctuation(next) > fluctuation(course) || next.vanished != course.vanished;
  if (looks_again) law_.jump(inner, {Trigger::limit_change}, old, direction);
  course = next;
  if (!is_gone(course)) settle(inner, modify(course, now), direction);
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
  auto [inner, course] = split(memory);
  const int own = static_cast<int>(own_guards(course, now).size());
  if (trigger.cause == Trigger::scheduled) {
    change_step(inner, course, now, direction);
  } else if (trigger.cause >= 0 && trigger.cause < own) {
    pass_kink(inner, course, trigger.cause, now, direction);
  } else {
    const int cause = trigger.cause < 0 ? trigger.cause : trigger.cause - own;
    law_.jump(inner, {cause}, modify(course, now), direction);
  }
  memory = joined(std::move(inner), course);
}

}  // namespace

Law modified(const Law& law, const ParameterValues& values, std::vector<double> limits) {
  Modifiers modifiers;
  if (values.has("drift")) modifiers.drift = values.number("drift");
  if (values.has("position_slope")) modifiers.slope = values.number("position_slope");
  if (values.has("fluctuation")) {
    const ParameterValues& fluctuation = values.record("fluctuation");
    modifiers.ratio = fluctuation.number("ratio");
    modifiers.seed = fluctuation.seed("seed");
    if (modifiers.ratio != 0.0) modifiers.correlation_time = fluctuation.number("correlation_time");
  }
  if (!modifiers.change_with_time() && modifiers.slope == 0.0) return law;
  return Law(std::make_shared<const ModifiedLaw>(law, modifiers, std::move(limits)));
}

}  // namespace dualdamp::friction
