#include "scenarios/format/text_checks.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>

namespace dualdamp::scenarios {

namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t length = 1;
};

/// The UTF-8 character at `at`; nothing when the bytes are not one (overlong forms and surrogates included).
std::optional<Character> decode(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t lead = byte(at);
  if (lead < 0x80) return Character{lead, 1};
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || at + length > text.size()) return std::nullopt;
  std::uint32_t code = lead & (0x7FU >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xC0U) != 0x80U) return std::nullopt;
    code = (code << 6U) | (byte(at + i) & 0x3FU);
  }
  static constexpr std::array<std::uint32_t, 5> smallest = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < smallest.at(length) || code > 0x10FFFF || surrogate) return std::nullopt;
  return Character{code, length};
}

/// Unusual spaces, characters without width, and those that change the direction of writing.
bool is_invisible(std::uint32_t code) {
  return code == 0xA0 || code == 0xAD || (code >= 0x2000 && code <= 0x200F) || (code >= 0x2028 && code <= 0x202F) ||
         (code >= 0x205F && code <= 0x206F) || code == 0x3000 || code == 0xFEFF;
}

std::string code_name(std::uint32_t code) {
  std::array<char, 16> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "U+%04X", static_cast<unsigned int>(code));
  return buffer.data();
}

std::string complaint(std::uint32_t code) {
  if (code == '\t') return "a tab: indent and separate with spaces";
  if (code < 0x20 || (code >= 0x7F && code < 0xA0)) return "the control character " + code_name(code);
  if (is_invisible(code)) return "the invisible character " + code_name(code) + ": type a plain space or remove it";
  return {};
}

}  // namespace

std::string normalised(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] != '\r' || i + 1 == text.size() || text[i + 1] != '\n') result += text[i];
  return result;
}

int count_characters(std::string_view text) {
  // Bytes that begin a UTF-8 character.
  return static_cast<int>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::vector<TextFault> text_faults(std::string_view text) {
  constexpr std::size_t max_faults = 20;
  std::vector<TextFault> faults;
  bool line_has_fault = false;
  for (std::size_t at = 0; at < text.size() && faults.size() < max_faults;) {
    const std::optional<Character> character = decode(text, at);
    if (!character) {
      // After this the text cannot be interpreted, not even line ends.
      faults.push_back({at, "this is not UTF-8 text"});
      return faults;
    }
    if (character->code == '\n') {
      line_has_fault = false;
    } else if (!line_has_fault) {
      if (std::string message = complaint(character->code); !message.empty()) {
        faults.push_back({at, std::move(message)});
        line_has_fault = true;
      }
    }
    at += character->length;
  }
  return faults;
}

}  // namespace dualdamp::scenarios
