#include "identify/readers/text.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/diagnostics.hpp"

namespace dualdamp::identify {

namespace {

/// Length of the UTF-8 character at the start of `text`; 0 when there is none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
  // Overlong forms, surrogates and code points beyond the last one.
  if (lead == 0xE0 && byte(1) < 0xA0) return 0;
  if (lead == 0xED && byte(1) > 0x9F) return 0;
  if (lead == 0xF0 && byte(1) < 0x90) return 0;
  if (lead == 0xF4 && byte(1) > 0x8F) return 0;
  return length;
}

bool is_control(char c) {
  return (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7F;
}

/// Bytes of `text` before the first one that is a control character or no UTF-8.
std::size_t length_of_text(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const std::size_t length = is_control(text[i]) ? 0 : utf8_length(text.substr(i));
    if (length == 0) break;
    i += length;
  }
  return i;
}

}  // namespace

void refuse_binary(std::string_view text, const std::string& file) {
  const std::size_t end = length_of_text(text);
  if (end == text.size()) return;
  const std::string_view before = text.substr(0, end);
  const std::size_t line_start = before.rfind('\n') + 1;  // 0 without one
  core::Diagnostic problem;
  problem.place = {file,
                   static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
                   static_cast<int>(std::min<std::size_t>(end - line_start, 1'000'000)) + 1,
                   {}};
  problem.message =
      is_control(text[end]) ? "the file is not text: it holds a control character" : "the text is not UTF-8";
  problem.allowed = "a text file in UTF-8";
  throw core::InputError(std::move(problem));
}

std::string to_utf8(std::string_view text) {
  if (length_of_text(text) == text.size()) return std::string(text);
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80) {
      result += static_cast<char>(0xC0U | (byte >> 6U));
      result += static_cast<char>(0x80U | (byte & 0x3FU));
    } else {
      result += byte < 0x20 || byte == 0x7F ? '?' : c;
    }
  }
  return result;
}

}  // namespace dualdamp::identify
