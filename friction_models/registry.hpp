#pragma once
/// The list of laws, sorted by name: the built-in ones, one entry a law, and those that plugins add.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/provenance.hpp"
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
  bool is_odd = true;                         ///< the mirrored motion gives the mirrored force
  bool is_passive = true;                     ///< never gives out more work than it took in
  std::string_view caution{};                 ///< what the literature warns of, in one sentence; empty: nothing
  std::string_view sources{};                 ///< keys in `docs/refs.bib`
  std::vector<std::string_view> modifiers{};  ///< names of those it supports
  /// Its own and, once in `laws()`, those of its modifiers.
  std::vector<Parameter> parameters{};
  /// Laws in parallel that make up this one. `values` complete.
  std::function<std::vector<Law>(const ParameterValues& values)> make{};
  /// What its table cannot say: rules between values that each are in range. `values` complete. May be absent.
  std::function<std::vector<ParameterFault>(const ParameterValues& values)> check{};
  /// What to warn of with these complete values.
  std::function<std::vector<std::string>(const ParameterValues& values)> warnings{};
  std::vector<std::string_view> limits{};  ///< parameters that modifiers act on, where the entry says so
  std::optional<core::Plugin> plugin{};    ///< the library it comes from; none: it is built in
};

[[nodiscard]] const std::vector<LawEntry>& laws();

/// Adds a law from outside, whose name is new; the parameters of its modifiers join its own. To be called when the
/// program starts, before anything is read by laws() and while no other thread runs: entries move.
void add_law(LawEntry entry);

/// nullptr when there is no such law.
[[nodiscard]] const LawEntry* find_law(std::string_view name);

/// Fills in the defaults of `values` and returns every fault by the law's table; without one, those by its `check`.
[[nodiscard]] std::vector<ParameterFault> complete(const LawEntry& law, ParameterValues& values);

}  // namespace dualdamp::friction
