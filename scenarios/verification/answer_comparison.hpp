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

namespace dualdamp::scenarios {

struct Verification {
  std::string engine;               ///< how the result was computed again, in words
  double largest_difference = 0.0;  ///< relative, of the quantity that is nearest to its tolerance, or beyond it
  double tolerance = 0.0;           ///< of that quantity
  std::string quantity;             ///< its path in the result; empty: there was nothing to compare
  long quantities = 0;              ///< number of compared values
  long rows_left_out = 0;           ///< rows of lists for which only one computation has numbers
  long rows_without_numbers = 0;    ///< rows of lists for which both have a reason instead
  long others_left_out = 0;         ///< other steady states that only one computation knows
  long times_left_out = 0;          ///< times of events of a mass that hardly moves
  long multipliers_left_out = 0;    ///< Floquet multipliers that depend on a slider at its limit
  double time_shift = 0.0;          ///< largest one by which a number at a given time was compared [s]
  bool agrees = true;
  std::string reason;  ///< why it does not agree or could not be computed
};

/// Largest relative difference of a quantity of this unit that counts as an error of computation.
[[nodiscard]] double verification_tolerance(std::string_view unit);

/// The finest reference size for the numbers of a unit.
using SizesOfUnits = std::map<std::string, double>;

/// Compares two answers to the same question.
[[nodiscard]] Verification compare_answers(const Answer& answer, const Answer& other,
                                           const std::vector<ResultField>& fields, const SizesOfUnits& finest = {});

}  // namespace dualdamp::scenarios
