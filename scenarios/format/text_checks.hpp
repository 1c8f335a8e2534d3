#pragma once
/// Faults of a text that do not depend on its format: bytes that are not UTF-8, control and invisible characters,
/// tabs.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dualdamp::scenarios {

struct TextFault {
  std::size_t offset = 0;  ///< byte
  std::string message;
};

/// Removes a byte order mark and turns CR LF into LF.
[[nodiscard]] std::string normalised(std::string_view text);

/// At most one fault a line and 20 in all.
[[nodiscard]] std::vector<TextFault> text_faults(std::string_view text);

}  // namespace dualdamp::scenarios
