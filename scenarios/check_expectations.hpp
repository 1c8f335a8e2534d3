#pragma once
/// The paths of `expect` against what the analysis returns.

#include <optional>
#include <string>
#include <vector>

#include "scenarios/analyses/analysis.hpp"

namespace dualdamp::scenarios {

/// Adds problems to the file.
void check_expectations(CheckedFile& file, const Analysis& analysis);

/// `points[12].x` as the pattern `points[].x` of the tables and its indices; nothing when it is no path.
struct ResultPath {
  std::string pattern;
  std::vector<std::size_t> indices;
};

[[nodiscard]] std::optional<ResultPath> parse_result_path(const std::string& text);

}  // namespace dualdamp::scenarios
