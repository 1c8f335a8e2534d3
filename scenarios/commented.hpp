#pragma once
/// A scenario to begin with: the meaning of each key beside it, and keys that may be added as comments.

#include <string>

#include "scenarios/analyses/analysis.hpp"

namespace dualdamp::scenarios {

/// `text`: a scenario, whose values stay and whose `expect` and comments go; `analyses`: those it may ask for.
/// Errors: `core::InputError` where it is none.
[[nodiscard]] std::string commented(const std::string& text, const AnalysisList& analyses);

}  // namespace dualdamp::scenarios
