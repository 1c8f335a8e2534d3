#pragma once
/// From a document to a scenario: what a file without a sweep and each point of one with a sweep have in common.

#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "scenarios/format/reader.hpp"
#include "scenarios/format/tree.hpp"
#include "scenarios/scenario.hpp"

namespace dualdamp::scenarios {

/// A document, read by the tables of the format, as a scenario. `name` stands for the file in messages. The digest
/// of the file and the overrides are left to the caller.
/// Errors: `core::InputError` with all problems, those of the document included.
[[nodiscard]] Scenario scenario_of(const Document& document, Reading reading, const std::string& name,
                                   const LoadOptions& options);

/// The checked section `expect` of `values`; `reading` knows the places.
[[nodiscard]] std::vector<Expectation> expectations(const Json& values, const Document& document,
                                                    const Reading& reading);

/// Throws problems in the order of the file; those from elsewhere (--set, data) after its own.
[[noreturn]] void throw_sorted(std::vector<core::Diagnostic> problems, const std::string& file);

}  // namespace dualdamp::scenarios
