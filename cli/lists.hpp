#pragma once
/// The registries as text: `dualdamp laws`, `dualdamp methods` and `dualdamp analyses`.

#include <string>

namespace dualdamp::cli {

struct Listing {
  std::string text;  ///< the list or the description, or why there is none
  bool found = true;
};

/// A list of all laws if `name` is empty, else the description of the law `name`.
[[nodiscard]] Listing list_laws(const std::string& name);
/// A list of all methods, or the description of one.
[[nodiscard]] Listing list_methods(const std::string& name);
/// A list of all analyses, or the description of one.
[[nodiscard]] Listing list_analyses(const std::string& name);

}  // namespace dualdamp::cli
