#include "tests/support/brute_force.hpp"

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <numbers>

namespace dualdamp::test {

namespace {

using State = std::array<double, 2>;

class Walk {
 public:
  Walk(const sim::Model& model, double kinetic, double static_level)
      : o_(model.oscillator),
        e_(model.excitation),
        kinetic_(kinetic),
        static_(static_level),
        z_{model.initial.position, model.initial.velocity} {
    double fastest = std::max(std::sqrt(o_.stiffness / o_.mass), std::abs(o_.damping) / o_.mass);
    if (e_.is_harmonic()) fastest = std::max(fastest, e_.frequency);
    for (const sim::Harmonic& h : e_.harmonics) fastest = std::max(fastest, h.order * e_.frequency);
    step_ = 2.0 * std::numbers::pi / fastest / 400.0;
  }

  BruteForce run(double duration) {
    direction_ = z_[1] > 0.0 ? 1 : z_[1] < 0.0 ? -1 : 0;
    if (direction_ == 0) settle();
    while (t_ < duration) {
      const double h = std::min(careful(step_), duration - t_);
      if (direction_ == 0) {
        rest(h);
      } else {
        slip(h);
      }
    }
    result_.x = z_[0];
    result_.v = z_[1];
    return result_;
  }

 private:
  /// Force of base and excitation on the mass.
  [[nodiscard]] double drive(double t) const {
    double level = 0.0;
    double rate = 0.0;
    if (e_.is_harmonic()) {
      const auto add = [&](int order, double amplitude, double phase) {
        const double w = order * e_.frequency;
        level += amplitude * std::cos(w * t + phase);
        rate -= amplitude * w * std::sin(w * t + phase);
      };
      add(1, e_.amplitude, e_.phase);
      for (const sim::Harmonic& h : e_.harmonics) add(h.order, h.amplitude, h.phase);
    } else {
      level = e_.slope * t;
      rate = e_.slope;
    }
    const bool base = e_.type == sim::ExcitationType::base_harmonic || e_.type == sim::ExcitationType::base_ramp;
    if (!base) return level + e_.offset;
    return o_.stiffness * level + (o_.damper_to == sim::DamperTo::base ? o_.damping * rate : 0.0);
  }
  [[nodiscard]] double pull(double t) const { return drive(t) - o_.stiffness * z_[0]; }

  [[nodiscard]] State stepped(double h) {
    const auto right = [this](const State& z, State& rate, double t) {
      rate[0] = z[1];
      rate[1] = (drive(t) - o_.damping * z[1] - o_.stiffness * z[0] - direction_ * kinetic_) / o_.mass;
    };
    State z = z_;
    stepper_.do_step(right, z, t_, h);
    return z;
  }

  void settle() {
    const double now = pull(t_);
    direction_ = std::abs(now) <= static_ ? 0 : now > 0.0 ? 1 : -1;
  }

  void note(sim::EventKind kind) { result_.events.push_back({t_, kind, z_[0]}); }

  /// Steps are shortened where something might come and go within one.
  [[nodiscard]] double careful(double h) {
    if (direction_ == 0) return std::abs(std::abs(pull(t_)) - static_) < 0.01 * static_ ? h / 64.0 : h;
    const auto acceleration = [&](const State& z, double t) {
      return direction_ * (drive(t) - o_.damping * z[1] - o_.stiffness * z[0]) - kinetic_;
    };
    const bool turns = acceleration(z_, t_) < 0.0 && acceleration(stepped(h), t_ + h) > 0.0;
    return turns ? h / 64.0 : h;
  }

  void rest(double h) {
    z_[1] = 0.0;
    if (std::abs(pull(t_ + h)) <= static_) {
      t_ += h;
      return;
    }
    double low = 0.0;
    for (double high = h; high - low > 1e-17 * (1.0 + t_);) {
      const double middle = (low + high) / 2.0;
      if (middle <= low || middle >= high) break;
      (std::abs(pull(t_ + middle)) <= static_ ? low : high) = middle;
    }
    t_ += low;
    direction_ = pull(t_) > 0.0 ? 1 : -1;
    note(sim::EventKind::release);
    leave_zero();
  }

  void slip(double h) {
    const State z = stepped(h);
    if (z[1] * direction_ > 0.0) {
      z_ = z;
      t_ += h;
      return;
    }
    double low = 0.0;
    for (double high = h; high - low > 1e-17 * (1.0 + t_);) {
      const double middle = (low + high) / 2.0;
      if (middle <= low || middle >= high) break;
      (stepped(middle)[1] * direction_ > 0.0 ? low : high) = middle;
    }
    z_ = stepped(low);
    z_[1] = 0.0;
    t_ += low;
    settle();
    note(direction_ == 0 ? sim::EventKind::stop : sim::EventKind::reversal);
    if (direction_ != 0) leave_zero();
  }

  /// A step long enough to leave the zero of the velocity, perhaps a double one, well behind.
  void leave_zero() {
    const double h = step_ / 8.0;
    z_ = stepped(h);
    t_ += h;
  }

  sim::Oscillator o_;
  sim::Excitation e_;
  double kinetic_;
  double static_;
  State z_;
  double t_ = 0.0;
  double step_ = 0.0;
  int direction_ = 0;
  boost::numeric::odeint::runge_kutta_fehlberg78<State> stepper_;
  BruteForce result_;
};

}  // namespace

BruteForce follow_coulomb(const sim::Model& model, double kinetic, double static_level, double duration) {
  return Walk(model, kinetic, static_level).run(duration);
}

}  // namespace dualdamp::test
