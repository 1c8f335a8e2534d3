#pragma once
/// A scenario to begin with: each key has its meaning beside it, and further possible keys are comments.

#include <string>

#include "scenarios/analysis.hpp"

namespace dualdamp::scenarios {

/// `text`: a scenario; its values are kept, its `expect` and comments are dropped. `analyses`: those it may ask
/// for. Errors: `core::InputError` if the text is not a scenario.
[[nodiscard]] std::string commented(const std::string& text, const AnalysisList& analyses);

}  // namespace dualdamp::scenarios
