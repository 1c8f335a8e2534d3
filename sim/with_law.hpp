#pragma once
/// A friction law added to a model by name, for the tables of models that `sim/` keeps.

#include <string_view>

#include "friction_models/parameters.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

/// `model` with the law beside those it has; defaults of `values` are filled in. Errors: `std::logic_error` when
/// the law is unknown or refuses the values, which is a fault of the table.
[[nodiscard]] Model with_law(Model model, std::string_view law, friction::ParameterValues values);

/// Damping of bristles of this stiffness [N/m]: a tenth of the critical one for the mass on them. It is what makes
/// bristle laws tend to Coulomb's with the root of their deflection.
[[nodiscard]] double bristle_damping(const Oscillator& oscillator, double stiffness);

}  // namespace dualdamp::sim
