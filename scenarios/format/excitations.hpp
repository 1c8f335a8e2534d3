#pragma once
/// The choices of the format that analyses refer to: excitations and friction laws.

#include "scenarios/format/keys.hpp"

namespace dualdamp::scenarios {

[[nodiscard]] const Choice& excitations();
[[nodiscard]] Choice friction_laws();

}  // namespace dualdamp::scenarios
