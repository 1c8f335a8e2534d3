#pragma once
/// The path of a data file that a scenario names.

#include <optional>
#include <string>

#include "scenarios/format/checked_file.hpp"

namespace dualdamp::scenarios {

/// The path of the data file `name`, the value of `key`; nothing, and a problem in the file, if it is outside the
/// scenario's directory or is not a file. A name of data in memory is its own path.
[[nodiscard]] std::optional<std::string> path_of_data(CheckedFile& file, const std::string& key,
                                                      const std::string& name);

}  // namespace dualdamp::scenarios
