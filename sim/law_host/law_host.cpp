#include "sim/law_host/law_host.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>

#include "friction_models/state_sizes.hpp"
#include "sim/steppers/stepper.hpp"

namespace dualdamp::sim {

using friction::Direction;
using friction::Instant;
using friction::Memory;
using friction::Trigger;

namespace {

/// Of their largest value so far: guards below zero by less are at zero.
constexpr double rounding_of_guards = 1e-12;
constexpr int max_events = 1000;  ///< within one call of move_along

/// The states of a law over their scales, followed by work and heat, unless these are left out.
class StatesOnPath final : public VectorField {
 public:
  StatesOnPath(const friction::Law& law, Memory memory, Direction direction, const Path& path, bool has_energy)
      : law_(law),
        memory_(std::move(memory)),
        direction_(direction),
        path_(path),
        has_energy_(has_energy),
        scales_(memory_.state.size()) {
    law_.scales(memory_, scales_);
    // States whose size depends on the motion.
    std::ranges::replace(scales_, 0.0, 1.0);
    std::ranges::replace(scales_, friction::size_of_velocity, 1.0);
  }

  [[nodiscard]] std::size_t size() const override { return scales_.size() + (has_energy_ ? 2 : 0); }
  void evaluate(std::span<const double> y, double t, std::span<double> rates) const override {
    const Instant now = path_(t);
    unscale(y, memory_);
    const std::size_t n = scales_.size();
    if (has_energy_) {
      rates[n] = law_.respond(memory_, now, direction_, rates.first(n)) * now.v;
      rates[n + 1] = law_.dissipation(memory_, now, direction_);
    } else {
      law_.rates(memory_, now, direction_, rates);
    }
    for (std::size_t i = 0; i < n; ++i) rates[i] /= scales_[i];
  }
  /// Of the states by differences; work and heat follow from the states.
  void jacobian(std::span<const double> y, double t, std::span<double> columns) const override {
    const Instant now = path_(t);
    const std::size_t n = scales_.size();
    std::vector<double> base(n);
    std::vector<double> moved(n);
    std::ranges::fill(columns, 0.0);
    unscale(y, memory_);
    law_.rates(memory_, now, direction_, base);
    constexpr double root_of_rounding = 1.5e-8;
    for (std::size_t j = 0; j < n; ++j) {
      const double step = root_of_rounding * std::max(1.0, std::abs(y[j]));
      memory_.state[j] = (y[j] + step) * scales_[j];
      law_.rates(memory_, now, direction_, moved);
      memory_.state[j] = y[j] * scales_[j];
      for (std::size_t i = 0; i < n; ++i) columns[j * size() + i] = (moved[i] - base[i]) / (step * scales_[i]);
    }
  }

  [[nodiscard]] std::vector<double> scaled(const Memory& memory) const {
    std::vector<double> y(size());
    for (std::size_t i = 0; i < scales_.size(); ++i) y[i] = memory.state[i] / scales_[i];
    return y;
  }
  void unscale(std::span<const double> y, Memory& memory) const {
    for (std::size_t i = 0; i < scales_.size(); ++i) memory.state[i] = y[i] * scales_[i];
  }

