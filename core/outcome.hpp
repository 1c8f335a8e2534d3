#pragma once
/// Outcome: how a computation ended, as a value with a reason.
///
/// A computation that cannot give a number returns the reason here. It never throws for a numerical reason, and it
/// never returns a plausible number in place of an answer.

#include <string>

namespace dualdamp::core {

enum class OutcomeKind {
  done,
  no_steady_state,   ///< the motion grows, or has not settled within the stated number of periods
  not_unique,        ///< a continuum of steady states and none is singled out by the initial state
  event_limit,       ///< more events than the stated limit
  jump_cycle,        ///< a law's jumps did not end
  not_finite,        ///< a value left the range of double precision
  not_identifiable,  ///< the record does not allow an estimate
};

struct [[nodiscard]] Outcome {
  OutcomeKind kind = OutcomeKind::done;
  std::string reason;  ///< a sentence for the user; empty when done

  [[nodiscard]] bool ok() const { return kind == OutcomeKind::done; }
};

}  // namespace dualdamp::core
