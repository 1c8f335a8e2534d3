#pragma once
/// Laws from outside the tree: shared libraries that speak the C interface of `dualdamp_law.h`.
///
/// A library is loaded once, checked, and its law joins laws(); from then on it is a law like any other:
/// parameters, schema, listing, modifiers and conformance suite work on it. It is never unloaded.
///
/// Errors. A file that is no such library, or whose table breaks the interface: core::InputError, which says what
/// is wrong. A law that breaks its contract while a motion is computed (a status other than 0, NaN, a mode it did
/// not declare, an exception that should not have crossed): LawFault. A crash of the library is one of the program.

#include <string>

namespace dualdamp::friction {

/// Loads the library `file` and adds its law; does nothing for a file that is loaded already. As add_law, to be
/// called before laws() is used.
void load_plugin(const std::string& file);

}  // namespace dualdamp::friction
