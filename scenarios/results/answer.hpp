#pragma once
/// What an analysis answers: JSON, tables, warnings.

#include <string>
#include <vector>

#include "scenarios/format/json.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

struct Answer {
  Json result;          ///< null: there is none; null inside: the list is a table of that key
  std::string failure;  ///< why there is none
  std::vector<std::string> warnings;
  std::vector<Table> tables;
  bool some_cases_failed = false;  ///< of many: the status tells it
};

/// No result, and why.
[[nodiscard]] inline Answer failed(std::string reason) {
  Answer answer;
  answer.failure = std::move(reason);
  return answer;
}

}  // namespace dualdamp::scenarios
