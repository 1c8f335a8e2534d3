#include "tests/support/plain_interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace dualdamp::test {

namespace {

using oracle::ExponentialSum;
using oracle::LongComplex;
using oracle::Real;

constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
/// A guard counts as zero at the start if it is closer to zero than this, relative to its parts.
constexpr double at_zero = 1e-12;

}  // namespace

std::pair<double, double> sampled_drive(const sim::SampledSignal& samples, std::size_t piece, double t) {
  const double value = samples.values()[piece];
  if (samples.interpolation() == sim::Interpolation::step || piece + 1 == samples.times().size())
    return {value, 0.0};
  const double from = samples.times()[piece];
  const double rate = (samples.values()[piece + 1] - value) / (samples.times()[piece + 1] - from);
  return {value + rate * (t - from), rate};
}

sim::EventKind take_place(const sim::Model& model, const NextEvent& event, PlainFriction& friction,
                          MassState& mass) {
  switch (event.what) {
    case NextEvent::What::release:
      mass.direction = event.side;
      return sim::EventKind::release;
    case NextEvent::What::spring:
      friction.let_go(event.side);
      return sim::EventKind::switching;
    case NextEvent::What::contact: {
      DampedContact& contact = friction.contacts[event.contact];
      if (contact.side == 0) {
        contact.break_away(event.side, mass.x);
      } else {
        contact.stick(mass.x);
      }
      return sim::EventKind::switching;
    }
    case NextEvent::What::reversal:
      break;
  }
  mass.v = 0.0;
  mass.direction = 0;
  friction.reverse(mass.x);
  const double pull = PlainInterval(model, friction, mass).net_force();
  if (std::abs(pull) <= friction.static_level) return sim::EventKind::stop;
  mass.direction = pull > 0.0 ? 1 : -1;
  return sim::EventKind::reversal;
}

PlainInterval::PlainInterval(const sim::Model& model, const PlainFriction& friction, const MassState& from)
    : model_(model), friction_(friction), from_(from), force_(friction.force(from.direction)) {
  const sim::Oscillator& o = model.oscillator;
  problem_ = {.mass = o.mass,
              .damping = o.damping + force_.damping,
              .stiffness = o.stiffness + force_.stiffness,
              .constant = -force_.constant,
              .x0 = from.x,
              .v0 = from.v};
  set_drive();
  double length = std::abs(from.x);
  force_scale_ += o.stiffness * std::abs(from.x) + friction.kinetic + friction.static_level;
  for (const Spring& s : friction.springs) {
    force_scale_ += s.kinetic + (s.side == 0 ? s.stiffness * (std::abs(s.foot) + std::abs(from.x)) : 0.0);
    length = std::max(length, std::abs(s.foot) + s.reach);
  }
  for (const DampedContact& c : friction.contacts) {
    force_scale_ += c.kinetic + (c.side == 0 ? c.stiffness * (std::abs(c.foot) + std::abs(from.x)) : 0.0);
    length = std::max(length, std::abs(c.foot));
  }
  force_error_ += rounding * force_scale_;
  position_error_ = rounding * length;
  velocity_ = oracle::slip_velocity(problem_);
  if (std::abs(from.v) <= start_velocity_error()) {
    from_.v = problem_.v0 = 0.0;
    velocity_ = oracle::slip_velocity(problem_);
  }
  add_guards();
}

/// Phasors of the drive's force at the start of the interval.
void PlainInterval::set_drive() {
  const sim::Oscillator& o = model_.oscillator;
  const sim::Excitation& e = model_.excitation;
  const bool base = e.moves_base();
  const double damper = o.damper_to == sim::DamperTo::base ? o.damping : 0.0;
  if (e.samples != nullptr) {
    const std::vector<double>& times = e.samples->times();
    const auto next = std::ranges::upper_bound(times, from_.t);
    const auto [level, rate] =
        sampled_drive(*e.samples, static_cast<std::size_t>(next - times.begin()) - 1, from_.t);
    problem_.constant += base ? o.stiffness * level + damper * rate : level;
    return;
  }
  const auto add = [&](int order, double amplitude, double phase) {
    const Real w = Real(order) * static_cast<Real>(e.frequency);
    const Real angle =
        std::remainder(w * static_cast<Real>(from_.t), 2 * std::numbers::pi_v<Real>) + static_cast<Real>(phase);
    const auto phasor = oracle::Complex(std::polar(static_cast<Real>(amplitude), angle));
    const auto frequency = static_cast<double>(w);
    const oracle::Complex gain = base ? oracle::Complex(o.stiffness, damper * frequency) : oracle::Complex(1.0);
    problem_.harmonics.push_back({frequency, gain * phasor});
    force_scale_ += std::abs(gain * phasor);
    force_error_ += std::abs(gain * phasor) * 0.25 * rounding * frequency * from_.t;
  };
  add(1, e.amplitude, e.phase);
  for (const sim::Harmonic& h : e.harmonics) add(h.order, h.amplitude, h.phase);
  if (!base) problem_.constant += e.offset;
}

