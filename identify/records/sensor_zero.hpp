#pragma once
/// The zero of a displacement sensor that is further off than friction can hold the mass.
///
/// Between reversals friction moves the place about which the mass swings by x_f to each side, and friction that
/// differs between the directions moves it by less than x_f. Of a free vibration the swings s_i from extreme to
/// extreme, which no zero changes, shrink by at least 4 x_f, so that a middle further off than half of
/// s_i - s_(i+1) is not friction's. Of a driven motion the mean of x - y - force/k is compared with 1.3 times the
/// amplitude of the drive, below which nothing slides, and with half of the range of x. What is closer is left to
/// the ledger, which tests the zero of x.
///
/// Errors: none thrown. Cost: linear.

#include <string>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// Subtracts the zero from a free vibration and its extremes. Returns what was done, empty where nothing was.
[[nodiscard]] std::string remove_zero(History& history, DecayRecord& decay);

/// Subtracts it from x of a driven motion. `stiffness` unknown: only where no force drives it.
[[nodiscard]] std::string remove_zero(History& history, double stiffness);

/// The same of a motion whose drive is not in the history: `rest`, about which it drives the mass, and its
/// amplitude [m].
[[nodiscard]] std::string remove_zero(History& history, double rest, double amplitude);

}  // namespace dualdamp::identify
