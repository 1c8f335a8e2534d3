#pragma once
/// Words for the mass and the stiffness of a fit beside those that are stated.

#include <string>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// A constant as a fit has it, and as stated: "a mass of 1.1 kg", "1 kg".
struct ChangedConstant {
  std::string fitted, stated;
};

/// Those of a fit that are not as stated; none where none is known.
[[nodiscard]] std::vector<ChangedConstant> changed_constants(const KnownConstants& fitted,
                                                             const KnownConstants& stated);

/// "stiffness of 1421 N/m and mass of 1 kg"
[[nodiscard]] std::string text_of(const KnownConstants& constants);

}  // namespace dualdamp::identify
