#pragma once
/// What is wrong with a model that a program builds by hand: every public function of sim that takes a model asks
/// here first, in a release build too, and throws `core::InputError` with all problems. The names and the wording
/// are those of a scenario file ('system.mass' is `Model::oscillator.mass`); there a problem also has its line and
/// column.
///
/// Cost: about 20 ns for a valid model, no allocation.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.hpp"
#include "friction_models/parameters.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

/// Laws in parallel, where the elements of a law that takes modifiers one by one are laws of their own (`iwan`).
/// The cost of a motion grows with the square of their number.
inline constexpr std::size_t max_laws = 256;

/// All that is wrong with the model; empty: valid.
[[nodiscard]] std::vector<core::Diagnostic> validate(const Model& model);

/// Throws `core::InputError` with what validate() says; else returns the model.
const Model& valid(const Model& model);
const Model& valid(const Model&& model) = delete;

/// The same, and the excitation must be harmonic. `analysis`: who needs that, for the message.
const Model& valid_harmonic(const Model& model, std::string_view analysis);
/// The same, and without excitation.
const Model& valid_free(const Model& model, std::string_view analysis);
inline constexpr friction::Range positive{.low = 0.0, .low_open = true};
inline constexpr friction::Range not_negative{.low = 0.0};

/// Throws where a value is out of range or not finite. `path`: its name in a scenario file.
void require_in(const friction::Range& range, std::string_view path, double value, std::string_view unit);
void require_in(const friction::Range& range, std::string_view path, std::span<const double> values,
                std::string_view unit);
/// Throws with this message when `holds` is false.
void require(bool holds, std::string_view message, std::string_view allowed);

}  // namespace dualdamp::sim
