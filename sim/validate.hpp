#pragma once
/// Validation of a model. Every public function of sim that takes a model calls it first, in release builds too,
/// and throws `core::InputError` with all problems. Messages name quantities as a scenario file does ('system.mass'
/// is `Model::oscillator.mass`); for a file a problem also has its line and column.
///
/// Cost: about 20 ns for a valid model, no allocation.

#include <span>
#include <string_view>
#include <vector>

#include "core/diagnostics.hpp"
#include "friction_models/parameters.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

/// Largest number of laws in parallel. The elements of a law that applies modifiers to each element count as laws
/// (`iwan`). The cost of a motion grows with the square of this number.
inline constexpr std::size_t max_laws = 256;

/// Least `SolverOptions::tolerance`: steps are not computed more exactly than rounding lets them.
inline constexpr double least_tolerance = 1e-15;

/// All problems of the model; empty if it is valid.
[[nodiscard]] std::vector<core::Diagnostic> validate(const Model& model);

/// Throws `core::InputError` with the problems of validate(); else returns the model.
const Model& valid(const Model& model);
const Model& valid(const Model&& model) = delete;

/// As valid(); the excitation must also be harmonic. `analysis`: the function that needs it, for the message.
const Model& valid_harmonic(const Model& model, std::string_view analysis);
/// As valid(); the excitation must be `none`.
const Model& valid_free(const Model& model, std::string_view analysis);

/// Throws if a value is out of range or not finite. `path`: its name in a scenario file.
void require_in(const friction::Range& range, std::string_view path, double value, std::string_view unit);
void require_in(const friction::Range& range, std::string_view path, std::span<const double> values,
                std::string_view unit);
/// Throws with this message.
[[noreturn]] void refuse(std::string_view message, std::string_view allowed);
/// The same if `holds` is false. For a message that is ready: one that is put together costs time at each call.
void require(bool holds, std::string_view message, std::string_view allowed);

}  // namespace dualdamp::sim
