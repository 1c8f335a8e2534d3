#pragma once
/// The choices of the format that analyses refer to: excitations and friction laws.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/format/keys.hpp"
#include "sim/excitation.hpp"

namespace dualdamp::scenarios {

[[nodiscard]] const Choice& excitations();
[[nodiscard]] Choice friction_laws();

/// Where the samples of an excitation stand.
enum class SamplesIn { nowhere, scenario, data_file };

// What the name of an excitation type says. A name that is not in the list says nothing.
[[nodiscard]] std::optional<sim::ExcitationType> excitation_type(std::string_view name);
/// An excitation of this type without its numbers: `is_harmonic()`, `is_noise()`, ...
[[nodiscard]] sim::Excitation excitation_named(std::string_view name);
[[nodiscard]] SamplesIn samples_of(std::string_view name);
/// Whether it moves the base; all others but `none` are forces.
[[nodiscard]] bool moves_base(std::string_view name);

/// The names of those that have a steady state.
[[nodiscard]] std::vector<std::string> harmonic_excitations();

}  // namespace dualdamp::scenarios
