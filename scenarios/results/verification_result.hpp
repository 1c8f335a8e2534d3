#pragma once
/// What the verification of a result found: a difference, and whether it is allowed.

#include <string>

#include "scenarios/format/json.hpp"

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

/// As in `result.json`.
[[nodiscard]] Json json_of(const Verification& verification);

/// The verification that was written so.
[[nodiscard]] Verification verification_of(const Json& json);

/// Whether `verification` is nearer to its tolerance: one that does not agree before one that does. If neither
/// agrees, the first counts.
[[nodiscard]] bool is_worse(const Verification& than, const Verification& verification);

/// The worse of the verifications of two results, with the counts of both.
[[nodiscard]] Verification merged(Verification a, Verification b);

}  // namespace dualdamp::scenarios
