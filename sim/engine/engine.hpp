#pragma once
/// An engine walks the motion from event to event and hands it out as a stream of intervals. There are two: the
/// exact one (`exact_engine.hpp`) for laws that are affine in every mode, and the smooth one (`smooth_engine.hpp`)
/// for all others. What they do alike is here: time, the laws' memories, mode changes, what an event means.
///
/// Where a slip ends (v reaches 0) the sum of forces decides (`sim/engine/sticking_gate.hpp`): the mass sticks, or
/// it reverses. Where a stick ends (the pull exceeds the static limits) the mass slips in the direction of the
/// pull. A jump that lands in a mode with a violated guard is repeated, at most `max_repeats` times for each law.
///
/// Time is kept modulo the forcing period, or from the start of the present piece of a drive, so that long runs
/// lose no phase.

#include <Eigen/Core>
#include <memory>
#include <variant>
#include <vector>

#include "core/crossing/search_result.hpp"
#include "core/outcome.hpp"
#include "sim/engine/drive.hpp"
#include "sim/engine/interval.hpp"
#include "sim/engine/state.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

class Engine {
 public:
  static constexpr int max_repeats = 32;

  explicit Engine(const Model& model);
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  virtual ~Engine();

  /// Places the mass at t = 0 with all laws at their start.
  void start(double x, double v);
  /// The same in a state met earlier: closes a period.
  void restart(const State& state);

  /// The next interval, ending at an event or at `horizon` [s], whichever is first, and not longer than one forcing
  /// period or than the present piece of the drive. Valid until the next call. A null pointer: the horizon is
  /// reached, or outcome() is not ok().
  [[nodiscard]] const Interval* next(double horizon);
  /// The same up to the end of the present forcing period, where time and phase are set exactly: the period map.
  /// A null pointer only when outcome() is not ok(): watch periods_passed().
  [[nodiscard]] const Interval* next_in_period();

  [[nodiscard]] const core::Outcome& outcome() const { return outcome_; }
  [[nodiscard]] double time() const { return period_begin_ + local_time_; }  ///< s
  /// Whole forcing periods passed, or pieces of the drive.
  [[nodiscard]] long periods_passed() const { return periods_passed_; }
  [[nodiscard]] double position() const { return x_; }  ///< m
  [[nodiscard]] double velocity() const { return v_; }  ///< m/s
  [[nodiscard]] friction::Direction direction() const { return direction_; }
  [[nodiscard]] virtual State state() const;
  [[nodiscard]] const core::SearchCount& count() const { return count_; }
  /// What all motions have cost so far, in units of 0.3 to 2 us: the same on every machine. Searches for events,
  /// their panels and splits; of the smooth engine also what its steps take, accepted or not.
  [[nodiscard]] virtual long work() const { return count_.searches + count_.panels + count_.splits; }
  /// Tangencies within the last interval.
  [[nodiscard]] const std::vector<core::Grazing>& grazings() const { return grazings_; }
  /// Forcing period [s], or the present piece of the drive; else infinite.
  [[nodiscard]] double period() const { return drive_.period(); }

  /// How well a motion over one period is known, relative to its size; 0: to rounding.
  [[nodiscard]] virtual double accuracy() const = 0;
  /// The motion depends on its past beyond state(): Newton's method on the period map does not apply.
  [[nodiscard]] virtual bool has_past() const = 0;

  /// Tracks the derivative of the present state by the state at start, restart or the last reset.
  void track_sensitivity(bool track);
  virtual void reset_sensitivity() = 0;
  /// Rows and columns: x, v, then the states of every law.
  [[nodiscard]] virtual Eigen::MatrixXd sensitivity() const = 0;

 protected:
  /// Where a slip ends: the velocity reaches zero.
  struct SlipEnd {};
  /// Where a stick ends: the pull exceeds the static limits in this direction.
  struct StickEnd {
    friction::Direction release = friction::Direction::forward;
  };
  /// Where a law changes its mode: one of its own guards reaches zero.
  struct LawGuard {
    std::size_t law = 0;
    int guard = 0;  ///< index among the law's own guards
  };
  /// What ends the interval when a guard reaches zero.
  using Ending = std::variant<SlipEnd, StickEnd, LawGuard>;
  template <class E>
  [[nodiscard]] static bool is(const Ending& ending) {
    return std::holds_alternative<E>(ending);
  }

  /// One interval, at most `left` long; `to_period_end`: `left` ends exactly at a period boundary.
  [[nodiscard]] virtual const Interval* step(double left, bool to_period_end) = 0;
  /// Decides what happens where a slip ends: sets the direction to none (stick) or to that of the slip to come.
  virtual void settle() = 0;
  /// The motion goes on from x_, v_, direction_ and memories_ at local time 0, with nothing known of before.
  virtual void begin_motion() = 0;
  virtual void restore_past(const State&) {}
  /// A law has changed its mode.
  virtual void jumped(std::size_t, const friction::Memory& /*before*/, friction::Trigger) {}

  [[nodiscard]] friction::Instant now() const {
    const double w = model_.excitation.is_harmonic() ? model_.excitation.frequency : 0.0;
    return {.t = time(), .x = x_, .v = v_, .angle = w * local_time_, .angle_rate = w};
  }
  void pass_period();
  void change_direction(friction::Direction direction);
  void jump(std::size_t law, friction::Trigger trigger);
  EventKind act(const Ending& ending);
  EventKind act(SlipEnd);
  EventKind act(StickEnd end);
  EventKind act(LawGuard guard);
  void act_on_schedule(double due);
  [[nodiscard]] double next_schedule() const;
  /// Counts events in a row that take no time; false, with an outcome, when they do not come to an end.
  [[nodiscard]] bool comes_to_an_end(bool takes_no_time);

  Model model_;
  Drive drive_;
  std::vector<char> holds_mass_;  ///< of each law
  std::vector<char> modal_;       ///< of each law
  bool some_modal_ = false;
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
  void place();
  [[nodiscard]] bool turns_freely() const;

  int repeats_ = 0;
};

/// The engine for this model: exact where every law is affine in every mode and the spring linear, else smooth.
[[nodiscard]] std::unique_ptr<Engine> make_engine(const Model& model);
/// Whether that is the exact one.
[[nodiscard]] bool is_exact(const Model& model);

}  // namespace dualdamp::sim
