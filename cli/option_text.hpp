#pragma once
/// Texts of options: NAME=VALUE, and texts that become values of a scenario.

#include <string>
#include <utility>

namespace dualdamp::cli {

/// The text as a quoted YAML string. A file name may hold any character.
[[nodiscard]] std::string in_quotes(const std::string& text);

/// Name and value of NAME=VALUE; the value is empty where there is no sign.
[[nodiscard]] std::pair<std::string, std::string> split_at_equals(const std::string& text);

}  // namespace dualdamp::cli
