#pragma once
/// The comparison of several results: one page, one table, one SVG file.

#include <string>
#include <vector>

#include "scenarios/results/files.hpp"

namespace dualdamp::cli {

/// The files compare.html, compare.csv and compare.svg, with the main charts of the result directories. The units
/// are those that the user wrote in the first scenario, or those of `units`, separated by commas. The legend has
/// the titles if these differ, else the keys in which the resolved scenarios differ, else the directories. Errors:
/// `core::InputError` if a directory has no result, no chart, a map, or a result of another analysis than the
/// first.
[[nodiscard]] std::vector<scenarios::OutputFile> comparison(const std::vector<std::string>& directories,
                                                            const std::string& units = {});

}  // namespace dualdamp::cli
