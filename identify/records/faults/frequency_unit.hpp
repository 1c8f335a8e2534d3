#pragma once
/// Do x, Y and the frequency of x-Y pairs show that the frequency is in another unit?
///
/// Friction and damping act at right angles to spring and inertia, so |k - m w^2| x <= k Y. A frequency that is too
/// small by 2 pi puts a resonance where the mass can only follow its base.
///
/// Errors: none. Cost: linear.

#include <string>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// The units in which no pair needs far more force than the base gives, as "Hz, not rad/s".
[[nodiscard]] std::vector<std::string> other_units_of_frequency(const std::vector<Pair>& pairs,
                                                                const KnownConstants& constants);

/// Whether frequencies in rad/s are numbers of hertz: a quarter of the pairs, two or more, show more motion below
/// the natural frequency than any friction allows, and as hertz all of them fit, with their phases. A stiffness
/// that is wrong by a factor does not fit so: the squares of the frequencies differ by 39.
[[nodiscard]] bool are_in_hertz(const std::vector<Pair>& pairs, const KnownConstants& constants);

}  // namespace dualdamp::identify
