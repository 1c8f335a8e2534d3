#pragma once
/// Text in UTF-8: its characters, and cuts between them.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dualdamp::core {

/// With which some programs begin a text.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

struct Character {
  std::uint32_t code = 0;
  std::size_t length = 1;  ///< bytes
};

/// The character that begins at the byte `at`, which is inside the text. Nothing if the bytes are not a character:
/// overlong forms, surrogates and codes above U+10FFFF are refused.
[[nodiscard]] std::optional<Character> decode(std::string_view text, std::size_t at);

/// Characters, not bytes.
[[nodiscard]] std::size_t count_characters(std::string_view text);

/// The beginning of `text`: at most `bytes` bytes, cut between characters.
[[nodiscard]] std::string_view beginning(std::string_view text, std::size_t bytes);

/// The beginning of `text`, followed by "..." if that is not the whole text.
[[nodiscard]] std::string shortened(std::string_view text, std::size_t bytes);

}  // namespace dualdamp::core
