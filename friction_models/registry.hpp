#pragma once
/// The list of laws, sorted by name: the built-in ones, and those that plugins add.

#include <string_view>
#include <vector>

#include "friction_models/law_entry.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

[[nodiscard]] const std::vector<LawEntry>& laws();

/// Adds a law from outside, whose name is new; the parameters of its modifiers are added to its own. Entries move
/// in memory: call it when the program starts, before any other use of laws() and while no other thread runs.
void add_law(LawEntry entry);

/// Takes away a law that was added; nothing where there is none of that name. When: as add_law().
void remove_added_law(std::string_view name);

/// nullptr when there is no such law.
[[nodiscard]] const LawEntry* find_law(std::string_view name);

/// Fills in the defaults of `values` and returns every fault that the law's table shows; where it shows none, those
/// that its `check` finds.
[[nodiscard]] std::vector<ParameterFault> complete(const LawEntry& law, ParameterValues& values);

}  // namespace dualdamp::friction
