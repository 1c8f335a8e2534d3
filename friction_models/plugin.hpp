#pragma once
/// Laws from outside the tree: shared libraries that speak the C interface of `dualdamp_law.h`.
///
/// A library is loaded once and checked; its law then joins laws() and is treated like any other: parameters,
/// schema, listing, modifiers and conformance suite apply to it. It is never unloaded.
///
/// Errors. A file that is no such library, or whose table breaks the interface: core::InputError with the reason. A
/// law that breaks its contract while a motion is computed (a status other than 0, NaN, a mode it did not declare,
/// an exception): LawFault. A crash of the library crashes the program.

#include <string>

#include "friction_models/dualdamp_law.h"

namespace dualdamp::friction {

/// Loads the library `file` and adds its law; does nothing for a file that is loaded already. Call it before laws()
/// is used, as add_law().
void load_plugin(const std::string& file);

/// Adds the law of a table in memory, for laws written in another language. `table` and its functions live as long
/// as the program; `origin` stands for the file in messages and in the provenance of results, `sha256` is that of
/// the law's source.
void add_plugin(const dualdamp_law_table& table, const std::string& origin, const std::string& sha256);

}  // namespace dualdamp::friction
