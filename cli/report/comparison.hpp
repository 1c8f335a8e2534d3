#pragma once
/// Several results over each other: one page, one table, one SVG file.

#include <string>
#include <vector>

#include "scenarios/results/files.hpp"

namespace dualdamp::cli {

/// compare.html, compare.csv and compare.svg: the main charts of the result directories in the units the user wrote
/// in the first one, or in those that `units` asks for, with commas. The legend is by title where titles differ,
/// else by the keys in which the resolved scenarios differ, else by directory. Errors: `core::InputError` where
/// there is no result, or no chart, a map, or the result of another analysis than the first one.
[[nodiscard]] std::vector<scenarios::OutputFile> comparison(const std::vector<std::string>& directories,
                                                            const std::string& units = {});

}  // namespace dualdamp::cli
