#pragma once
/// Compares two answers to the same question, quantity by quantity.
///
/// A difference is relative: to the point's own value in curves and maps, otherwise to the largest value of the
/// same unit in the result (for a speed also the largest mean speed between two events or samples), so that a
/// position near zero need not have digits that the motion does not have. If the mass hardly moves, the difference
/// is relative to a finest size, and times of events are not compared. Phases differ modulo 2 pi, Floquet
/// multipliers are compared as a set. Counts, words and truth values must be equal. Numbers about the computation
/// (`certificate`, `energy.defect`) and grazings, which rounding decides, are left out. The order of events at one
/// time and the period with which a subharmonic motion begins do not count as differences (`aligned_answer.hpp`). A
/// number at a given time is compared at the same time after the last event (`time_shift.hpp`).

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/format/result_field.hpp"
#include "scenarios/results/answer.hpp"
#include "scenarios/results/verification_result.hpp"

namespace dualdamp::scenarios {

/// Largest relative difference of a quantity of this unit that counts as an error of computation.
[[nodiscard]] double verification_tolerance(std::string_view unit);

/// The finest reference size for the numbers of a unit.
using SizesOfUnits = std::map<std::string, double>;

/// Compares two answers to the same question.
[[nodiscard]] Verification compare_answers(const Answer& answer, const Answer& other,
                                           const std::vector<ResultField>& fields, const SizesOfUnits& finest = {});

}  // namespace dualdamp::scenarios
