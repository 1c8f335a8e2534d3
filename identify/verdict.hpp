#pragma once
/// What all estimates of one record say together, in plain words: is Coulomb + viscous friction rejected, which
/// numbers to use, and who disagrees.

#include <string>
#include <vector>

#include "identify/estimate.hpp"

namespace dualdamp::identify {

/// Empty when there is no estimate at all.
[[nodiscard]] std::string verdict(const std::vector<Estimate>& estimates);

}  // namespace dualdamp::identify
