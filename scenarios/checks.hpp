#pragma once
/// What no table of keys can say: how the sections of a scenario fit together. Words that stand for numbers
/// (`natural`, a damping ratio, all methods that fit) become numbers here, and measured data are read.

#include <optional>
#include <string>

#include "identify/readers/record_reader.hpp"
#include "scenarios/reader.hpp"

namespace dualdamp::scenarios {

struct CheckOptions {
  std::string directory;       ///< where data files are looked for
  bool data_anywhere = false;  ///< data files may lie outside it
};

/// Adds problems to `reading` and completes its values. The data are those of `analysis.data`, if it is there.
[[nodiscard]] std::optional<identify::MeasuredRecord> check(const Document& document, Reading& reading,
                                                            const CheckOptions& options);

/// `points[12].x` as the pattern `points[].x` of the tables and its indices; nothing when it is no path.
struct ResultPath {
  std::string pattern;
  std::vector<std::size_t> indices;
};

[[nodiscard]] std::optional<ResultPath> parse_result_path(const std::string& text);

}  // namespace dualdamp::scenarios
