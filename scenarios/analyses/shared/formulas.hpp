#pragma once
/// Closed forms by name, for `analysis: {type: formula, formula: {name: NAME, ...}}`: formulas of the paper that no
/// simulation computes. An explicit list, sorted by name.

#include <string_view>
#include <vector>

#include "scenarios/format/keys.hpp"

namespace dualdamp::scenarios {

struct FormulaEntry {
  std::string_view name;
  std::string_view summary;
  std::string_view equation;  ///< plain text
  Section arguments;
  std::vector<ResultField> results;
  /// `arguments` as read: complete, in range, SI. A result that does not exist is null.
  Json (*evaluate)(const Json& arguments);
};

[[nodiscard]] const std::vector<FormulaEntry>& formulas();

/// nullptr when there is no such formula.
[[nodiscard]] const FormulaEntry* find_formula(std::string_view name);

}  // namespace dualdamp::scenarios
