#pragma once
/// The exact engine: walks from event to event for laws that are affine in every mode.
///
/// Between events the motion is closed-form (`sim/linear_mode.hpp`); the next event is found by the certified
/// search
/// (`core/first_crossing.hpp`). The driver knows no law by name. At v = 0 it decides by the sum of forces:
///   rest      while |pull| <= sum of static limits, equality included when the excess is not growing;
///   slip      otherwise, in the direction of the pull.
/// A jump that lands in a mode with a violated guard is repeated, at most `max_repeats` times for each law.
///
/// Under a harmonic excitation time is kept modulo one forcing period, so that long runs lose no phase.
///
/// Cost: for Coulomb friction about one exp, two sincos and a few dozen multiplications an event; no allocation
/// after the first period.

#include <Eigen/Core>
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "core/first_crossing.hpp"
#include "core/outcome.hpp"
#include "sim/drive.hpp"
#include "sim/interval.hpp"
#include "sim/linear_mode.hpp"
#include "sim/model.hpp"
#include "sim/sensitivity.hpp"
#include "sim/state.hpp"

namespace dualdamp::sim {

class ExactEngine {
 public:
  static constexpr int max_repeats = 32;

  /// Every law of the model must be affine.
  explicit ExactEngine(const Model& model);
  ~ExactEngine();
  ExactEngine(const ExactEngine&) = delete;
  ExactEngine& operator=(const ExactEngine&) = delete;

  /// Places the mass at t = 0 with all laws at their start.
  void start(double x, double v);
  /// Same, keeping what the laws remember.
  void restart(double x, double v);
  /// Same, in a state met earlier: closes a period.
  void restart(const State& state);

  /// The next interval, ending at an event or at `horizon` [s], whichever is first, and not longer than one forcing
  /// period. Valid until the next call. A null pointer: the horizon is reached, or outcome() is not ok().
  [[nodiscard]] const Interval* next(double horizon);
  /// The same up to the end of the present forcing period, where time and phase are set exactly: the period map.
  /// A null pointer only when outcome() is not ok(): watch cycle().
  [[nodiscard]] const Interval* next_in_period();

  [[nodiscard]] const core::Outcome& outcome() const { return outcome_; }
  [[nodiscard]] double time() const;                    ///< s
  [[nodiscard]] long cycle() const { return cycle_; }   ///< whole forcing periods passed
  [[nodiscard]] double position() const { return x_; }  ///< m
  [[nodiscard]] double velocity() const { return v_; }  ///< m/s
  [[nodiscard]] friction::Direction direction() const { return direction_; }
  [[nodiscard]] State state() const { return {x_, v_, direction_, memories_}; }
  [[nodiscard]] const core::SearchCount& count() const { return count_; }
  /// Tangencies within the last interval.
  [[nodiscard]] const std::vector<core::Grazing>& grazings() const { return grazings_; }

  /// Forcing period [s]; infinite without a harmonic excitation.
  [[nodiscard]] double period() const { return drive_.period(); }

  /// Tracks the derivative of the present state by the state at start, restart or the last reset.
  void track_sensitivity(bool track);
  void reset_sensitivity() { sensitivity_.begin(memories_, some_modal_); }
  /// Rows and columns: x, v, then the states of every law.
  [[nodiscard]] Eigen::MatrixXd sensitivity() const { return sensitivity_.matrix(); }

 private:
  /// By what one mode differs from another.
  struct ModeKey {
    double damping = 0.0;
    double stiffness = 0.0;
    bool ramped = false;
    std::vector<double> decays;

    friend auto operator<=>(const ModeKey&, const ModeKey&) = default;
  };
  /// Relative rounding of a sum of parts.
  static constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  /// Values farther than this (relative) from a limit are decided by their sign; closer ones by their Taylor germ.
  static constexpr double clearly = 1e-9;

  /// What a guard of the present phase belongs to.
  struct Owner {
    enum class Kind { velocity, limit, law } kind = Kind::velocity;
    int law = 0;               ///< index of the law; for a limit the direction of release, +1 or -1
    int guard = 0;             ///< index among the law's own guards
    double by_position = 0.0;  ///< dg/dx
    double by_velocity = 0.0;  ///< dg/dv
    double tolerance = 0.0;    ///< rounding of g at the start beyond that of its amplitudes
  };
  /// All laws together, affine in the phase.
  struct Total {
    friction::Affine force;  ///< without its transient
    friction::Affine limit;  ///< of static friction, at rest only
    bool lasting = false;    ///< need not be asked for again
    bool ramped = false;     ///< something grows with time: modes without that element are cheaper
    std::vector<double> transients;
    std::vector<double> decays;
  };
  class PhaseInterval;

