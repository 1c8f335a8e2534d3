#pragma once
/// Words in a row.

#include <string>
#include <string_view>
#include <vector>

namespace dualdamp::core {

/// "a, b, c"; with `last` = " and ": "a, b and c".
[[nodiscard]] std::string joined(const std::vector<std::string>& words, std::string_view last = ", ");

}  // namespace dualdamp::core
