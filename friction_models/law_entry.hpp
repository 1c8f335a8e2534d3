#pragma once
/// The entry of a law in the list of laws: name, texts, facts, parameters, and how the law is made from values. The
/// source of a law defines its entry once; listing, schema, checks and documentation use it.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/provenance.hpp"
#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

/// The engine that runs the law alone, without modifiers that need the smooth engine.
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
  /// Those of the law; in `laws()` also those of its modifiers.
  std::vector<Parameter> parameters{};
  /// Laws in parallel that make up this one. `values` complete.
  std::function<std::vector<Law>(const ParameterValues& values)> make{};
  /// Rules between values, each of which is in range. `values` complete. May be absent.
  std::function<std::vector<ParameterFault>(const ParameterValues& values)> check{};
  /// Warnings about these complete values. May be absent.
  std::function<std::vector<std::string>(const ParameterValues& values)> warnings{};
  std::vector<std::string_view> limits{};  ///< of a plugin: the parameters on which modifiers act
  std::optional<core::Plugin> plugin{};    ///< the library it comes from; none: it is built in
};

}  // namespace dualdamp::friction
