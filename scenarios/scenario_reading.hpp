#pragma once
/// From a document to a scenario: the common steps for a file without a sweep and for each point of a sweep.

#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "scenarios/format/reader.hpp"
#include "scenarios/format/tree.hpp"
#include "scenarios/scenario.hpp"

namespace dualdamp::scenarios {

/// A document, read by the tables of the format, as a scenario. `name` is the name of the file in messages. The
/// caller adds the digest of the file and the overrides. Errors: `core::InputError` with all problems, those of the
/// document included.
[[nodiscard]] Scenario scenario_of(const Document& document, Reading reading, const std::string& name,
                                   const LoadOptions& options);

/// The checked section `expect` of `values`; `reading` knows the places.
[[nodiscard]] std::vector<Expectation> expectations(const Json& values, const Document& document,
                                                    const Reading& reading);

/// Throws all problems in the order of the file; those from elsewhere (overrides, data) follow.
[[noreturn]] void throw_sorted(std::vector<core::Diagnostic> problems, const std::string& file);

}  // namespace dualdamp::scenarios
