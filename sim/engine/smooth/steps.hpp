#pragma once
/// The steps of the smooth engine within an interval: their method, their lengths, and whether they are too many.
///
/// Method. DOP853 at first. Radau IIA for the rest of all motions once stability limits the steps and not accuracy,
///   friction holds the mass as a steep dashpot from the start of an interval on, or steps become far too short
///   (`stepper.hpp`); the engine asks for it where a step passes over a creep.
/// Length. Of the local error in each component, |error| <= tolerance (|X| + size). At most an eighth of the
///   shortest period, so that five points show every minimum of a guard; as long as the shortest delay of a law;
///   up to the next kink of a delayed velocity, and hardly beyond the turn that the loss of speed leads to expect.
/// Number. At most 300,000 in a shortest period, and 3,000 at one instant; rejected ones count.
///
/// They know the flow only, with its branch frozen: no guards and no events.

#include <memory>
#include <span>
#include <vector>

#include "friction_models/law.hpp"
#include "sim/engine/drive.hpp"
#include "sim/engine/flow.hpp"
#include "sim/engine/smooth/smooth_step.hpp"
#include "sim/model.hpp"
#include "sim/steppers/stepper.hpp"

namespace dualdamp::sim {

class Steps {
 public:
  enum class Result { taken, too_many, too_short };
  /// Beyond that the motion changes too fast to be integrated in reasonable time. A creep is found within a few
  /// hundred steps at one instant, to rounding.
  static constexpr long most_in_period = 300'000;
  static constexpr long most_at_instant = 3'000;
  /// A step is tried again at most this often.
  static constexpr int most_tries = 200;

  /// Model and flow must outlive it; `flow`: that of the present interval.
  Steps(const Model& model, const Drive& drive, const Flow& flow);

  void begin_motion();
  /// The mass and the memories at the start of an interval, for which the flow is frozen.
  void begin_interval(double x, double v, const std::vector<friction::Memory>& memories);
  /// A step of length 0 at the local time t [s].
  void stay(double t);
  /// One accepted step from the local time t on, at most `left` long [s]. `now`: the absolute time [s].
  [[nodiscard]] Result advance(double t, double now, double left);
  /// The step taken last once more, of another length. False: it is not accurate.
  [[nodiscard]] bool repeat(double length);
  /// The end of the step becomes the start of the next one. `at_slip_end`: there the velocity is zero, and delayed
  /// velocities have a kink later.
  void go_on(bool at_slip_end);
  /// Time is counted anew from `period` later, where t is the present.
  void shift(double period, double t);

  /// The step taken last: its ends, its length [s], its dense output.
  [[nodiscard]] SmoothStep last() const;
  [[nodiscard]] std::span<const double> begin() const { return begin_; }
  [[nodiscard]] std::span<const double> end() const { return end_; }
  [[nodiscard]] double length() const { return length_; }
  void at(double part, std::span<double> X) const { stepper_->at(part, X); }
  /// The error allowed in the velocity [m/s].
  [[nodiscard]] double allowed_in_velocity() const { return allowed_[1]; }

  /// Proposes the length of the next step [s]. 0: an interval begins, nothing is known of it.
  void propose(double length) { proposed_ = length; }
  /// Whether the step hides a turn at its start, or at its end if `at_stop`, from its own error estimate, so that
  /// it has to be taken again: a shorter one is proposed.
  [[nodiscard]] bool passes_over_turn(bool at_stop);
  [[nodiscard]] bool are_implicit() const { return is_implicit_; }
  /// Changes to implicit steps. False: they are already, or others are asked for by name.
  [[nodiscard]] bool make_implicit();

  /// Of the oscillator and its drive [s].
  [[nodiscard]] double shortest_period() const { return shortest_period_; }
  /// The longest step at the local time t [s].
  [[nodiscard]] double longest(double t) const;
  /// Whether steps at one instant are those that were too many.
  [[nodiscard]] bool stand_still() const { return standing_ > most_at_instant; }
  /// Operations of linear algebra so far.
  [[nodiscard]] long operations() const { return stepper_->operations(); }

 private:
  [[nodiscard]] bool are_too_many(double now);
  [[nodiscard]] bool begins_stiff();
  [[nodiscard]] double first();
  [[nodiscard]] double time_to_turn() const;
  [[nodiscard]] double excess_error() const;
  [[nodiscard]] bool hides_turn(bool at_end);
  void limit();

  const Model& model_;
  const Flow& flow_;
  std::unique_ptr<Stepper> stepper_;
  bool is_implicit_ = false;
  StiffSteps stiff_steps_;
  std::vector<double> frequencies_;  ///< of the drive [rad/s]
  double shortest_period_ = 0.0;
  double longest_ = 0.0;           ///< step, apart from kinks [s]
  std::vector<double> kinks_;      ///< of a delayed velocity: local times [s]
  double proposed_ = 0.0;          ///< length of the next step [s]; 0: none
  double proposed_at_turn_ = 0.0;  ///< proposed_ of a step that ended on a reversal just now [s]; 0: none
  /// Of the time to the turn: what a step may take at the errors of the last one; 0: no step was refused on the
  /// way. Under friction that depends on the ratio of two speeds the steps of equal error shorten in proportion to
  /// the speed, and of steps that are to be as long as the last one every second is refused.
  double part_of_way_ = 0.0;
  double loss_of_speed_ = 0.0;  ///< mean over the last step [m/s^2]; 0: none in this interval
  double earlier_loss_ = 0.0;   ///< over the step before
  double t_ = 0.0;              ///< local time at the start of the step [s]
  double length_ = 0.0;         ///< s
  std::vector<double> begin_;
  std::vector<double> end_;
  std::vector<double> error_;
  std::vector<double> allowed_;
  double counted_to_ = 0.0;  ///< time up to which count_ counts [s]
  long count_ = 0;
  double stood_at_ = 0.0;  ///< time of the last step [s]
  long standing_ = 0;      ///< steps since then that took no time, to rounding
  // Scratch.
  std::vector<double> state_;
  std::vector<double> rates_;
};

}  // namespace dualdamp::sim
