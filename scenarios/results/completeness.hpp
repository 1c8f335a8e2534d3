#pragma once
/// Check of a result before it is written: a number beyond the range of double precision must not appear as a
/// number that does not exist.

#include <string>

#include "scenarios/results/answer.hpp"

namespace dualdamp::scenarios {

/// The path of the first number of an answer that must be finite and is not, such as `energy.input` or
/// `events[3].t`; empty when there is none. In JSON a number that does not exist is null, not NaN. In a table with
/// complete rows, only a row with a reason may lack numbers, and only a cell with a reason of its own, such as
/// `phase_reason`.
[[nodiscard]] std::string missing_number(const Answer& answer);

}  // namespace dualdamp::scenarios
