#pragma once
/// Runs a scenario: the question of the file put to `sim` and `identify`, the answer as JSON and tables.
///
/// A number that does not exist is null in the JSON and an empty field in a table, never a stand-in. A curve keeps
/// its good points when others fail; when none is left, or the one number asked for does not exist, the status
/// is 4.

#include <optional>
#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "core/provenance.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/table.hpp"

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
  core::ExitStatus status = core::ExitStatus::done;  ///< done, check_failed or numerical_failure
  std::string result = "null";                       ///< JSON; null stands for a list that is one of `tables`
  std::string failure;                               ///< why there is no result
  std::vector<std::string> warnings;
  /// The single numbers of the result as text, for people.
  Table summary{"summary",
                {{.name = "name", .kind = CellKind::text},
                 {.name = "value", .kind = CellKind::text},
                 {.name = "unit", .kind = CellKind::text}}};
  std::vector<Table> tables;  ///< its lists; each becomes a file
  std::string verdict;        ///< what it means, in plain words; of an identification
  std::vector<Check> checks;
  core::Provenance provenance;
};

/// What is known of a run's origin before it begins.
[[nodiscard]] core::Provenance provenance_of(const Scenario& scenario);

/// The result of a run that gave this JSON, null where a list is one of the tables: its summary and its comparison
/// with the expected values.
[[nodiscard]] RunResult assemble(const Scenario& scenario, const std::string& json, std::vector<Table> tables,
                                 core::Provenance provenance);

/// Of every analysis but those that bench/ answers (`stress_test`: campaign.hpp; `mechanisms`:
/// mechanism_study.hpp). Errors: `core::InputError` when an expected value turns out not to be in the result.
[[nodiscard]] RunResult run(const Scenario& scenario);

}  // namespace dualdamp::scenarios
