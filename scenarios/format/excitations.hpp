#pragma once
/// The choices of the format that analyses refer to: excitations and friction laws.

#include <string_view>

#include "scenarios/format/keys.hpp"

namespace dualdamp::scenarios {

[[nodiscard]] const Choice& excitations();
[[nodiscard]] Choice friction_laws();

/// Whether an excitation of this type moves the base; all others but `none` are forces.
[[nodiscard]] bool moves_base(std::string_view type);

}  // namespace dualdamp::scenarios
