#include "identify/readers/text.hpp"

#include <iconv.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/utf8.hpp"

namespace dualdamp::identify {

namespace {

bool is_control(char c) {
  return (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7F;
}

/// Number of bytes of `text` before the first control character or invalid UTF-8.
std::size_t length_of_text(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const auto character = is_control(text[i]) ? std::nullopt : core::decode(text, i);
    if (!character) break;
    i += character->length;
  }
  return i;
}

constexpr std::string_view little_mark = "\xFF\xFE";
constexpr std::string_view big_mark = "\xFE\xFF";

/// Share of zeros among the even or odd bytes at the beginning of a text.
double zeros(std::string_view bytes, std::size_t first) {
  const std::size_t length = std::min<std::size_t>(bytes.size(), 1000);
  std::size_t count = 0;
  for (std::size_t i = first; i < length; i += 2) count += bytes[i] == '\0' ? 1 : 0;
  return length < 4 ? 0.0 : 2.0 * static_cast<double>(count) / static_cast<double>(length);
}

/// Name of the encoding for iconv if the text is UTF-16; nothing for other texts.
const char* utf16_order(std::string_view bytes) {
  constexpr double many = 0.6;
  constexpr double few = 0.05;
  if (bytes.starts_with(little_mark)) return "UTF-16LE";
  if (bytes.starts_with(big_mark)) return "UTF-16BE";
  if (zeros(bytes, 1) > many && zeros(bytes, 0) < few) return "UTF-16LE";
  if (zeros(bytes, 0) > many && zeros(bytes, 1) < few) return "UTF-16BE";
  return nullptr;
}

/// Removes the byte 1A, with which DOS ended a text.
std::string without_end_mark(std::string text) {
  if (text.ends_with('\x1A')) text.pop_back();
  return text;
}

/// Replaces no-break and narrow blanks by blanks, and the typographic minus by the ASCII one.
std::string plain_signs(std::string text) {
  constexpr std::array<std::pair<std::string_view, char>, 5> signs = {{{"\xC2\xA0", ' '},
                                                                       {"\xE2\x80\xAF", ' '},
                                                                       {"\xE2\x80\x89", ' '},
                                                                       {"\xE2\x80\x87", ' '},
                                                                       {"\xE2\x88\x92", '-'}}};
  std::string plain;
  std::size_t done = 0;
  for (std::size_t i = text.find_first_of("\xC2\xE2"); i != std::string::npos;
       i = text.find_first_of("\xC2\xE2", i + 1)) {
    const std::string_view rest = std::string_view(text).substr(i);
    const auto* const sign =
        std::ranges::find_if(signs, [rest](const auto& s) { return rest.starts_with(s.first); });
    if (sign == signs.end()) continue;
    plain.append(text, done, i - done);
    plain += sign->second;
    done = i + sign->first.size();
  }
  return done == 0 ? std::move(text) : plain.append(text, done);
}

/// Removes byte order marks. There may be two, if a program has put one before a text that had one.
std::string without_mark(std::string text) {
  std::size_t end = 0;
  while (std::string_view(text).substr(end).starts_with(core::byte_order_mark)) end += core::byte_order_mark.size();
  text.erase(0, end);
  return text;
}

}  // namespace

bool is_utf16(std::string_view bytes) { return utf16_order(bytes) != nullptr; }

std::optional<std::string> converted(std::string_view bytes, const char* from, const char* to) {
  struct Close {
    void operator()(void* descriptor) const { iconv_close(descriptor); }
  };
  const iconv_t raw = iconv_open(to, from);
  if (raw == reinterpret_cast<iconv_t>(-1)) return std::nullopt;  // NOLINT: iconv's value for a failure
  const std::unique_ptr<void, Close> descriptor(raw);
  std::string text;
  std::array<char, 1U << 16U> buffer{};
  char* next = const_cast<char*>(bytes.data());  // NOLINT(*-const-cast): iconv does not write there
  std::size_t left = bytes.size();
  while (left > 0) {
    char* end = buffer.data();
    std::size_t room = buffer.size();
    const bool done = iconv(descriptor.get(), &next, &left, &end, &room) != static_cast<std::size_t>(-1);
    const int fault = errno;
    text.append(buffer.data(), buffer.size() - room);
    if (!done && fault != E2BIG) return std::nullopt;
  }
  return text;
}

std::string decoded(std::string_view bytes, const std::string& file, std::vector<std::string>& warnings) {
  std::string text;
  if (const char* const order = utf16_order(bytes)) {
    std::optional<std::string> utf8 = converted(bytes, order);
    if (!utf8)
      throw core::InputError(
          core::Diagnostic{{file, 0, 0, {}}, "the text is not valid UTF-16", "a text file in UTF-8", {}, {}});
    text = without_mark(std::move(*utf8));
  } else {
    text = without_end_mark(without_mark(std::string(bytes)));
    const std::size_t end = length_of_text(text);
    const bool has_control = std::ranges::any_of(text, is_control);
    if (end < text.size() && !has_control) {
      if (std::optional<std::string> western = converted(text, "WINDOWS-1252")) {
        const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n') + 1;
        warnings.push_back(
            "the text is not UTF-8 and is read as Windows-1252 (Latin-1); the first such letter is in line " +
            std::to_string(line));
        text = std::move(*western);
      }
    }
  }
  refuse_binary(text, file);
  return plain_signs(std::move(text));
}

void refuse_binary(std::string_view text, const std::string& file) {
  const std::size_t end = length_of_text(text);
  if (end == text.size()) return;
  const std::string_view before = text.substr(0, end);
  const std::size_t line_start = before.rfind('\n') + 1;  // 0 if there is none
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

std::string excerpt(std::string_view text) { return std::string(core::beginning(text, 200)); }

std::string quoted(std::string_view text) { return "'" + excerpt(text) + "'"; }

}  // namespace dualdamp::identify
