#pragma once
/// The text of a data file in its possible encodings, and its conversion to UTF-8 without control characters, which
/// messages and JSON need.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/units.hpp"

namespace dualdamp::identify {

/// Whether the text is UTF-16: it begins with a byte order mark, or every other one of the first bytes is zero.
[[nodiscard]] bool is_utf16(std::string_view bytes);

/// The bytes as UTF-8 without byte order mark. UTF-16 is converted. A text without control characters that is not
/// valid UTF-8 is read as Windows-1252 (western European letters), with a warning. Errors: as `refuse_binary`.
[[nodiscard]] std::string decoded(std::string_view bytes, const std::string& file,
                                  std::vector<std::string>& warnings);

/// The bytes in another encoding, both by their names for iconv. Nothing if they are not valid in `from`.
[[nodiscard]] std::optional<std::string> converted(std::string_view bytes, const char* from,
                                                   const char* to = "UTF-8");

/// Throws `core::InputError` with line and column if the text is not UTF-8, or has control characters other than
/// tab and line ends.
void refuse_binary(std::string_view text, const std::string& file);

/// `text` if it is UTF-8, else `text` read as Latin-1 ("m/s²"). Control characters become question marks.
[[nodiscard]] std::string to_utf8(std::string_view text);

using core::trimmed;

/// The beginning of `text` that fits into a message, cut between characters.
[[nodiscard]] std::string excerpt(std::string_view text);

/// The same between quotes.
[[nodiscard]] std::string quoted(std::string_view text);

}  // namespace dualdamp::identify
