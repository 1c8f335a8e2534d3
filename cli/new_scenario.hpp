#pragma once
/// `dualdamp new`: a scenario to begin with.

#include <string>
#include <string_view>
#include <vector>

#include "cli/lists.hpp"

namespace dualdamp::cli {

/// An example of each analysis, as files; written by cmake/write_templates.cmake.
[[nodiscard]] const std::vector<std::string_view>& templates();

/// A commented scenario that asks for an analysis, or why there is none.
[[nodiscard]] Listing new_scenario(const std::string& analysis);

}  // namespace dualdamp::cli
