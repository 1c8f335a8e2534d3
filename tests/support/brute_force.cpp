#include "tests/support/brute_force.hpp"

#include <algorithm>
#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/sampled_signal.hpp"
#include "tests/support/plain_interval.hpp"

namespace dualdamp::test {

namespace {

using State = std::array<double, 2>;

/// A guard has been crossed if it is below zero by more than this, relative to its parts.
constexpr double crossed = 1e-13;

/// > 0 while the mode holds.
struct Guard {
  NextEvent event;
  double value = 0.0;
  double rate = 0.0;  ///< d(value)/dt
  double parts = 0.0;

  [[nodiscard]] bool is_crossed() const { return value < -crossed * parts; }
};

class Walk {
 public:
  Walk(const sim::Model& model, const PlainFriction& friction)
      : model_(model), friction_(friction), mass_{.x = model.initial.position, .v = model.initial.velocity} {
    const sim::Oscillator& o = model.oscillator;
    double stiffness = o.stiffness;
    double damping = std::abs(o.damping);
    double fastest = 0.0;
    for (const Spring& s : friction.springs) {
      stiffness += s.stiffness;
      damping += s.damping;
    }
    for (const DampedContact& c : friction.contacts) {
      stiffness += c.stiffness;
      damping += c.damping;
      fastest = std::max(fastest, c.decay());
    }
    fastest = std::max({fastest, std::sqrt(stiffness / o.mass), damping / o.mass});
    const sim::Excitation& e = model.excitation;
    if (e.is_harmonic()) fastest = std::max(fastest, e.frequency);
    for (const sim::Harmonic& h : e.harmonics) fastest = std::max(fastest, h.order * e.frequency);
    step_ = 2.0 * std::numbers::pi / fastest / 400.0;
  }

  BruteForce run(double duration) {
    mass_.direction = mass_.v > 0.0 ? 1 : mass_.v < 0.0 ? -1 : 0;
    if (mass_.direction == 0) take_place(model_, {}, friction_, mass_);
    while (mass_.t < duration) {
      const double h = mass_.t < fine_until_ ? step_ / 64.0 : step_;
      step(std::min({h, duration - mass_.t, left_in_piece()}));
    }
    result_.x = mass_.x;
    result_.v = mass_.v;
    return result_;
  }

 private:
  /// Time to the next node of a sampled drive; a node within rounding of the present time is skipped.
  [[nodiscard]] double left_in_piece() {
    if (model_.excitation.samples == nullptr) return step_;
    const std::vector<double>& nodes = model_.excitation.samples->times();
    while (piece_ + 1 < nodes.size() && nodes[piece_ + 1] - mass_.t < 1e-13 * nodes[piece_ + 1]) ++piece_;
    return piece_ + 1 < nodes.size() ? nodes[piece_ + 1] - mass_.t : step_;
  }

  /// Force of base and excitation on the mass.
  [[nodiscard]] double drive(double t) const {
    const sim::Oscillator& o = model_.oscillator;
    const sim::Excitation& e = model_.excitation;
    double level = 0.0;
    double rate = 0.0;
    if (e.is_harmonic()) {
      const auto add = [&](int order, double amplitude, double phase) {
        const double w = order * e.frequency;
        level += amplitude * std::cos(w * t + phase);
        rate -= amplitude * w * std::sin(w * t + phase);
      };
      add(1, e.amplitude, e.phase);
      for (const sim::Harmonic& h : e.harmonics) add(h.order, h.amplitude, h.phase);
    } else if (e.samples != nullptr) {
      std::tie(level, rate) = sampled_drive(*e.samples, piece_, t);
    } else {
      level = e.slope * t;
      rate = e.slope;
    }
    const bool base = e.type == sim::ExcitationType::base_harmonic || e.type == sim::ExcitationType::base_ramp ||
                      e.type == sim::ExcitationType::base_samples;
    if (!base) return level + e.offset;
    return o.stiffness * level + (o.damper_to == sim::DamperTo::base ? o.damping * rate : 0.0);
  }

  [[nodiscard]] double net_force(const LinearForce& friction, double t, double x, double v) const {
    const sim::Oscillator& o = model_.oscillator;
    return drive(t) - o.damping * v - o.stiffness * x -
           (friction.constant + friction.stiffness * x + friction.damping * v);
  }

  [[nodiscard]] MassState after(double h) {
    MassState next = mass_;
    next.t += h;
    if (mass_.direction == 0) return next;
    const LinearForce friction = friction_.force(mass_.direction);
    const auto right = [&](const State& z, State& rate, double t) {
      rate[0] = z[1];
      rate[1] = net_force(friction, t, z[0], z[1]) / model_.oscillator.mass;
    };
    State z = {mass_.x, mass_.v};
    stepper_.do_step(right, z, mass_.t, h);
    next.x = z[0];
    next.v = z[1];
    return next;
  }

