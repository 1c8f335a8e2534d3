#pragma once
/// Where a data file lies that a scenario names.

#include <optional>
#include <string>

#include "scenarios/format/checked_file.hpp"

namespace dualdamp::scenarios {

/// The path of the data file `name`, the value of `key`; nothing, and a complaint, where it leads out of the
/// scenario's directory or is no file. A name that stands for data in memory is its own path.
[[nodiscard]] std::optional<std::string> path_of_data(CheckedFile& file, const std::string& key,
                                                      const std::string& name);

}  // namespace dualdamp::scenarios
