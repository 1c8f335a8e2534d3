#include "scenarios/format/text_checks.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>

#include "core/utf8.hpp"

namespace dualdamp::scenarios {

namespace {

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
  if (text.starts_with(core::byte_order_mark)) text.remove_prefix(core::byte_order_mark.size());
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] != '\r' || i + 1 == text.size() || text[i + 1] != '\n') result += text[i];
  return result;
}

std::vector<TextFault> text_faults(std::string_view text) {
  constexpr std::size_t max_faults = 20;
  std::vector<TextFault> faults;
  bool line_has_fault = false;
  for (std::size_t at = 0; at < text.size() && faults.size() < max_faults;) {
    const std::optional<core::Character> character = core::decode(text, at);
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
