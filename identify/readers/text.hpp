#pragma once
/// The text of a data file, in the encodings in which laboratories write it; what of it may go into messages and
/// into JSON: UTF-8 without control characters.

#include <string>
#include <string_view>
#include <vector>

namespace dualdamp::identify {

/// The first bytes are those of a text in UTF-16: a byte order mark, or every other byte zero.
[[nodiscard]] bool is_utf16(std::string_view bytes);

/// The bytes as UTF-8 without byte order mark. UTF-16 is converted. What is no UTF-8 but has no control characters
/// either is read as Windows-1252, the Latin letters of western Europe, with a warning. Errors: as `refuse_binary`.
[[nodiscard]] std::string decoded(std::string_view bytes, const std::string& file,
                                  std::vector<std::string>& warnings);

/// Refuses what is not UTF-8, or holds control characters but tab and line ends: `core::InputError` with line and
/// column.
void refuse_binary(std::string_view text, const std::string& file);

/// `text` where it is UTF-8, else read as Latin-1 ("m/s²"), with question marks for control characters.
[[nodiscard]] std::string to_utf8(std::string_view text);

/// Without blanks and tabs at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The beginning of `text` that fits into a message, cut between characters.
[[nodiscard]] std::string excerpt(std::string_view text);

/// The same between quotes.
[[nodiscard]] std::string quoted(std::string_view text);

}  // namespace dualdamp::identify
