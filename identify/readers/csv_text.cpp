#include "identify/readers/csv_text.hpp"

#include <charconv>

namespace dualdamp::identify {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

char separator_of(std::string_view header) {
  for (const char candidate : {'\t', ';'}) {
    bool inside = false;
    for (const char c : header) {
      if (c == '"') inside = !inside;
      if (c == candidate && !inside) return candidate;
    }
  }
  return ',';
}

void Fields::read_quoted() {
  unquoted_.clear();
  bool closed = false;
  for (++at_; at_ < line_.size() && !closed; ++at_) {
    const bool doubled = line_[at_] == '"' && at_ + 1 < line_.size() && line_[at_ + 1] == '"';
    closed = line_[at_] == '"' && !doubled;
    if (!closed) unquoted_ += line_[at_];
    if (doubled) ++at_;
  }
  const std::size_t end = std::min(line_.find(separator_, at_), line_.size());
  is_unclosed = is_unclosed || !closed || !trimmed(line_.substr(at_, end - at_)).empty();
  text = unquoted_;
  at_ = end;
}

Heading parse_heading(std::string_view text, int column) {
  Heading heading{std::string(text), std::string(trimmed(text)), {}, column, true};
  const std::size_t open = text.find_first_of("[(");
  if (open == std::string_view::npos) {
    heading.well_formed = text.find_first_of("])") == std::string_view::npos;
    return heading;
  }
  const std::string_view rest = text.substr(open + 1);
  const std::size_t close = rest.find(text[open] == '[' ? ']' : ')');
  heading.name = trimmed(text.substr(0, open));
  if (close != std::string_view::npos) heading.unit = trimmed(rest.substr(0, close));
  heading.well_formed = close != std::string_view::npos && close + 1 == rest.size();
  return heading;
}

Digits digits_of(std::string_view text) {
  Digits digits;
  bool point = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '.') point = true;
    if (c >= '0' && c <= '9') {
      if (c != '0' || digits.significant > 0) ++digits.significant;
      if (point) ++digits.decimals;
    }
    if (c == 'e' || c == 'E') {
      int exponent = 0;
      const std::size_t sign = i + 1 < text.size() && text[i + 1] == '+' ? 1 : 0;
      std::from_chars(text.data() + i + 1 + sign, text.data() + text.size(), exponent);
      digits.decimals -= exponent;
      return digits;
    }
  }
  return digits;
}

}  // namespace dualdamp::identify
