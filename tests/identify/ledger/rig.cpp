#include "tests/identify/ledger/rig.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dualdamp::identify::testing {

double Rig::omega() const { return std::sqrt(k / m); }
bool Rig::has_rigid_contact() const { return compliance == 0.0 && lugre == 0.0 && play == 0.0; }

namespace {

/// Steps of a natural period. The drive of a history may be faster than the mass, and so is a contact that yields.
constexpr int steps_of_history = 300;
/// Leaves an error of 1e-8 of a motion at one frequency.
constexpr int steps_of_steady_state = 120;

/// x, v of the mass; x, v of the mass that rides on it; deflection of the bristles.
using State = std::array<double, 5>;

class Integrator {
 public:
  Integrator(const Rig& rig, const Drive& drive, double duration, double x0)
      : rig_(rig), drive_(drive), duration_(duration) {
    state_ = {x0, 0.0, x0, 0.0, 0.0};
    slider_ = x0;
    c_ = 2.0 * rig.zeta * std::sqrt(rig.m * rig.k);
    rigid_ = rig.has_rigid_contact();
  }

  /// One step of h, through a reversal where there is one.
  void step(double h) {
    double left = h;
    for (int events = 0; left > 0.0 && events < 20; ++events) {
      if (rigid_ && direction_ == 0) {
        const double drive = drive_(t_);
        const double pull = drive - spring(state_[0], drive) + rider();
        const double limit = friction_limit(0.0);
        if (std::abs(pull) <= limit) {
          const State moved = rungekutta(left);  // the riding mass goes on
          for (std::size_t i = 2; i < 4; ++i) state_[i] = moved[i];
          t_ += left;
          return;
        }
        direction_ = pull > 0.0 ? 1 : -1;
      }
      State next = rungekutta(left);
      if (!rigid_ || next[1] * direction_ >= 0.0) {
        finish(next, left);
        return;
      }
      double low = 0.0;
      double high = left;
      for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (rungekutta(middle)[1] * direction_ < 0.0 ? high : low) = middle;
      }
      next = rungekutta(low);
      next[1] = 0.0;
      finish(next, low);
      left -= std::max(low, 1e-9 * h);
      turn();
    }
  }

  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] double acceleration() const {
    return rigid_ && direction_ == 0 ? 0.0 : slope(state_, drive_(t_))[1];
  }

 private:
  /// Pull of the spring, less the drive of a base that moves.
  [[nodiscard]] double spring(double x, double drive) const {
    const double stretch = (rig_.on_base ? x - drive / rig_.k : x) / rig_.L;
    return rig_.k * (x + rig_.cubic * rig_.L * stretch * stretch * stretch);
  }

  /// Force of the riding mass.
  [[nodiscard]] double rider() const { return rider(state_); }
  [[nodiscard]] double rider(const State& s) const {
    if (rig_.second_mass == 0.0) return 0.0;
    const double mass = rig_.second_mass * rig_.m;
    const double w = rig_.second_ratio * rig_.omega();
    return mass * w * (w * (s[2] - s[0]) + 0.01 * (s[3] - s[1]));
  }

  [[nodiscard]] double friction_limit(double speed) const {
    const double level = rig_.F0 * (1.0 + rig_.drift * (t_ / duration_ - 0.5));
    return rig_.stribeck == 0.0 ? level : level * (1.0 + rig_.stribeck * std::exp(-10.0 * speed / rig_.V));
  }

  [[nodiscard]] double friction(const State& s) const {
    const double v = s[1];
    if (rig_.lugre > 0.0) return rig_.F0 * s[4] / (rig_.lugre * rig_.L);
    if (rig_.compliance > 0.0)
      return rig_.F0 * std::clamp((s[0] - slider_) / (rig_.compliance * rig_.L), -1.0, 1.0);
    if (rig_.play > 0.0) {
      const double way = (s[0] - slider_) / (rig_.play * rig_.L);
      return std::abs(way) < 1.0 ? 0.0 : std::copysign(rig_.F0, way);
    }
    return direction_ * friction_limit(std::abs(v));
  }

  [[nodiscard]] double viscous(double v) const {
    const double u = std::abs(v) / rig_.V;
    const double sign = v < 0.0 ? -1.0 : 1.0;
    return c_ * v * (1.0 + rig_.drag * u + rig_.asymmetry * sign) / (1.0 + rig_.saturation * u);
  }

  [[nodiscard]] State slope(const State& s, double drive) const {
    const double force = drive - spring(s[0], drive) - viscous(s[1]) - friction(s) + rider(s);
    State d{};
    d[0] = s[1];
    d[1] = force / (rig_.m * (1.0 - rig_.second_mass));
    if (rig_.second_mass > 0.0) {
      d[2] = s[3];
      d[3] = -rider(s) / (rig_.second_mass * rig_.m);
    }
    if (rig_.lugre > 0.0) d[4] = s[1] - std::abs(s[1]) * s[4] / (rig_.lugre * rig_.L);
    return d;
  }

  [[nodiscard]] State rungekutta(double h) const {
    const auto moved = [&](const State& by, double share) {
      State s = state_;
      for (std::size_t i = 0; i < s.size(); ++i) s[i] += share * by[i];
      return s;
    };
    const double middle = drive_(t_ + 0.5 * h);
    const State a = slope(state_, drive_(t_));
    const State b = slope(moved(a, 0.5 * h), middle);
    const State c = slope(moved(b, 0.5 * h), middle);
    const State d = slope(moved(c, h), drive_(t_ + h));
    State next = state_;
    for (std::size_t i = 0; i < next.size(); ++i) next[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
    return next;
  }

  void finish(const State& next, double h) {
    state_ = next;
    t_ += h;
    const double reach = (rig_.compliance > 0.0 ? rig_.compliance : rig_.play) * rig_.L;
    if (reach > 0.0) slider_ = std::clamp(slider_, state_[0] - reach, state_[0] + reach);
  }

  /// After a reversal: slip in the other direction, or stick.
  void turn() { direction_ = 0; }

  const Rig& rig_;
  const Drive& drive_;
  double duration_;
  State state_{};
  double t_ = 0.0;
  double c_ = 0.0;
  double slider_ = 0.0;
  int direction_ = 0;
  bool rigid_ = true;
};

}  // namespace

