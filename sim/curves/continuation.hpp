#pragma once
/// Continuation: a branch of steady states over amplitude or frequency, by pseudo-arc-length (keller1977).
///
/// The unknowns are the start of the orbit and the parameter. Each step predicts along the branch's tangent and
/// corrects by Newton's method on the period map, so folds are passed and unstable orbits are found. The engine
/// finds the sequence of sticks and slips again at each point. Where the sequence changes, the monodromy matrix
/// jumps; the place is located by bisection and is a result of its own.
///
/// A branch of a non-smooth system may end where an interval of the orbit disappears and no orbit continues the
/// branch (static friction above kinetic). This is a change too, `end`.

#include <string>
#include <string_view>
#include <vector>

#include "core/crossing/search_result.hpp"
#include "core/outcome.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::sim {

/// The parameter that is varied.
enum class BranchParameter { amplitude, frequency };

enum class ChangeKind {
  sequence,        ///< the events of one period change
  sticking,        ///< the first stick appears, or the last one goes
  stops,           ///< more or fewer stops in a period
  fold,            ///< the branch turns back; a Floquet multiplier passes 1 there, which is not listed again
  flip,            ///< a Floquet multiplier passes -1: a motion of twice the period begins
  neimark_sacker,  ///< a complex pair leaves or enters the unit circle: a motion with a second frequency begins
  stability,  ///< orbits begin or cease to attract otherwise: a Floquet multiplier passes 1 and the branch does
              ///< not turn, or it jumps
  jump,       ///< no orbit continues the branch, and the motion jumps to another that attracts, as in a sweep
  rest,       ///< the mass ceases to move: beyond, any rest position that friction can hold is an orbit
  end,        ///< no orbit continues the branch
};

/// "sequence", "sticking", "stops", "fold", "flip", "neimark_sacker", "stability", "jump",
/// "rest", "end".
[[nodiscard]] std::string_view name_of(ChangeKind kind);

struct BranchPoint {
  double parameter = 0.0;  ///< amplitude [m or N] or frequency [rad/s]
  SteadyState state;       ///< without the full account
};

struct BranchChange {
  ChangeKind kind = ChangeKind::sequence;
  double parameter = 0.0;
  double amplitude = 0.0;  ///< of x at the change [m]
  int stops_before = 0;    ///< in one period of the motion
  int stops_after = 0;
  bool stable_before = false;
  bool stable_after = false;
};

/// Why a branch has no more points.
enum class BranchEnd {
  range,   ///< it left the range of the parameter: complete
  orbit,   ///< no orbit continues it: an interval of the orbit disappears, or it would go back over its own orbits
  points,  ///< it has max_points points
  edge,    ///< it left the range, but no orbit was found exactly at the end of the range
  step,    ///< orbits nearly close beyond the last point, or neighbouring motions part too fast to tell, but no
           ///< step along the branch converged
  growth,  ///< its amplitude grows without bound: an undamped resonance
  work,    ///< the search for its orbits took too long
  rest,    ///< the mass never moves at the first value, or it ceases to move: any rest position that friction can
           ///< hold is an orbit
};

/// "range", "orbit", "points", "edge", "step", "growth", "work", "rest".
[[nodiscard]] std::string_view name_of(BranchEnd end);

struct Branch {
  core::Outcome outcome;  ///< not ok(): there is no orbit at the first value
  BranchEnd end = BranchEnd::range;
  std::vector<std::string> warnings;  ///< e.g. the branch is not complete
  std::vector<BranchPoint> points;    ///< in order along the branch
  std::vector<BranchChange> changes;  ///< likewise
  core::SearchCount certificate;      ///< of all searches for events, those of rejected steps too
};

struct BranchOptions {
  double largest_step = 0.02;  ///< relative to the range of the parameter and the size of the motion
  // The smooth engine raises the next three to what its accuracy allows.
  double smallest_step = 1e-6;
  double tolerance = 1e-13;  ///< closure of each orbit
  double location = 1e-9;    ///< of changes, relative to the larger end of the range
  int max_points = 5000;
  long most_work = 12'000'000;  ///< `Engine::work` of all attempts together; some twenty seconds
};

/// The branch from the steady state at `from` that the motion from the model's initial state approaches. It is
/// continued until the parameter leaves the range between `from` and `to` (both > 0), the branch ends, or it has
/// max_points points.
[[nodiscard]] Branch continue_branch(const Model& model, BranchParameter parameter, double from, double to,
                                     const BranchOptions& options = {});

}  // namespace dualdamp::sim
