#include "sim/law_host/law_host.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "friction_models/state_sizes.hpp"
#include "sim/steppers/stepper.hpp"

namespace dualdamp::sim {

using friction::Direction;
using friction::Instant;
using friction::Memory;
using friction::Trigger;

namespace {

constexpr int max_jumps = 32;
constexpr double tolerance = 1e-12;
constexpr int max_events = 1000;  ///< within one call of move_along

/// The states of a law over their scales, followed by work and heat.
class StatesOnPath final : public VectorField {
 public:
  StatesOnPath(const friction::Law& law, Memory memory, Direction direction, const Path& path)
      : law_(law), memory_(std::move(memory)), direction_(direction), path_(path), scales_(memory_.state.size()) {
    law_.scales(memory_, scales_);
    // States whose size depends on the motion.
    std::ranges::replace(scales_, 0.0, 1.0);
    std::ranges::replace(scales_, friction::size_of_velocity, 1.0);
  }

  [[nodiscard]] std::size_t size() const override { return scales_.size() + 2; }
  void evaluate(std::span<const double> y, double t, std::span<double> rates) const override {
    const Instant now = path_(t);
    unscale(y, memory_);
    const std::size_t n = scales_.size();
    rates[n] = law_.respond(memory_, now, direction_, rates.first(n)) * now.v;
    rates[n + 1] = law_.dissipation(memory_, now, direction_);
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
  std::vector<double> scales_;
};

}  // namespace

LawHost::LawHost(const friction::Law& law, const Instant& start)
    : law_(law), memory_(law.start(start)), now_(start), first_velocity_(start.v) {
  now_.past_velocity = start.v;
  settle();
}

/// The path; for a law with a delay with the past velocity.
Path LawHost::with_past(const Path& path) {
  if (!(law_.delay() > 0.0)) return path;
  strokes_.push_back({now_.t, path});
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
  if (law_.has_memory()) law_.guards(memory_, now_, direction_, values);
  return values;
}

void LawHost::change_direction(Direction direction) {
  for (const Direction next : {Direction::none, direction}) {
    direction_ = next;
    if (law_.has_memory()) law_.jump(memory_, {}, now_, direction_);
    settle();
  }
}

void LawHost::move_along(double end, const Path& path) {
  const Path extended = with_past(path);
  for (int events = 0; now_.t < end && !broken_; ++events) {
    if (events > max_events) return give_up("there is no end of events within one step");
    const double scheduled = law_.next_change(memory_);
    const double stop = std::min(end, scheduled);
    go_to_violation(stop, extended);
    if (const int guard = worst_guard(); guard >= 0) {
      law_.jump(memory_, {guard}, now_, direction_);
    } else if (now_.t == scheduled) {
      law_.jump(memory_, {Trigger::scheduled}, now_, direction_);
      if (!(law_.next_change(memory_) > now_.t))
        return give_up("a scheduled change is not followed by a later one");
    } else {
      continue;
    }
    ++events_;
    last_event_ = now_;
    settle();
  }
}

void LawHost::move_to(double x) {
  const Instant from = now_;
  const double length = x - from.x;
  change_direction(friction::direction_of(length));
  move_along(from.t + 1.0, [from, length](double t) { return Instant{t, from.x + length * (t - from.t), length}; });
  now_.x = x;
}

/// Moves to the first time at which a guard is below zero, or to `end`. A guard that is above zero at `end` counts
/// as above zero until then.
void LawHost::go_to_violation(double end, const Path& path) {
  if (!law_.has_memory()) return go(end, path);
  const auto try_to = [&](LawHost& trial, double t) {
    trial.go(t, path);
    steps_ = trial.steps_;
    // Far beyond the zero of its guard a formula may overflow.
    return trial.worst_guard() >= 0 || trial.broken();
  };
  LawHost whole = *this;
  if (!try_to(whole, end)) {
    *this = std::move(whole);
    return;
  }
  const auto violated = [&](double t) {
    LawHost trial = *this;
    return try_to(trial, t);
  };
  double low = now_.t;
  double high = end;
  for (int i = 0; i < 80; ++i) {
    const double t = (low + high) / 2.0;
    (violated(t) ? high : low) = t;
  }
  go(high, path);
}

void LawHost::go(double end, const Path& path) {
  if (law_.is_affine()) {
    const Instant before = now_;
    const double force_before = force();
    now_ = path(end);
    law_.advance(memory_, before, now_, end - before.t, direction_);
    work_ += (force_before + force()) / 2.0 * (now_.x - before.x);
  } else {
    integrate(end, path);
    now_ = path(end);
  }
}

/// Integrates the states, relative to their scales: by explicit steps, and by implicit ones once stability limits
/// those.
void LawHost::integrate(double end, const Path& path) {
  const StatesOnPath field(law_, memory_, direction_, path);
  auto stepper = make_explicit_stepper();
  StiffSteps stiff_steps;
  std::vector<double> y = field.scaled(memory_);
  std::vector<double> next(y.size());
  std::vector<double> error(y.size());
  std::vector<double> allowed(y.size());
  double t = now_.t;
  double h = end - t;
  while (t < end) {
    if (++steps_ > most_steps_) return give_up("its states change too fast to be integrated");
    for (std::size_t i = 0; i < y.size(); ++i) allowed[i] = tolerance * (1.0 + std::abs(y[i]));
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
        stepper = make_implicit_stepper();
        stiff_steps = {};
      }
    } else if (h < 1e-12 * (end - now_.t)) {
      return give_up("its states are not finite, or cannot be integrated");
    }
    h *= std::clamp(0.9 * std::pow(excess, -1.0 / (stepper->order() + 1)), 0.1, 5.0);
  }
  field.unscale(y, memory_);
  work_ += y[y.size() - 2];
  heat_ += y.back();
}

/// The guard that is farthest below zero, by more than rounding; -1: none.
int LawHost::worst_guard() {
  const std::vector<double> values = guards();
  int worst = -1;
  double least = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    guard_size_ = std::max(guard_size_, std::abs(values[i]));
    if (!std::isfinite(values[i])) give_up("a guard is not finite");
    if (values[i] < std::min(least, -1e-12 * guard_size_)) {
      least = values[i];
      worst = static_cast<int>(i);
    }
  }
  return worst;
}

void LawHost::settle() {
  for (int i = 0; i <= max_jumps; ++i) {
    const int guard = worst_guard();
    if (guard < 0) return;
    law_.jump(memory_, {guard}, now_, direction_);
  }
  give_up("jumps do not end within 32 repeats");
}

void LawHost::give_up(const std::string& fault) {
  faults_.push_back(fault);
  broken_ = true;
}

}  // namespace dualdamp::sim