 private:
  const friction::Law& law_;
  mutable Memory memory_;
  Direction direction_;
  const Path& path_;
  bool has_energy_;
  std::vector<double> scales_;
};

}  // namespace

LawHost::LawHost(const friction::Law& law, const Instant& start)
    : law_(law), place_{.memory = law.start(start), .now = start}, first_velocity_(start.v) {
  place_.now.past_velocity = start.v;
  settle();
}

/// The path; for a law with a delay with the past velocity.
Path LawHost::with_past(const Path& path) {
  if (!(law_.delay() > 0.0)) return path;
  strokes_.push_back({place_.now.t, path});
  return [this, path](double t) {
    Instant now = path(t);
    const double then = t - law_.delay();
    const auto after = std::ranges::upper_bound(strokes_, then, {}, &Stroke::begin);
    now.past_velocity = after == strokes_.begin() ? first_velocity_ : std::prev(after)->path(then).v;
    return now;
  };
}

std::vector<double> LawHost::guards() const {
  std::vector<double> values;
  if (law_.has_memory()) law_.guards(place_.memory, place_.now, direction_, values);
  return values;
}

void LawHost::change_direction(Direction direction) {
  for (const Direction next : {Direction::none, direction}) {
    direction_ = next;
    if (law_.has_memory()) law_.jump(place_.memory, {}, place_.now, direction_);
    settle();
  }
}

void LawHost::move_along(double end, const Path& path) {
  const Path extended = with_past(path);
  for (int events = 0; place_.now.t < end && !place_.broken; ++events) {
    if (events > max_events) return give_up("there is no end of events within one step");
    const double scheduled = law_.next_change(place_.memory);
    const double stop = std::min(end, scheduled);
    go_to_violation(stop, extended);
    if (const int guard = worst_guard(); guard >= 0) {
      law_.jump(place_.memory, {guard}, place_.now, direction_);
    } else if (place_.now.t == scheduled) {
      law_.jump(place_.memory, {Trigger::scheduled}, place_.now, direction_);
      if (!(law_.next_change(place_.memory) > place_.now.t))
        return give_up("a scheduled change is not followed by a later one");
    } else {
      continue;
    }
    ++events_;
    last_event_ = place_.now;
    settle();
  }
}

void LawHost::move_to(double x) {
  const Instant from = place_.now;
  const double length = x - from.x;
  change_direction(friction::direction_of(length));
  move_along(from.t + 1.0, [from, length](double t) { return Instant{t, from.x + length * (t - from.t), length}; });
  place_.now.x = x;
}

/// How far the lowest guard is above zero, as far as rounding allows: below zero, a guard is violated. Far beyond
/// the zero of its guard a formula may overflow: minus infinity.
double LawHost::depth_now() {
  const bool is_violated = worst_guard() >= 0;
  if (place_.broken) return -std::numeric_limits<double>::infinity();
  const double least = guards_.empty() ? place_.guard_size : *std::ranges::min_element(guards_);
  const double depth = least + rounding_of_guards * place_.guard_size;
  constexpr double smallest = std::numeric_limits<double>::min();
  return is_violated ? std::min(depth, -smallest) : std::max(depth, smallest);
}

/// The first time at which a guard is violated; `depth`: at `end`, below zero. By the secant with a
/// weight at the end that stays (Illinois), and by halves where that is slow. Leaves the motion where it is.
double LawHost::time_of_violation(double end, double depth, const Path& path) {
  const Place begin = place_;
  constexpr int most_rounds = 240;  // a third of them halve the bracket
  double low = begin.now.t;
  double high = end;
  double at_low = std::max(0.0, depth_now());
  double at_high = depth;
  int side = 0;
  double last_width = high - low;
  for (int round = 0; round < most_rounds; ++round) {
    const double width = high - low;
    const bool is_slow = round % 3 == 0 && round > 0 && width > 0.5 * last_width;
    if (round % 3 == 0) last_width = width;
    double t = low + width * at_low / (at_low - at_high);
    if (is_slow || !(at_low > 0.0) || !std::isfinite(at_high)) t = low + 0.5 * width;
    // To the last bit: the time must not depend on the sizes of guards that are not violated.
    const double first = std::nextafter(low, high);
    if (!(first < high)) break;
    t = std::clamp(t, first, std::nextafter(high, low));
    place_ = begin;
    go(t, path);
    const double there = depth_now();
    if (steps_ > most_steps_) break;
    if (there < 0.0) {
      high = t;
      at_high = there;
      if (side < 0) at_low *= 0.5;
      side = -1;
    } else {
      low = t;
      at_low = there;
      if (side > 0) at_high *= 0.5;
      side = 1;
    }
  }
  place_ = begin;
  return high;
}

/// Moves to the first time at which a guard is below zero, or to `end`. A guard that is above zero at `end` counts
/// as above zero until then.
void LawHost::go_to_violation(double end, const Path& path) {
  if (!law_.has_memory()) return go(end, path);
  const Place begin = place_;
  go(end, path);
  const double depth = depth_now();
  if (!(depth < 0.0) || steps_ > most_steps_) return;
  place_ = begin;
  go(time_of_violation(end, depth, path), path);
}

void LawHost::go(double end, const Path& path) {
  if (law_.is_affine()) {
    const Instant before = place_.now;
    const double force_before = force();
    place_.now = path(end);
    law_.advance(place_.memory, before, place_.now, end - before.t, direction_);
    place_.work += (force_before + force()) / 2.0 * (place_.now.x - before.x);
  } else {
    integrate(end, path);
    place_.now = path(end);
  }
}

/// Integrates the states, relative to their scales: by explicit steps, and by implicit ones once stability limits
/// those.
void LawHost::integrate(double end, const Path& path) {
  const StatesOnPath field(law_, place_.memory, direction_, path, has_energy_);
  if (!explicit_.stepper) explicit_.stepper = make_explicit_stepper();
  std::unique_ptr<Stepper> implicit;
  Stepper* stepper = explicit_.stepper.get();
  StiffSteps stiff_steps;
  std::vector<double> y = field.scaled(place_.memory);
  std::vector<double> next(y.size());
  std::vector<double> error(y.size());
  std::vector<double> allowed(y.size());
  double t = place_.now.t;
  double h = end - t;
  while (t < end) {
    if (++steps_ > most_steps_) return give_up("its states change too fast to be integrated");
    for (std::size_t i = 0; i < y.size(); ++i) allowed[i] = tolerance_ * (1.0 + std::abs(y[i]));
    const bool is_last = h >= end - t;
    if (is_last) h = end - t;
    double excess = 0.0;
    if (stepper->step(field, y, t, h, allowed, next, error)) {
      for (std::size_t i = 0; i < y.size(); ++i) excess = std::max(excess, std::abs(error[i]) / allowed[i]);
    } else {
      excess = std::numeric_limits<double>::infinity();
    }
    if (excess <= 1.0) {
      t = is_last ? end : t + h;
      y.swap(next);
      stiff_steps.add(stepper->stiffness());
      if (stiff_steps.are_many()) {
        implicit = make_implicit_stepper();
        stepper = implicit.get();
        stiff_steps = {};
      }
    } else if (h < 1e-12 * (end - place_.now.t)) {
      return give_up("its states are not finite, or cannot be integrated");
    }
    h *= std::clamp(0.9 * std::pow(excess, -1.0 / (stepper->order() + 1)), 0.1, 5.0);
  }
  field.unscale(y, place_.memory);
  if (!has_energy_) return;
  place_.work += y[y.size() - 2];
  place_.heat += y.back();
}

/// The guard that is farthest below zero, by more than rounding; -1: none.
int LawHost::worst_guard() {
  guards_.clear();
  if (law_.has_memory()) law_.guards(place_.memory, place_.now, direction_, guards_);
  int worst = -1;
  double least = 0.0;
  for (std::size_t i = 0; i < guards_.size(); ++i) {
    place_.guard_size = std::max(place_.guard_size, std::abs(guards_[i]));
    if (!std::isfinite(guards_[i])) give_up("a guard is not finite");
    if (guards_[i] < std::min(least, -rounding_of_guards * place_.guard_size)) {
      least = guards_[i];
      worst = static_cast<int>(i);
    }
  }
  return worst;
}

void LawHost::settle() {
  for (int i = 0; i <= friction::max_repeats; ++i) {
    const int guard = worst_guard();
    if (guard < 0) return;
    law_.jump(place_.memory, {guard}, place_.now, direction_);
  }
  give_up("jumps do not end within " + std::to_string(friction::max_repeats) + " repeats");
}

void LawHost::give_up(const std::string& fault) {
  place_.faults.push_back(fault);
  place_.broken = true;
}

}  // namespace dualdamp::sim
