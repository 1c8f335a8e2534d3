#include "identify/readers/brackets.hpp"

#include "identify/readers/text.hpp"

namespace dualdamp::identify {

namespace {

constexpr std::string_view opening = "[({<";
constexpr std::string_view closing = "])}>";

/// Index of the bracket that closes the one at `begin`; npos if there is none.
std::size_t closing_of(std::string_view text, std::size_t begin) {
  const char open = text[begin];
  const char close = closing[opening.find(open)];
  std::size_t depth = 0;
  for (std::size_t i = begin; i < text.size(); ++i) {
    if (text[i] == open) ++depth;
    if (text[i] == close && --depth == 0) return i;
  }
  return std::string_view::npos;
}

}  // namespace

Brackets brackets_of(std::string_view text) {
  Brackets found;
  for (std::size_t at = text.find_first_of(opening); at != std::string_view::npos;
       at = text.find_first_of(opening, found.pairs.back().end)) {
    const std::size_t close = closing_of(text, at);
    if (close == std::string_view::npos) {
      found.are_closed = false;
      return found;
    }
    found.pairs.push_back({text[at], std::string(trimmed(text.substr(at + 1, close - at - 1))), at, close + 1});
  }
  if (found.pairs.empty()) found.are_closed = text.find_first_of(closing) == std::string_view::npos;
  return found;
}

}  // namespace dualdamp::identify
