#pragma once
/// Checks the paths of `expect` against the fields that the analysis returns.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/analysis.hpp"

namespace dualdamp::scenarios {

/// What is known of a result before the run.
struct Expectable {
  std::vector<ResultField> fields;
  std::string subject;  ///< "analysis 'xy_curve'"
  /// Length of a list, if it is known.
  std::function<std::optional<std::size_t>(std::string_view list)> length_of;
};

/// Adds problems to the file, which has a section `expect`.
void check_expectations(CheckedFile& file, const Expectable& result);

/// `points[12].x` as the pattern `points[].x` of the tables and its indices; nothing when the text is not a path.
struct ResultPath {
  std::string pattern;
  std::vector<std::size_t> indices;
};

[[nodiscard]] std::optional<ResultPath> parse_result_path(const std::string& text);

}  // namespace dualdamp::scenarios