double PlainInterval::rate() const {
  return std::max(std::sqrt(problem_.stiffness / problem_.mass), std::abs(problem_.damping) / problem_.mass);
}

double PlainInterval::velocity_error() const {
  Real parts = 0;
  for (const oracle::Exponential& e : velocity_) parts += std::abs(e.coefficient);
  return 4.0 * (force_error_ / problem_.mass / rate() + rounding * static_cast<double>(parts));
}

/// The larger of the error from the interval before and the error of this interval.
double PlainInterval::start_velocity_error() const { return std::max(velocity_error(), from_.v_error); }

bool PlainInterval::is_regular() const {
  if (from_.direction == 0) return true;
  const double w = std::sqrt(problem_.stiffness / problem_.mass);
  const double zeta = problem_.damping / (2.0 * problem_.mass * w);
  const bool resonant = std::any_of(problem_.harmonics.begin(), problem_.harmonics.end(),
                                    [&](const auto& h) { return std::abs(h.frequency / w - 1.0) < 1e-2; });
  return std::abs(zeta - 1.0) > 1e-3 && (zeta > 1e-2 || !resonant);
}

double PlainInterval::net_force() const {
  double force = problem_.constant - problem_.stiffness * from_.x;
  for (const auto& harmonic : problem_.harmonics) force += harmonic.phasor.real();
  return force;
}

void PlainInterval::add_guards() {
  const int direction = from_.direction;
  if (direction == 0) {
    for (const int side : {1, -1}) {
      guards_.push_back({.event = {.what = NextEvent::What::release, .side = side},
                         .constant = friction_.static_level - side * problem_.constant,
                         .by_position = side * problem_.stiffness,
                         .by_drive = -static_cast<double>(side),
                         .error = force_error_});
    }
  } else {
    // A mass that is released from rest under an unchanged level starts without acceleration.
    int zeros = from_.v == 0.0 ? 1 : 0;
    if (zeros == 1 && std::abs(net_force()) <= at_zero * force_scale_) zeros = 2;
    guards_.push_back({.by_velocity = static_cast<double>(direction), .zeros = zeros});
    for (const int side : {1, -1}) add_spring_guard(side);
  }
  for (std::size_t i = 0; i < friction_.contacts.size(); ++i) add_contact_guards(i);
}

void PlainInterval::add_spring_guard(int side) {
  const double edge = friction_.edge(side);
  if (!std::isfinite(edge)) return;
  Guard guard{.event = {.what = NextEvent::What::spring, .side = side},
              .constant = side * edge,
              .by_position = -static_cast<double>(side)};
  // A foot that has just come to stand, with its spring stretched to its reach.
  const bool touches = std::abs(edge - from_.x) <= at_zero * (std::abs(edge) + std::abs(from_.x));
  if (touches && from_.direction != side) guard.zeros = guards_.front().zeros + 1;
  guards_.push_back(guard);
}

void PlainInterval::add_contact_guards(std::size_t index) {
  const DampedContact& c = friction_.contacts[index];
  if (c.side != 0 && from_.direction == 0) {
    guards_.push_back({.event = {.what = NextEvent::What::contact, .contact = index},
                       .constant = -c.stopped(),
                       .transient = c.side * c.decay() * (c.stretch - c.settled()),
                       .decay = c.decay(),
                       .error = rounding * c.decay() * (std::abs(c.stretch) + std::abs(c.settled()))});
    return;
  }
  if (c.side != 0) {
    // side (v - stretch')
    const double relaxing = c.stretch - c.settled();
    const double parts = c.decay() * (std::abs(from_.x) + std::abs(c.stretch) + std::abs(c.settled()));
    Guard guard{.event = {.what = NextEvent::What::contact, .contact = index},
                .by_velocity = static_cast<double>(c.side),
                .transient = c.side * c.decay() * relaxing,
                .decay = c.decay(),
                .error = rounding * (std::abs(from_.v) + parts)};
    const double speed = c.side * (from_.v + c.decay() * relaxing);
    if (std::abs(speed) <= 4.0 * guard.error + start_velocity_error())
      guard.zeros = std::max(1, guards_.front().zeros);
    guards_.push_back(guard);
    return;
  }
  for (const int side : {1, -1}) {
    Guard guard{.event = {.what = NextEvent::What::contact, .side = side, .contact = index},
                .constant = c.static_level + side * c.stiffness * c.foot,
                .by_position = -side * c.stiffness,
                .by_velocity = -side * c.damping,
                .error = rounding * (c.static_level + c.stiffness * std::abs(c.foot))};
    const double spare = guard.constant + guard.by_position * from_.x + guard.by_velocity * from_.v;
    const double parts = guard.error + c.stiffness * (rounding * std::abs(from_.x) + position_error_) +
                         c.damping * start_velocity_error();
    if (std::abs(spare) <= 4.0 * parts) {
      if (from_.direction == 0) continue;
      guard.zeros = std::max(1, guards_.front().zeros);
    }
    guards_.push_back(guard);
  }
}

