#include "tests/support/law_host.hpp"

#include <algorithm>
#include <cmath>

namespace dualdamp::test {

using friction::Direction;
using friction::Instant;
using friction::Memory;
using friction::Trigger;

namespace {

constexpr int max_jumps = 32;
constexpr int max_events = 1000;  ///< within one call of follow

}  // namespace

LawHost::LawHost(const friction::Law& law, const Instant& start)
    : law_(law), memory_(law.start(start)), now_(start) {
  settle();
}

std::vector<double> LawHost::guards() const {
  std::vector<double> values;
  if (law_.is_modal()) law_.guards(memory_, now_, direction_, values);
  return values;
}

void LawHost::turn(Direction direction) {
  for (const Direction next : {Direction::rest, direction}) {
    direction_ = next;
    if (law_.is_modal()) law_.jump(memory_, {}, now_, direction_);
    settle();
  }
}

void LawHost::follow(double end, const Path& path) {
  for (int events = 0; now_.t < end && !broken_; ++events) {
    if (events > max_events) return give_up("there is no end of events within one step");
    const double scheduled = law_.next_change(memory_);
    const double stop = std::min(end, scheduled);
    const double violated = time_of_violation(stop, path);
    pass(path(violated));
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
  turn(length > 0.0 ? Direction::forward : length < 0.0 ? Direction::backward : Direction::rest);
  follow(from.t + 1.0, [&](double t) { return Instant{t, from.x + length * (t - from.t), length}; });
  now_.x = x;
}

/// The first moment at which a guard is below zero, or `end`. It looks at the end only for whether there is one.
double LawHost::time_of_violation(double end, const Path& path) const {
  const auto violated = [&](double t) {
    LawHost trial = *this;
    trial.go(path(t));
    return trial.worst_guard() >= 0;
  };
  if (!violated(end)) return end;
  double low = now_.t;
  double high = end;
  for (int i = 0; i < 80; ++i) {
    const double t = (low + high) / 2.0;
    (violated(t) ? high : low) = t;
  }
  return high;
}

void LawHost::pass(const Instant& end) {
  const double force_before = force();
  const double x_before = now_.x;
  go(end);
  work_ += (force_before + force()) / 2.0 * (now_.x - x_before);
}

void LawHost::go(const Instant& end) {
  if (law_.is_affine()) {
    law_.advance(memory_, now_, end, end.t - now_.t, direction_);
  } else if (law_.has_rates()) {
    integrate(end);
  }
  now_ = end;
}

/// Runge and Kutta's fourth order, with the speed varying linearly.
void LawHost::integrate(const Instant& end) {
  const std::size_t n = memory_.state.size();
  const double h = end.t - now_.t;
  const auto rates = [&](const std::vector<double>& state, double part) {
    Memory memory = memory_;
    memory.state = state;
    const Instant now{now_.t + part * h, now_.x + part * (end.x - now_.x), now_.v + part * (end.v - now_.v)};
    std::vector<double> result(n);
    law_.rates(memory, now, direction_, result);
    return result;
  };
  const auto moved = [&](const std::vector<double>& slope, double step) {
    std::vector<double> state = memory_.state;
    for (std::size_t i = 0; i < n; ++i) state[i] += step * slope[i];
    return state;
  };
  const std::vector<double> k1 = rates(memory_.state, 0.0);
  const std::vector<double> k2 = rates(moved(k1, h / 2.0), 0.5);
  const std::vector<double> k3 = rates(moved(k2, h / 2.0), 0.5);
  const std::vector<double> k4 = rates(moved(k3, h), 1.0);
  for (std::size_t i = 0; i < n; ++i) memory_.state[i] += h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
}

/// The guard farthest below zero beyond rounding; -1: none.
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

}  // namespace dualdamp::test
