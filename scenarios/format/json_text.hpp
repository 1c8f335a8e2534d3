#pragma once
/// JSON that comes from outside: a key, the result of a fit.

#include <string_view>

#include "scenarios/format/json.hpp"

namespace dualdamp::scenarios {

/// Discarded (`is_discarded`) where the text is no whole document, or nests deeper than any that the program
/// writes: each of a million levels would cost a hundred bytes.
[[nodiscard]] Json parse_json(std::string_view text);

}  // namespace dualdamp::scenarios
