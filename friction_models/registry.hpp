#pragma once
/// The list of laws, sorted by name: the built-in ones, and those that plugins add.

#include <string_view>
#include <vector>

#include "friction_models/law_entry.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

[[nodiscard]] const std::vector<LawEntry>& laws();

/// Adds a law from outside, with a new name; the parameters of its modifiers are added to its own. Entries move in
/// memory, so call it when the program starts, before any other use of laws() and while no other thread runs.
void add_law(LawEntry entry);

/// Removes an added law; does nothing if none has that name. Call it only when add_law() may be called.
void remove_added_law(std::string_view name);

/// nullptr when there is no such law.
[[nodiscard]] const LawEntry* find_law(std::string_view name);

/// Fills in the defaults of `values` and returns the faults against the law's table; if there are none, those that
/// its `check` finds.
[[nodiscard]] std::vector<ParameterFault> complete(const LawEntry& law, ParameterValues& values);

}  // namespace dualdamp::friction
