#include "tests/support/plain_friction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.hpp"

namespace dualdamp::test {

void DampedContact::relax(double s) {
  if (side != 0) stretch = settled() + (stretch - settled()) * std::exp(-decay() * s);
}

void DampedContact::break_away(int towards, double x) {
  side = towards;
  stretch = x - foot;
}

void DampedContact::stick(double x) {
  side = 0;
  foot = x - stretch;
}

void PlainFriction::add_coulomb(double kinetic_level, double static_limit) {
  kinetic += kinetic_level;
  static_level += static_limit;
}

void PlainFriction::add_contact(double kinetic_level, double static_limit, double stiffness, double damping) {
  if (damping > 0.0) {
    contacts.push_back(
        {.stiffness = stiffness, .damping = damping, .kinetic = kinetic_level, .static_level = static_limit});
  } else {
    springs.push_back({.stiffness = stiffness,
                       .reach = static_limit / stiffness,
                       .kinetic = kinetic_level,
                       .trail = kinetic_level / stiffness});
  }
}

void PlainFriction::add_reset_integrator(double kinetic_level, double stiffness, double static_gain,
                                         double damping) {
  springs.push_back({.stiffness = (1.0 + static_gain) * stiffness,
                     .damping = damping,
                     .reach = kinetic_level / stiffness,
                     .kinetic = kinetic_level,
                     .trail = kinetic_level / stiffness});
}

void PlainFriction::add_bristles(double stiffness, double snap_distance, int count, std::uint64_t seed) {
  seed_ = seed;
  for (int i = 0; i < count; ++i)
    springs.push_back({.stiffness = stiffness, .reach = snap_distance, .bristle = true});
}

void PlainFriction::start(double x) {
  for (Spring& spring : springs) spring.foot = spring.bristle ? drawn_foot(spring, x) : x;
  for (DampedContact& contact : contacts) contact.foot = x;
}

double PlainFriction::drawn_foot(const Spring& spring, double x) {
  const core::RandomStream stream{.seed = seed_};
  return x + spring.reach * (2.0 * stream.uniform(draws_++) - 1.0);
}

LinearForce PlainFriction::force(int direction) const {
  LinearForce sum{.constant = direction * kinetic};
  const auto add = [&](const auto& element) {
    if (element.side != 0) {
      sum.constant += element.side * element.kinetic;
      return;
    }
    sum.constant -= element.stiffness * element.foot;
    sum.stiffness += element.stiffness;
    sum.damping += element.damping;
  };
  std::ranges::for_each(springs, add);
  std::ranges::for_each(contacts, add);
  return sum;
}

double PlainFriction::edge(int side) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Spring& s : springs) {
    if (s.side == 0) nearest = std::min(nearest, side * s.foot + s.reach);
  }
  return side * nearest;
}

void PlainFriction::let_go(int side) {
  const double x = edge(side);
  for (Spring& s : springs) {
    // Sliders that stuck at the same place let go at the same place, within rounding.
    const bool reached = std::abs(s.foot + side * s.reach - x) <= 1e-12 * (std::abs(x) + s.reach);
    if (s.side != 0 || !reached) continue;
    if (s.bristle) {
      s.foot = drawn_foot(s, x);
    } else {
      s.side = side;
    }
  }
}

void PlainFriction::reverse(double x) {
  for (Spring& s : springs) {
    if (s.side == 0) continue;
    s.foot = x - s.side * s.trail;
    s.side = 0;
  }
}

void PlainFriction::relax(double s) {
  for (DampedContact& contact : contacts) contact.relax(s);
}

}  // namespace dualdamp::test