bool PlainInterval::begins_with_double_root() const {
  return std::any_of(guards_.begin(), guards_.end(), [](const Guard& guard) { return guard.zeros >= 2; });
}

ExponentialSum PlainInterval::sum(const Guard& g) const {
  ExponentialSum f;
  auto constant = static_cast<Real>(g.constant);
  if (from_.direction == 0) {
    constant += static_cast<Real>(g.by_position) * static_cast<Real>(from_.x);
    for (const auto& h : problem_.harmonics) {
      if (g.by_drive != 0.0)
        f.add({0, static_cast<Real>(h.frequency)}, static_cast<Real>(g.by_drive) * LongComplex(h.phasor));
    }
  } else {
    constant += static_cast<Real>(g.by_position) * static_cast<Real>(problem_.constant) /
                static_cast<Real>(problem_.stiffness);
    for (const oracle::Exponential& e : velocity_) {
      f.add(e.exponent, e.coefficient * (static_cast<Real>(g.by_velocity) +
                                         LongComplex(static_cast<Real>(g.by_position)) / e.exponent));
    }
  }
  f.add(0, constant);
  if (g.transient != 0.0) f.add(-static_cast<Real>(g.decay), static_cast<Real>(g.transient));
  f.finish(g.zeros);
  return f;
}

/// An error of the guard over its slope at the root. An error of the force grows to one of the velocity, and that
/// to one of the position, until the reversal of the oscillator. At the start there are the errors from the
/// interval before.
double PlainInterval::uncertainty(const Guard& g, const ExponentialSum& f, double s) const {
  const double growing = std::min(s, 1.0 / rate());
  const double velocity =
      s > 0.0 ? rounding * std::abs(from_.v) + force_error_ / problem_.mass * growing : start_velocity_error();
  const double position = position_error_ + velocity * growing;
  const double error = g.error + std::abs(g.by_position) * position + std::abs(g.by_velocity) * velocity +
                       static_cast<double>(f.rounding(static_cast<Real>(s)));
  const ExponentialSum::Jet jet = f.jet(static_cast<Real>(s));
  const auto slope = static_cast<double>(std::abs(jet[1]));
  if (s > 0.0 && slope > 0.0) return error / slope;
  // A guard that begins with a zero of higher order falls by its error in the time that its first sufficient term
  // needs.
  const auto bend = static_cast<double>(std::abs(jet[2]));
  const auto twist = static_cast<double>(std::abs(jet[3]));
  return std::min({error / slope, std::sqrt(2.0 * error / bend), std::cbrt(6.0 * error / twist)});
}

std::vector<NextEvent> PlainInterval::next_events(double horizon) const {
  std::vector<ExponentialSum> sums;
  std::vector<NextEvent> events;
  for (const Guard& guard : guards_) {
    sums.push_back(sum(guard));
    const Real level = sums.back().level(0);
    // A guard that may begin at zero and rises from there holds.
    const bool holds = guard.zeros == 0 && level >= -4 && sums.back().jet(0)[1] > 0;
    if (level > 4 || holds) continue;
    events.push_back(guard.event);
    events.back().uncertainty =
        std::min(8.0 * uncertainty(guard, sums.back(), 0.0), 1e-5 / model_.excitation.frequency);
  }
  for (double end = std::min(horizon, 4.0 / rate()); events.empty(); end = std::min(horizon, 4.0 * end)) {
    for (std::size_t i = 0; i < guards_.size(); ++i) {
      const auto root = sums[i].first_crossing(static_cast<Real>(end));
      if (!root) continue;
      NextEvent& event = events.emplace_back(guards_[i].event);
      event.s = static_cast<double>(*root);
      event.uncertainty = uncertainty(guards_[i], sums[i], event.s);
    }
    if (end == horizon) break;
  }
  std::ranges::sort(events, {}, &NextEvent::s);
  std::erase_if(events, [&](const NextEvent& event) {
    return event.s - event.uncertainty > events.front().s + events.front().uncertainty;
  });
  return events;
}

double PlainInterval::position(double s) const {
  return from_.direction == 0 ? from_.x : static_cast<double>(sum({.by_position = 1.0}).at(static_cast<Real>(s)));
}

}  // namespace dualdamp::test
