#pragma once
/// Is the force, or the base motion, of a history too large or too small by a factor?
///
///   m a + k x = f/g - c v - F0 sgn v
///
/// is fitted to means over windows of a natural period. Partial integration moves the derivatives of x to the
/// weights of the window. Where x changes by no more than its noise, the direction of friction is unknown, and a
/// mass that sticks is held by any force up to F0: windows in which it sticks for long are left out, and the drive
/// is off only by more than friction in the others may explain. Where the motion settles under one frequency near
/// resonance, the force is in phase with v, and nothing is found: a transient tells. Errors: none. Cost: linear.

#include <optional>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// The factor g, if the motion tells it: the fit with it explains 98 % of m a + k x, and without it less than 90 %.
/// Mass and stiffness must be known, and one drive must be measured.
[[nodiscard]] std::optional<double> gain_of_drive(const History& history, const KnownConstants& constants);

}  // namespace dualdamp::identify
