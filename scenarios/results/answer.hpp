#pragma once
/// What an analysis answers: JSON, tables, warnings.

#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

struct Answer {
  Json result;  ///< null: there is none; null inside: the list is a table of that key
  /// Of a run whose result is there: done, some_cases_failed, or numerical_failure where it holds all but the
  /// answer.
  core::ExitStatus status = core::ExitStatus::done;
  std::string failure;  ///< why there is no result, or no answer in it
  std::vector<std::string> warnings;
  std::vector<Table> tables;
};

/// No result, and why.
[[nodiscard]] inline Answer failed(std::string reason) {
  Answer answer;
  answer.failure = std::move(reason);
  return answer;
}

}  // namespace dualdamp::scenarios
