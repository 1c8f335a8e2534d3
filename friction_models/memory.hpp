#pragma once
/// The memory of a law from one instant to the next. The driver keeps it, so that a step or an event search can be
/// repeated; only the law knows its meaning.

#include <vector>

namespace dualdamp::friction {

/// The state of the modifiers of a law. It changes only at events; the law under the modifiers neither reads nor
/// writes it.
struct ModifierCourse {
  bool drift_ended = false;  ///< a falling drift has taken the force limits to zero
  int cell = 0;              ///< cell of the fluctuation, counted over time or position
  double level = 0.0;        ///< of the fluctuation in this cell, in standard deviations
  int side = 1;              ///< sign of x, +1 or -1
  bool unloaded = false;     ///< the load of the contact is gone
  int vanished = 0;          ///< number of force limits that are zero, the smallest nominal ones first

  friend bool operator==(const ModifierCourse&, const ModifierCourse&) = default;
};

struct Memory {
  int mode = 0;
  std::vector<int> indices{};   ///< further whole numbers of the mode, such as which elements stick together
  std::vector<double> state{};  ///< enters force and guards as an affine function in every mode of an affine law
  ModifierCourse course{};

  friend bool operator==(const Memory&, const Memory&) = default;
};

/// The reason for which `jump` is called.
struct Trigger {
  static constexpr int direction_change = -1;  ///< the mass reverses, stops or is released
  static constexpr int limit_change = -2;      ///< a modifier is about to change the force limits by a step
  static constexpr int scheduled = -3;         ///< the time of `next_change` has come
  int cause = direction_change;                ///< index into the law's guards, or one of the above
};

}  // namespace dualdamp::friction
