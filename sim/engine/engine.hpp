#pragma once
/// An engine computes the motion from event to event and gives it as a stream of intervals. There are two: the
/// exact one (`exact_engine.hpp`) for laws that are affine in every mode, and the smooth one (`smooth_engine.hpp`)
/// for all others. This class has what both share: time, the laws' memories, mode changes, the meaning of events.
///
/// Where a slip ends (v reaches 0) the sum of forces decides (`sim/engine/sticking_gate.hpp`): the mass sticks, or
/// it reverses. Where a stick ends (the pull exceeds the static limits) the mass slips in the direction of the
/// pull. If a jump ends in a mode with a violated guard, the law jumps again, at most `friction::max_repeats` times
/// for each law.
///
/// Time is kept modulo the forcing period, or from the start of the present piece of a drive, so the phase stays
/// exact in long runs.

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/crossing/search_result.hpp"
#include "core/outcome.hpp"
#include "sim/engine/drive.hpp"
#include "sim/engine/ending.hpp"
#include "sim/engine/interval.hpp"
#include "sim/engine/state.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

class Engine {
 public:
  explicit Engine(const Model& model);
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine();

  /// Places the mass at t = 0 with all laws at their start; in the initial state of the model, with the memories
  /// stated there.
  void start(double x, double v);
  /// Places the mass in a state that the motion had before, at t = 0.
  void restart(const State& state);

  /// The next interval. It ends at an event or at `horizon` [s], whichever is first, and is at most as long as one
  /// forcing period or the present piece of the drive. Valid until the next call. A null pointer: the horizon is
  /// reached, or outcome() is not ok().
  [[nodiscard]] const Interval* next(double horizon);
  /// The next interval, up to the end of the present forcing period at most. There time and phase are set exactly,
  /// as the period map needs it. A null pointer only if outcome() is not ok(): compare periods_passed().
  [[nodiscard]] const Interval* next_in_period();

  [[nodiscard]] const core::Outcome& outcome() const { return outcome_; }
  [[nodiscard]] double time() const { return period_begin_ + local_time_; }  ///< s
  /// Number of whole forcing periods, or of pieces of the drive, that have passed.
  [[nodiscard]] long periods_passed() const { return periods_passed_; }
  [[nodiscard]] double position() const { return x_; }  ///< m
  [[nodiscard]] double velocity() const { return v_; }  ///< m/s
  [[nodiscard]] friction::Direction direction() const { return direction_; }
  [[nodiscard]] virtual State state() const;
  [[nodiscard]] const core::SearchCount& count() const { return count_; }
  /// Work of all motions so far, in units of 0.3 to 2 us; the number is the same on every machine. It counts
  /// searches for events, their panels and splits, under the exact engine in proportion to the terms of their
  /// guards where these are many; under the smooth engine also steps, accepted or not.
  [[nodiscard]] virtual long work() const { return count_.work(); }
  /// Words for a vibration that swings very often in a forcing period, hardly damped, so that following it costs
  /// most of the work; empty: there is none.
  [[nodiscard]] virtual std::string fast_vibration() const { return {}; }
  /// Grazings within the last interval.
  [[nodiscard]] const std::vector<core::Grazing>& grazings() const { return grazings_; }
  /// Forcing period, or duration of the present piece of the drive [s]; else infinite.
  [[nodiscard]] double period() const { return drive_.period(); }

  /// Error of a motion over one period, relative to its size; 0: rounding.
  [[nodiscard]] virtual double accuracy() const = 0;
  /// The motion depends on its past beyond state(): Newton's method on the period map does not apply.
  [[nodiscard]] virtual bool has_past() const = 0;

  /// Whether to compute the derivative of the present state by the state at start(), restart() or the last
  /// reset_sensitivity().
  void track_sensitivity(bool track);
  virtual void reset_sensitivity() = 0;
  /// That derivative. Rows and columns: x, v, then the states of every law.
  [[nodiscard]] virtual Eigen::MatrixXd sensitivity() const = 0;

 protected:
  /// One interval, at most `left` [s] long; `to_period_end`: `left` ends exactly at a period boundary.
  [[nodiscard]] virtual const Interval* step(double left, bool to_period_end) = 0;
  /// What the forces do to the mass while it stands and all laws are at direction none.
  struct Balance {
    friction::Direction direction = friction::Direction::none;  ///< in which they move it; none: it sticks
    double limit = 0.0;                                         ///< sum of the static limits [N]
  };
  [[nodiscard]] virtual Balance balance() = 0;
  /// A motion starts from x_, v_, direction_ and memories_ at local time 0; what the engine kept before is dropped.
  virtual void begin_motion() = 0;
  virtual void restore_past(const State&) {}
  /// Called after a law has changed its mode, while the derivative is tracked.
  virtual void jumped(std::size_t, const friction::Memory& /*before*/, friction::Trigger) {}

  [[nodiscard]] friction::Instant now() const {
    const double w = model_.excitation.is_harmonic() ? model_.excitation.frequency : 0.0;
    return {.t = time(), .x = x_, .v = v_, .angle = w * local_time_, .angle_rate = w};
  }
  void pass_period();
  void change_direction(friction::Direction direction);
  void jump(std::size_t law, friction::Trigger trigger);
  /// `without_motion`: the interval began at v = 0 and takes no time.
  EventKind act(const Ending& ending, bool without_motion);
  EventKind act_on_schedule(double due);
  [[nodiscard]] double next_schedule() const;
  /// Counts events in a row that take no time. False, and an outcome is set, if they do not come to an end.
  [[nodiscard]] bool comes_to_an_end(bool takes_no_time);
  /// Whether the motion is so large that values within an interval may leave the range of double precision; sets an
  /// outcome then.
  [[nodiscard]] bool leaves_range();
  void leave_range();

  Model model_;
  Drive drive_;
  std::vector<char> holds_mass_;  ///< of each law
  std::vector<char> has_memory_;  ///< of each law
  bool some_memory_ = false;
  bool scheduled_ = false;  ///< some law changes its mode at a known time
  bool can_stick_ = false;  ///< some law has a static limit
  double x_ = 0.0;
  double v_ = 0.0;
  double local_time_ = 0.0;    ///< within the forcing period or the piece
  double period_begin_ = 0.0;  ///< s
  long periods_passed_ = 0;
  friction::Direction direction_ = friction::Direction::none;
  std::vector<friction::Memory> memories_;
  bool tracking_ = false;
  std::vector<core::Grazing> grazings_;
  core::SearchCount count_;
  core::Outcome outcome_;

 private:
  void place(friction::Direction before);
  [[nodiscard]] bool may_go_on();
  void settle(bool without_motion = false);
  EventKind end_slip(bool without_motion);
  EventKind act(StickEnd end);
  EventKind act(LawGuard guard);
  EventKind after_change();
  [[nodiscard]] bool turns_freely() const;

  bool is_woken_ = false;  ///< a mass at rest that no law holds is released now
  int repeats_ = 0;
  std::size_t changed_last_ = std::numeric_limits<std::size_t>::max();  ///< the law that changed its mode last
};

/// The engine for this model: exact if every law is affine in every mode and the spring is linear, unless the model
/// asks for a solver; else smooth.
[[nodiscard]] std::unique_ptr<Engine> make_engine(const Model& model);
/// Whether make_engine() gives the exact engine.
[[nodiscard]] bool is_exact(const Model& model);

}  // namespace dualdamp::sim
