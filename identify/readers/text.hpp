#pragma once
/// What bytes of a data file may go into messages and into JSON: UTF-8 without control characters.

#include <string>
#include <string_view>

namespace dualdamp::identify {

/// Refuses what is not UTF-8, or holds control characters but tab and line ends: `core::InputError` with line and
/// column.
void refuse_binary(std::string_view text, const std::string& file);

/// `text` where it is UTF-8, else read as Latin-1 ("m/s²"), with question marks for control characters.
[[nodiscard]] std::string to_utf8(std::string_view text);

}  // namespace dualdamp::identify
