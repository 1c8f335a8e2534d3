#pragma once
/// The output of a run: one JSON document, and a CSV file for each table.
///
/// The document holds, in this order: program, provenance, scenario, analysis, status, result, warnings, checks,
/// errors, and verification, if it was requested. The document is written row by row and is never a text in memory.
/// A table begins with its provenance as comment lines `# name: value`, then a header `name [unit]`, then rows;
/// numbers read back to the same bits, a number that does not exist is an empty field.

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "scenarios/results/files.hpp"
#include "scenarios/run.hpp"

namespace dualdamp::scenarios {

/// Writers keep the parts of a run that they need; they are called once for a file, and once more for stdout.
/// `tables`: files whose SHA-256 the document states, if they are already written.
[[nodiscard]] Writer json_document(std::shared_ptr<const Scenario> scenario,
                                   std::shared_ptr<const RunResult> result, std::vector<OutputFile> tables = {});

/// The document of a run that did not take place: status, errors, and a result of null.
[[nodiscard]] Writer json_refusal(core::ExitStatus status, const std::vector<core::Diagnostic>& errors);

/// The document of a scenario that was only checked.
[[nodiscard]] Writer json_checked(const Scenario& scenario);

/// A field of a CSV file: the text, quoted if its characters ask for it, or the number, empty if there is none.
[[nodiscard]] std::string csv_field(const std::string& text);
[[nodiscard]] std::string csv_field(double value);

void write_csv(std::ostream& out, const Table& table, const core::Provenance& provenance);

/// The tables, the texts, and result.json, whose digests show whether a table was changed later.
[[nodiscard]] std::vector<OutputFile> output_files(std::shared_ptr<const Scenario> scenario,
                                                   std::shared_ptr<const RunResult> result);

}  // namespace dualdamp::scenarios
