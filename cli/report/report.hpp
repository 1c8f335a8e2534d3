#pragma once
/// The page of a result directory: one HTML file that opens offline, made from result.json and the tables beside
/// it.

#include <optional>
#include <string>
#include <vector>

#include "scenarios/results/files.hpp"

namespace dualdamp::cli {

/// report.html of `directory`. Lists in result.json beyond 5000 items, and rows of a table beyond 50,000 (200,000
/// of a map), are thinned out and the page says so. Errors: `core::InputError` when there is no result.json or it
/// is none of ours; raised when the file is written. Tables that another run or program left there are not shown.
[[nodiscard]] scenarios::OutputFile report_page(const std::string& directory, const std::string& units = {});

/// What a directory holds of the run whose result.json stands there.
struct StoredResult {
  std::string source;               ///< scenario or data file
  std::vector<std::string> tables;  ///< names of their files
};

/// Nothing where there is no result of ours.
[[nodiscard]] std::optional<StoredResult> stored_result(const std::string& directory);

}  // namespace dualdamp::cli
