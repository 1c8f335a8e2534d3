#pragma once
/// Runs a scenario: its question, the answer as JSON and tables.
///
/// A number that does not exist is null in the JSON and an empty field in a table, never a substitute value. A
/// curve keeps its good points if others fail. If no point is left, or the single number does not exist, the status
/// is 4. It is 5 if cases of a campaign have failed.

#include <optional>
#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "core/provenance.hpp"
#include "scenarios/results/table.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/verification/verification.hpp"

namespace dualdamp::scenarios {

/// One row of the comparison with expected values, as text for people and machines alike.
struct Check {
  std::string path;
  std::string expected;
  std::string found;
  std::optional<double> difference;  ///< found - expected, of numbers
  bool ok = false;
  std::string source;
};

struct RunResult {
  core::ExitStatus status = core::ExitStatus::done;  ///< done, check_failed, numerical_failure, some_cases_failed
  std::string result = "null";                       ///< JSON; null in place of a list that is one of `tables`
  std::string failure;                               ///< why there is no result, or no answer in it
  std::vector<std::string> warnings;
  /// The single numbers of the result as printed text, in the units of the user.
  Table summary{"summary",
                {{.name = "name", .kind = CellKind::text},
                 {.name = "value", .kind = CellKind::text},
                 {.name = "unit", .kind = CellKind::text}}};
  std::vector<Table> tables;  ///< its lists; each becomes a file
  std::vector<TextFile> files;
  std::string sentence;  ///< the meaning as a sentence: a verdict, an advice
  std::vector<Check> checks;
  std::optional<Verification> verification;  ///< if the scenario requests one
  core::Provenance provenance;
};

/// The provenance of a run, as far as it is known before the run.
[[nodiscard]] core::Provenance provenance_of(const Scenario& scenario);

/// The context of the question. The scenario and the options must outlive it.
[[nodiscard]] RunContext context_of(const Scenario& scenario, const RunOptions& options);

/// If there are several processes, only the first has a result; the others take part in a campaign and return an
/// empty one. Errors: `core::InputError` when an expected value turns out not to be in the result; those of a
/// campaign's files.
[[nodiscard]] RunResult run(const Scenario& scenario, const RunOptions& options = {});

}  // namespace dualdamp::scenarios
