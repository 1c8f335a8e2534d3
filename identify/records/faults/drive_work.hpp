#pragma once
/// Is the work that a drive does on a recorded motion possible?
///
///   W = int f dx >= -E(0),   f: the force, or k y of a base;   E = m v^2/2 + k x^2/2
///
/// Spring and mass give back no more than they hold at the beginning, and friction and damping only take. Errors of
/// gains change no sign of W. A record is impossible if W is below -2 E(0), which leaves room for wrong constants
/// and gains, by more than the noise and the zeros of the sensors explain, and a delay of 1 % of a period between
/// them.
///
/// A longer delay has the same effect away from resonance, but leaves the force in phase with what spring and
/// inertia need, mean(f x) = k mean(x^2) - m mean(v^2). Where that holds, the sign is right.
///
/// A force that moves a mass along a measured loop does work against spring, inertia, friction and damping:
///
///   int F dx = k x^2/2 + m v^2/2 + F0 x + P t + what a part of a loop adds,   P > 0: mean power of the losses
///
/// The line is fitted for any k, m and zero F0. A record of at least one closed loop is impossible if the losses
/// are negative by more than four times what the line leaves, the noise, and a delay of 2 % of a period: those of a
/// nearly elastic loop have either sign.
///
/// Errors: none. Cost: linear.

#include <optional>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// The work [J] of the drive of a history with x and either a force or a base, if it is impossible. `omega`: main
/// frequency of x [rad/s].
[[nodiscard]] std::optional<double> impossible_work(const History& history, const KnownConstants& constants,
                                                    double omega);

/// The losses P t [J] of a loop with x or v, if they are impossible.
[[nodiscard]] std::optional<double> impossible_losses(const History& history);

}  // namespace dualdamp::identify