  [[nodiscard]] friction::Instant now() const { return {time(), x_, v_}; }
  /// Speed and its rate in a slip, as the first guard has them: velocity and acceleration times the direction.
  [[nodiscard]] const core::ModeFunction& speed() const { return guards_.front().value; }
  [[nodiscard]] const core::ModeFunction& speed_rate() const { return guards_.front().slope; }
  [[nodiscard]] double start_acceleration() const;
  void place(double x, double v);
  void collect(bool with_guards);
  void add_force(const friction::Affine& part);
  void add_limit(const friction::Affine& part);
  void add_transient(double size, double decay);
  const LinearMode& mode_for(double damping, double stiffness);
  void load_forcing(double extra_constant);
  const LinearMode& pull_on_mode(core::ModeFunction& pull);
  void limit_guard(const core::ModeFunction& pull, double direction, core::ModeFunction& guard) const;
  void lay_phase();
  void lay_rest();
  void lay_slip();
  void add_law_guards();
  core::Guard& new_guard(const Owner& owner);
  [[nodiscard]] core::Germ slip_germ(const core::Guard& guard, double tolerance) const;
  bool find_violated();
  void drop_guard(std::size_t i);
  void settle();
  friction::Direction settle_closely(double tolerance);
  [[nodiscard]] double pull_now() const;
  void change_direction(friction::Direction direction);
  void jump(std::size_t law, friction::Trigger trigger);
  EventKind act(const Owner& owner);
  void act_on_schedule(double due);
  [[nodiscard]] double next_schedule() const;
  void track_begin(const friction::Instant& begin, bool at_once);
  void track_motion(const friction::Instant& begin, double s);
  void track_states(const friction::Instant& begin, double s, bool event);
  void describe_phase(double begin);
  void begin_motion();
  [[nodiscard]] const Interval* step(double left, bool to_period_end);
  void keep_rounding(double s);
  void advance(double s, bool to_period_end);
  [[nodiscard]] double force_scale() const;
  [[nodiscard]] double force_rounding() const;
  [[nodiscard]] double velocity_rounding() const;

  Model model_;
  Drive drive_;
  std::vector<char> holds_mass_;  ///< of each law
  std::vector<char> modal_;       ///< of each law
  bool some_modal_ = false;
  bool scheduled_ = false;  ///< some law changes its mode at a known time
  bool can_rest_ = false;   ///< some law has a static limit
  double x_ = 0.0;
  double v_ = 0.0;
  double local_time_ = 0.0;  ///< within the forcing period
  long cycle_ = 0;
  friction::Direction direction_ = friction::Direction::rest;
  std::vector<friction::Memory> memories_;

  int repeats_ = 0;          ///< events in a row that took no time
  double x_rounding_ = 0.0;  ///< of x_ and v_ from the phase before
  double v_rounding_ = 0.0;
  std::map<ModeKey, LinearMode> modes_;
  ModeKey key_;
  const LinearMode* mode_ = nullptr;  ///< of the present phase
  ModeForcing forcing_;
  std::array<Total, 3> totals_;    ///< by direction
  Total* total_ = totals_.data();  ///< of the present phase
  double force_scale_ = 0.0;
  double instant_scale_ = 0.0;  ///< the largest of the phases that met at this instant, the one before it included
  core::ModeFunction motion_;
  std::vector<core::Guard> guards_;
  std::vector<Owner> owners_;
  std::size_t guard_count_ = 0;
  std::vector<friction::Affine> law_guards_;   ///< of all laws
  std::vector<std::size_t> law_guard_counts_;  ///< of each law
  core::Crossing crossing_;
  std::vector<core::Grazing> grazings_;
  core::SearchCount count_;
  core::Outcome outcome_;

  bool tracking_ = false;
  Sensitivity sensitivity_;
  std::vector<friction::Memory> memories_before_;  ///< at the begin of the phase, while tracking
  std::vector<Eigen::Vector2d> responses_;
  std::unique_ptr<PhaseInterval> interval_;
};

}  // namespace dualdamp::sim
