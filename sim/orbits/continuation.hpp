#pragma once
/// Continuation: a branch of steady states over amplitude or frequency, by pseudo-arc-length (keller1977).
///
/// Unknowns are the start of the orbit and the parameter; each step predicts along the branch's tangent and
/// corrects by Newton's method on the period map, so that folds are passed and unstable orbits found. The engine
/// finds the sequence of sticks and slips at each point anew. Where it changes the monodromy matrix jumps; the
/// place is then located by bisection and is a result of its own.
///
/// A branch of a non-smooth system may end: at a place where one of the orbit's own intervals disappears and no
/// orbit continues the branch (static friction above kinetic). That too is a change, `end`.

#include <string>
#include <string_view>
#include <vector>

#include "core/crossing/search_result.hpp"
#include "core/outcome.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::sim {

/// What is varied.
enum class BranchParameter { amplitude, frequency };

enum class ChangeKind {
  sequence,        ///< other events in one period
  sticking,        ///< the first stick appears, or the last one goes
  stops,           ///< more or fewer stops in a period
  fold,            ///< the branch turns back; a Floquet multiplier passes 1 there, which is no change of its own
  flip,            ///< a Floquet multiplier passes -1: a motion of twice the period begins
  neimark_sacker,  ///< a complex pair leaves or enters the unit circle: a motion with a second frequency begins
  stability,  ///< orbits begin or cease to attract otherwise: a Floquet multiplier passes 1 where nothing turns, or
              ///< jumps
  end,        ///< no orbit continues the branch
};

/// "sequence", "sticking", "stops", "fold", "flip", "neimark_sacker", "stability", "end".
[[nodiscard]] std::string_view name(ChangeKind kind);

struct BranchPoint {
  double parameter = 0.0;  ///< amplitude [m or N] or frequency [rad/s]
  SteadyState state;       ///< without the full account
};

struct BranchChange {
  ChangeKind kind = ChangeKind::sequence;
  double parameter = 0.0;
  double amplitude = 0.0;  ///< of x there [m]
  int stops_before = 0;    ///< per forcing period
  int stops_after = 0;
  bool stable_before = false;
  bool stable_after = false;
};

/// Why a branch has no more points.
enum class BranchEnd {
  range,   ///< it left the range of the parameter: complete
  orbit,   ///< no orbit continues it
  points,  ///< it has as many points as it may have
  edge,    ///< it left the range, but its orbit just on the end of the range was not found
};

/// "range", "orbit", "points", "edge".
[[nodiscard]] std::string_view name(BranchEnd end);

struct Branch {
  core::Outcome outcome;  ///< not ok(): there is no orbit at the first value
  BranchEnd end = BranchEnd::range;
  std::vector<std::string> warnings;  ///< what is missing
  std::vector<BranchPoint> points;    ///< in order along the branch
  std::vector<BranchChange> changes;  ///< likewise
  core::SearchCount certificate;      ///< of all searches for events on the way along the branch
};

struct BranchOptions {
  double largest_step =
      0.02;  ///< along the branch, relative to the range of the parameter and the size of the motion
  double smallest_step = 1e-6;
  double tolerance = 1e-13;  ///< closure of each orbit
  double location = 1e-9;    ///< of changes, relative to the larger end of the range
  int max_points = 5000;
};

/// From the steady state at `from`, the one approached from the model's initial state, until the parameter leaves
/// the range between `from` and `to` (both > 0), the branch ends or max_points are reached.
[[nodiscard]] Branch continue_branch(const Model& model, BranchParameter parameter, double from, double to,
                                     const BranchOptions& options = {});

}  // namespace dualdamp::sim