  /// At a state of the present mode, h after its start.
  void list_guards(const MassState& at, double h, std::vector<Guard>& guards) const {
    guards.clear();
    const LinearForce friction = friction_.force(at.direction);
    const double force = net_force(friction, at.t, at.x, at.v);
    const double acceleration = at.direction == 0 ? 0.0 : force / model_.oscillator.mass;
    if (at.direction == 0) {
      const double d = step_ / 64.0;
      const double rate = (drive(at.t + d) - drive(at.t - d)) / (2.0 * d);
      for (const int side : {1, -1}) {
        const double spare = friction_.static_level - side * force;
        guards.push_back(
            {{.what = NextEvent::What::release, .side = side}, spare, -side * rate, friction_.static_level});
      }
    } else {
      guards.push_back({{}, at.direction * at.v, at.direction * acceleration, speed_});
      const int side = at.direction;
      const double edge = friction_.edge(side);
      guards.push_back(
          {{.what = NextEvent::What::spring, .side = side}, side * (edge - at.x), -side * at.v, length_});
    }
    for (std::size_t i = 0; i < friction_.contacts.size(); ++i) {
      DampedContact c = friction_.contacts[i];
      c.relax(h);
      const double moving = c.decay() * (c.settled() - c.stretch);
      if (c.side != 0) {
        const double stopped = at.direction == 0 ? c.stopped() : 0.0;
        guards.push_back({{.what = NextEvent::What::contact, .contact = i},
                          c.side * (at.v - moving) - stopped,
                          c.side * (acceleration + c.decay() * moving),
                          at.direction == 0 ? c.stopped() : speed_ + c.decay() * length_});
        continue;
      }
      for (const int side : {1, -1}) {
        const double f = c.stiffness * (at.x - c.foot) + c.damping * at.v;
        const double rate = c.stiffness * at.v + c.damping * acceleration;
        guards.push_back({{.what = NextEvent::What::contact, .side = side, .contact = i},
                          c.static_level - side * f,
                          -side * rate,
                          c.static_level});
      }
    }
  }

  /// The first guard crossed after h; null: none.
  [[nodiscard]] const Guard* crossed_after(double h) {
    list_guards(after(h), h, guards_);
    const auto first = std::ranges::find_if(guards_, &Guard::is_crossed);
    return first == guards_.end() ? nullptr : &*first;
  }

  void step(double h) {
    list_guards(mass_, 0.0, before_);
    if (crossed_after(h) != nullptr) return pass_event(h);
    const bool fine = mass_.t < fine_until_;
    for (std::size_t i = 0; i < guards_.size() && !fine; ++i) {
      if (before_[i].rate < 0.0 && guards_[i].rate > 0.0) {
        fine_until_ = mass_.t + h;
        return;
      }
    }
    advance(h);
  }

  void pass_event(double h) {
    double low = 0.0;
    double high = h;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2.0;
      (crossed_after(middle) != nullptr ? high : low) = middle;
    }
    const NextEvent event = crossed_after(high)->event;
    advance(high);
    note(take_place(model_, event, friction_, mass_));
    // A spring that is stretched to its reach lets go as soon as the mass moves.
    while (mass_.direction != 0 && std::abs(friction_.edge(mass_.direction) - mass_.x) <= crossed * length_) {
      friction_.let_go(mass_.direction);
      note(sim::EventKind::switching);
    }
  }

  void advance(double h) {
    mass_ = after(h);
    friction_.relax(h);
    speed_ = std::max(speed_, std::abs(mass_.v));
    length_ = std::max(length_, std::abs(mass_.x));
  }

  void note(sim::EventKind kind) { result_.events.push_back({mass_.t, kind, mass_.x}); }

  const sim::Model& model_;
  PlainFriction friction_;
  MassState mass_;
  double step_ = 0.0;
  double fine_until_ = 0.0;
  std::size_t piece_ = 0;              ///< of a sampled drive
  double speed_ = std::abs(mass_.v);   ///< the largest so far [m/s]
  double length_ = std::abs(mass_.x);  ///< of the position [m]
  std::vector<Guard> before_;
  std::vector<Guard> guards_;
  boost::numeric::odeint::runge_kutta_fehlberg78<State> stepper_;
  BruteForce result_;
};

}  // namespace

BruteForce follow(const sim::Model& model, const PlainFriction& friction, double duration) {
  return Walk(model, friction).run(duration);
}

}  // namespace dualdamp::test
