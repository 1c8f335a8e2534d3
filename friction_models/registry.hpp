#pragma once
/// The list of built-in laws: explicit, sorted by name, one line a law.

#include <string>
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
  EngineKind engine = EngineKind::exact;
  std::string_view states{};  ///< what it remembers, in words; empty: nothing
  bool is_random = false;
  bool is_passive = true;                     ///< never gives out more work than it took in
  std::string_view caution{};                 ///< what the literature warns of, in one sentence; empty: nothing
  std::string_view sources{};                 ///< keys in `docs/refs.bib`
  std::vector<std::string_view> modifiers{};  ///< names of those it supports
  /// Its own and, once in `laws()`, those of its modifiers.
  std::vector<Parameter> parameters{};
  /// Laws in parallel that make up this one. `values` complete.
  std::vector<Law> (*make)(const ParameterValues& values) = nullptr;
  /// What its table cannot say: rules between values that each are in range. `values` complete. May be absent.
  std::vector<ParameterFault> (*check)(const ParameterValues& values) = nullptr;
  /// What to warn of with these complete values.
  std::vector<std::string> (*warnings)(const ParameterValues& values) = nullptr;
};

[[nodiscard]] const std::vector<LawEntry>& laws();

/// nullptr when there is no such law.
[[nodiscard]] const LawEntry* find_law(std::string_view name);

/// Fills in the defaults of `values` and returns every fault by the law's table; without one, those by its `check`.
[[nodiscard]] std::vector<ParameterFault> complete(const LawEntry& law, ParameterValues& values);

}  // namespace dualdamp::friction
