#pragma once
/// Do steady states lie at several levels of the input? At one level and one frequency damping and friction take
/// one sum of work, and no reading shows how it divides: the curve of force over speed is then a line through one
/// point and its noise.

#include <string>
#include <vector>

#include "identify/methods/amplitudes/resonance_line.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// Why the inputs are one level at one frequency; empty when they are not. Inputs within 5 % are one level as well
/// if x does not grow with Y beyond the noise (regression, one-sided level of 1 %): they differ by their noise.
[[nodiscard]] std::string lacks_levels(const std::vector<Datum>& pairs);
[[nodiscard]] std::string lacks_levels(const std::vector<Pair>& states);

}  // namespace dualdamp::identify
