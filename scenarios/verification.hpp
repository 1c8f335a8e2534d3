#pragma once
/// The result of a run computed again in another way: by the other engine, or by other steps of the smooth engine,
/// at a tight tolerance; a steady state also by following the transient. Then every quantity is compared. A result
/// of the exact engine that one kind of steps does not confirm is computed by the other kind too, and one of both
/// must agree: errors of many steps add up, and no fault of the exact engine is repeated by either.
///
/// A difference is relative: to the point's own value in curves and maps, else to the largest value of the same
/// unit in the result (of a speed also the largest mean one between two events or samples), so that a position near
/// zero is not asked for digits that the motion does not have, or to what is rounding beside the drive, where the
/// mass never moves. Phases differ modulo 2 pi, Floquet multipliers are compared as a set. Counts, words and truths
/// are equal or not. Left out are the numbers that tell how a result was computed (`certificate`, `energy.defect`)
/// and grazings, which rounding decides; the order of events at one time and the period with which a subharmonic
/// motion begins are no difference (`aligned_answer.hpp`).

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/results/answer.hpp"
#include "scenarios/scenario.hpp"
#include "sim/model.hpp"

namespace dualdamp::scenarios {

struct Verification {
  std::string engine;               ///< what computed the result again, in words
  double largest_difference = 0.0;  ///< relative, of the quantity that is nearest to its tolerance, or beyond it
  double tolerance = 0.0;           ///< of that quantity
  std::string quantity;             ///< its path in the result; empty: there was nothing to compare
  long quantities = 0;              ///< how many values were compared
  long rows_left_out = 0;           ///< rows of lists for which one of the computations has a reason and no number
  bool agrees = true;
  std::string reason;  ///< in words, where it does not agree or could not be computed
};

/// Largest relative difference of a quantity of this unit that is taken for an error of computation.
[[nodiscard]] double verification_tolerance(std::string_view unit);

/// The smallest size by which the numbers of a unit are measured.
using SizesOfUnits = std::map<std::string, double>;

/// Sizes of which a tolerance is rounding beside the drive and the initial state.
[[nodiscard]] SizesOfUnits sizes_of_rounding(const sim::Model& model);

/// Compares two answers to the same question.
[[nodiscard]] Verification compare_answers(const Answer& answer, const Answer& other,
                                           const std::vector<ResultField>& fields,
                                           const SizesOfUnits& rounding = {});

/// Computes the answer of this scenario again and compares it. The scenario's analysis must be verifiable.
[[nodiscard]] Verification verify(const Scenario& scenario, const RunOptions& options, const Answer& answer);

}  // namespace dualdamp::scenarios
