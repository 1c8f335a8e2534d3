#pragma once
/// The list of built-in laws: explicit, sorted by name, one line a law.

#include <functional>
#include <string_view>
#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

enum class EngineKind { exact, smooth };

struct LawEntry {
  std::string_view name;      ///< YAML name
  std::string_view summary;   ///< one line
  std::string_view equation;  ///< plain text, for `dualdamp laws NAME`
  EngineKind engine;
  const std::vector<Parameter>& parameters;
  Law (*make)(const ParameterValues& values);  ///< `values` complete and in range
};

[[nodiscard]] const std::vector<LawEntry>& laws();

/// nullptr when there is no such law.
[[nodiscard]] const LawEntry* find_law(std::string_view name);

}  // namespace dualdamp::friction
