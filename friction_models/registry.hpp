#pragma once
/// The list of laws, sorted by name: the built-in ones, and those that plugins add.

#include <string_view>
#include <vector>

#include "friction_models/law_entry.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

[[nodiscard]] const std::vector<LawEntry>& laws();

/// Adds a law from outside, whose name is new; the parameters of its modifiers join its own. To be called when the
/// program starts, before anything is read by laws() and while no other thread runs: entries move.
void add_law(LawEntry entry);

/// nullptr when there is no such law.
[[nodiscard]] const LawEntry* find_law(std::string_view name);

/// Fills in the defaults of `values` and returns every fault by the law's table; without one, those by its `check`.
[[nodiscard]] std::vector<ParameterFault> complete(const LawEntry& law, ParameterValues& values);

}  // namespace dualdamp::friction
