#pragma once
/// The brackets of a heading such as `Weg (Kanal 2) [mm]`.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dualdamp::identify {

/// One pair of brackets of a text, and what it holds.
struct Bracket {
  char opening = '[';
  std::string content;    ///< without blanks at its ends
  std::size_t begin = 0;  ///< index of the opening bracket
  std::size_t end = 0;    ///< index behind the closing one
};

struct Brackets {
  std::vector<Bracket> pairs;  ///< in the order of the text; brackets within brackets belong to the outer ones
  bool are_closed = true;      ///< false: an opening bracket without its closing one, or only closing ones
};

/// The pairs `[]`, `()`, `{}` and `<>` of a text.
[[nodiscard]] Brackets brackets_of(std::string_view text);

}  // namespace dualdamp::identify
