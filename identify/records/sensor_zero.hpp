#pragma once
/// Subtracts the zero of a displacement sensor if it is further off than friction can hold the mass.
///
/// Friction moves the middle of a swing by x_f to one side or the other. Friction that differs between the
/// directions moves it by less than x_f.
/// * Free vibration: the swings s_i from extreme to extreme do not depend on the zero. They shrink by at least 4
///   x_f, so friction cannot move the middle by more than half of s_i - s_(i+1). The middle must also be off by at
///   least 2 % of the first swing.
/// * Driven motion: the mean of x - y - force/k is compared with 1.3 times the amplitude of the drive, below which
///   nothing slides, and with half of the range of x.
/// A smaller offset is left to the ledger, which tests the zero of x.
///
/// Errors: none thrown. Cost: linear.

#include <string>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// Subtracts the zero from a free vibration and its extremes. Returns a warning; empty if nothing was subtracted.
[[nodiscard]] std::string remove_zero(History& history, DecayRecord& decay);

/// Subtracts it from x of a driven motion. If `stiffness` is `unknown`, only if no force drives the mass.
[[nodiscard]] std::string remove_zero(History& history, double stiffness);

/// The same if the drive is not in the history. `rest`: mean position about which the drive moves the mass [m];
/// `amplitude`: of the drive [m].
[[nodiscard]] std::string remove_zero(History& history, double rest, double amplitude);

}  // namespace dualdamp::identify
