#pragma once
/// The gate at the border of results: a number that left the range of double precision must not be read as one that
/// does not exist.

#include <string>

#include "scenarios/results/answer.hpp"

namespace dualdamp::scenarios {

/// The path of the first number of an answer that is not finite though it must be, such as `energy.input` or
/// `events[3].t`; empty when there is none. In JSON a number that does not exist is null, not NaN. In a table whose
/// rows are complete only a row with a reason may lack numbers.
[[nodiscard]] std::string missing_number(const Answer& answer);

}  // namespace dualdamp::scenarios
