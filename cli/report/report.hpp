#pragma once
/// The page of a result directory, made from result.json and the tables beside it.

#include <string>

#include "scenarios/results/files.hpp"

namespace dualdamp::cli {

/// The file report.html of `directory`. Lists in result.json with more than 5000 items, and tables with more than
/// 50,000 rows (200,000 of a map), are thinned out, and the page says so. Tables of another run or program are not
/// shown. Errors: `core::InputError`, thrown when the file is written, if there is no result.json of this program.
[[nodiscard]] scenarios::OutputFile report_page(const std::string& directory, const std::string& units = {});

}  // namespace dualdamp::cli
