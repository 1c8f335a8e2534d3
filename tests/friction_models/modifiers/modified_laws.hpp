#pragma once
/// Laws under modifiers, and the work of their loops.

#include <catch2/catch.hpp>

#include "friction_models/laws/coulomb.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "sim/law_host/law_host.hpp"

namespace dualdamp::test {

inline friction::Law coulomb_with(double kinetic, double static_level, const friction::ParameterValues& modifiers) {
  return friction::modified(friction::Law(friction::Coulomb(kinetic, static_level)), modifiers,
                            {kinetic, static_level});
}

/// All of these values; where both have one, that of `more`.
inline friction::ParameterValues plus(friction::ParameterValues values, const friction::ParameterValues& more) {
  for (const auto& [name, value] : more.values()) values.set(name, value);
  return values;
}

/// Work of the loop between two positions, after one round.
inline double loop_work(const friction::Law& law, double low, double high) {
  sim::LawHost host(law, {});
  host.move_to(low);
  host.move_to(high);
  const double before = host.work();
  host.move_to(low);
  host.move_to(high);
  REQUIRE_FALSE(host.broken());
  return host.work() - before;
}

}  // namespace dualdamp::test
