#include "tests/support/law_host.hpp"

#include <algorithm>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>

namespace dualdamp::test {

using friction::Direction;
using friction::Instant;
using friction::Memory;
using friction::Trigger;

namespace {

namespace odeint = boost::numeric::odeint;

constexpr int max_jumps = 32;
constexpr double tolerance = 1e-11;
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
    go(violated, path);
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
    trial.go(t, path);
    // Far past the guard a formula may overflow.
    return trial.worst_guard() >= 0 || trial.broken();
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

/// Dormand and Prince's method on the states, relative to their scales, with work and heat behind them.
void LawHost::integrate(double end, const Path& path) {
  const std::size_t n = memory_.state.size();
  std::vector<double> scales(n);
  law_.scales(memory_, scales);
  std::ranges::replace(scales, 0.0, 1.0);
  Memory memory = memory_;
  const auto unscale = [&](const std::vector<double>& y) {
    for (std::size_t i = 0; i < n; ++i) memory.state[i] = y[i] * scales[i];
  };
  const auto rates = [&](const std::vector<double>& y, std::vector<double>& slope, double t) {
    const Instant now = path(t);
    unscale(y);
    slope[n] = law_.respond(memory, now, direction_, {slope.data(), n}) * now.v;
    slope[n + 1] = law_.dissipation(memory, now, direction_);
    for (std::size_t i = 0; i < n; ++i) slope[i] /= scales[i];
  };
  std::vector<double> y(n + 2);
  for (std::size_t i = 0; i < n; ++i) y[i] = memory_.state[i] / scales[i];
  double t = now_.t;
  double step = end - t;
  auto stepper = odeint::make_controlled<odeint::runge_kutta_dopri5<std::vector<double>>>(tolerance, tolerance);
  while (t < end) {
    const std::vector<double> before = y;
    const double from = t;
    const double tried = step = std::min(step, end - t);
    const bool passed = stepper.try_step(rates, y, t, step) == odeint::success;
    const bool finite = std::ranges::all_of(y, [](double value) { return std::isfinite(value); });
    if (passed && finite) continue;
    if (tried < 1e-12 * (end - now_.t)) return give_up("its states are not finite, or cannot be followed");
    if (finite) continue;
    // A stage far beyond the solution, which the error test does not notice.
    y = before;
    t = from;
    step = tried / 8.0;
    stepper.reset();
  }
  unscale(y);
  memory_ = memory;
  work_ += y[n];
  heat_ += y[n + 1];
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
