#pragma once
/// What a run leaves behind: one JSON document, and a CSV file for each table.
///
/// The document holds, in this order: program, provenance, scenario, analysis, status, result, warnings, checks,
/// errors. A table opens with its provenance as comment lines `# name: value`, then a header `name [unit]`, then
/// rows; numbers read back to the same bits, a number that does not exist is an empty field.

#include <string>
#include <vector>

#include "scenarios/files.hpp"
#include "scenarios/run.hpp"

namespace dualdamp::scenarios {

[[nodiscard]] std::string json_document(const Scenario& scenario, const RunResult& result);

/// The document of a run that did not take place: status, errors, and a result of null.
[[nodiscard]] std::string json_refusal(core::ExitStatus status, const std::vector<core::Diagnostic>& errors);

/// The document of a scenario that was only checked.
[[nodiscard]] std::string json_checked(const Scenario& scenario);

[[nodiscard]] std::string csv(const Table& table, const core::Provenance& provenance);

/// result.json and the tables.
[[nodiscard]] std::vector<OutputFile> output_files(const Scenario& scenario, const RunResult& result);

}  // namespace dualdamp::scenarios
