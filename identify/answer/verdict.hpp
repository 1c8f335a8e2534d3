#pragma once
/// The sentences of an identification: the answer and what the data contradict, why this estimate answers, or why
/// none does and what would help.
///
/// Errors: none thrown; sentences about an answer expect one.

#include <string>
#include <vector>

#include "identify/assumption.hpp"

namespace dualdamp::identify {

struct Identification;

/// Why the estimate that answers was preferred, and what no test could show.
[[nodiscard]] std::string why_preferred(const Identification& all);

/// Why no estimate answers, and what would help.
[[nodiscard]] std::string why_none(const Identification& all);

/// The answer with its intervals, every departure that was found, and the ranges beyond the interval.
[[nodiscard]] std::string verdict_of(const Identification& all);

/// "the spring is linear, or that nothing drifts": `last` stands before the last statement.
[[nodiscard]] std::string statements_of(const std::vector<Assumption>& list, const std::string& last);

/// A value as sentences show it.
[[nodiscard]] std::string four_digits(double value);

}  // namespace dualdamp::identify
