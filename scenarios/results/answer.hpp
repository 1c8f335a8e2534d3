#pragma once
/// The answer of an analysis: JSON, tables, warnings.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/results/table.hpp"
#include "scenarios/results/verification_result.hpp"

namespace dualdamp::sim {
struct State;
}

namespace dualdamp::scenarios {

/// A text that becomes a file beside the tables, such as a scenario.
struct TextFile {
  std::string name;
  std::string text;
};

struct Answer {
  Json result;  ///< null: there is no result; a null inside: the list is the table with that key
  /// Status of a run with a result: done, some_cases_failed, or numerical_failure if the result has all parts
  /// except the answer.
  core::ExitStatus status = core::ExitStatus::done;
  std::string failure;  ///< why there is no result, or no answer in it
  std::vector<std::string> warnings;
  std::vector<Table> tables;
  std::vector<TextFile> files = {};
  std::shared_ptr<const sim::State> orbit = {};   ///< of a steady state: its state at t = 0
  std::optional<Verification> verification = {};  ///< of a sweep: of its points together
  double final_acceleration = none;               ///< of a motion: at its end [m/s^2]
};

/// No result, and why.
[[nodiscard]] inline Answer failed(std::string reason) {
  Answer answer;
  answer.failure = std::move(reason);
  return answer;
}

}  // namespace dualdamp::scenarios