namespace {

Motion motion_in_steps(int steps_per_period, const Rig& rig, const Drive& drive, double duration, double rate,
                       double x0, double settle) {
  Integrator integrator(rig, drive, duration + settle, x0);
  const double fastest = std::max(rig.omega(), rig.second_mass > 0.0 ? rig.second_ratio * rig.omega() : 0.0);
  const double periods = fastest / rate / (2.0 * std::numbers::pi);
  const int parts = std::max(1, static_cast<int>(std::ceil(periods * steps_per_period)));
  const auto skipped = static_cast<std::size_t>(std::lround(settle * rate));
  const auto count = skipped + static_cast<std::size_t>(std::lround(duration * rate)) + 1;
  Motion motion;
  for (std::size_t i = 0; i < count; ++i) {
    if (i >= skipped) {
      motion.x.push_back(integrator.state()[0]);
      motion.v.push_back(integrator.state()[1]);
      motion.a.push_back(integrator.acceleration());
      motion.drive.push_back(drive(static_cast<double>(i) / rate));
    }
    for (int j = 0; j < parts; ++j) integrator.step(1.0 / rate / parts);
  }
  return motion;
}

}  // namespace

Motion motion_of(const Rig& rig, const Drive& drive, double duration, double rate, double x0, double settle) {
  return motion_in_steps(steps_of_history, rig, drive, duration, rate, x0, settle);
}

Steady steady_state(const Rig& rig, double Y, double omega) {
  const double period = 2.0 * std::numbers::pi / omega;
  const double settle = std::ceil(1.5 / rig.zeta + 20.0) * period;
  constexpr int samples = 256;
  const Drive drive = [&](double t) { return rig.k * Y * std::sin(omega * t); };
  const int steps = rig.has_rigid_contact() ? steps_of_steady_state : steps_of_history;
  const Motion motion = motion_in_steps(steps, rig, drive, period, samples / period, 0.0, settle);
  const auto [low, high] = std::ranges::minmax_element(motion.x);
  double in = 0.0;
  double out = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / samples;
    in += motion.x[static_cast<std::size_t>(i)] * std::sin(angle);
    out += motion.x[static_cast<std::size_t>(i)] * std::cos(angle);
  }
  return {0.5 * (*high - *low), std::atan2(-out, in)};
}

}  // namespace dualdamp::identify::testing
