#pragma once
/// The paths of `expect` against what the analysis returns.

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/analyses/analysis.hpp"

namespace dualdamp::scenarios {

/// A result before it exists.
struct Expectable {
  std::vector<ResultField> fields;
  std::string subject;  ///< "analysis 'xy_curve'"
  /// How long a list will be, where that is known.
  std::function<std::optional<std::size_t>(std::string_view list)> length_of;
};

/// Adds problems to the file, which has a section `expect`.
void check_expectations(CheckedFile& file, const Expectable& result);

/// `points[12].x` as the pattern `points[].x` of the tables and its indices; nothing when it is no path.
struct ResultPath {
  std::string pattern;
  std::vector<std::size_t> indices;
};

[[nodiscard]] std::optional<ResultPath> parse_result_path(const std::string& text);

}  // namespace dualdamp::scenarios
