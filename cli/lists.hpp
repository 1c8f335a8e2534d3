#pragma once
/// The registries for people: `dualdamp laws`, `dualdamp methods` and `dualdamp analyses`.

#include <string>

namespace dualdamp::cli {

struct Listing {
  std::string text;  ///< the list, or why there is none
  bool found = true;
};

/// All laws, or what `name` is.
[[nodiscard]] Listing list_laws(const std::string& name);
/// All methods, or what `name` is.
[[nodiscard]] Listing list_methods(const std::string& name);
/// All analyses, or what `name` is.
[[nodiscard]] Listing list_analyses(const std::string& name);

}  // namespace dualdamp::cli
