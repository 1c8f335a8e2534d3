#pragma once
/// JSON from outside the program: the value of a key, the result of a fit.

#include <string_view>

#include "scenarios/format/json.hpp"

namespace dualdamp::scenarios {

/// Discarded (`is_discarded`) if the text is not a complete document, or nests deeper than any document that the
/// program writes: each of a million levels would cost a hundred bytes.
[[nodiscard]] Json parse_json(std::string_view text);

}  // namespace dualdamp::scenarios
