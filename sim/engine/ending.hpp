#pragma once
/// The guards that may end an interval, as both engines watch them.

#include <cstddef>
#include <variant>

#include "friction_models/law.hpp"

namespace dualdamp::sim {

/// A slip ends: the velocity reaches zero.
struct SlipEnd {};
/// A stick ends: the pull exceeds the static limits in this direction.
struct StickEnd {
  friction::Direction release = friction::Direction::forward;
};
/// A law changes its mode: one of its own guards reaches zero.
struct LawGuard {
  std::size_t law = 0;
  int guard = 0;  ///< index among the law's own guards
};
/// The event at which a guard ends the interval.
using Ending = std::variant<SlipEnd, StickEnd, LawGuard>;

template <class E>
[[nodiscard]] bool is(const Ending& ending) {
  return std::holds_alternative<E>(ending);
}

}  // namespace dualdamp::sim
