#pragma once
/// `dualdamp new`: a commented scenario as a first file.

#include <string>
#include <string_view>
#include <vector>

#include "cli/lists.hpp"

namespace dualdamp::cli {

/// The texts of one example of each analysis; cmake/write_templates.cmake writes them.
[[nodiscard]] const std::vector<std::string_view>& templates();

/// A commented scenario with this analysis, or why there is none.
[[nodiscard]] Listing new_scenario(const std::string& analysis);

}  // namespace dualdamp::cli
