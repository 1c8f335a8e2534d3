#pragma once
/// The derivative of a motion of the smooth engine by its start. A perturbation is kept in two parts,
///
///   d(x, v, states)(now) = columns + f(now) lead,
///
/// a change of the state and a time by which the perturbed motion is ahead. Both are exact together for every
/// choice of `lead`; the choice says what an error of the variational equation does. Where v passes zero a force
/// may turn over within less than rounding (rate_state, a steep dashpot): what a velocity is there says nothing,
/// but the time at which it is zero does. So near v = 0 the columns have no velocity, and an event leaves its delay
/// in `lead` instead of what it would be under the acceleration at that very instant (leine2004).
///
/// Over a step the columns follow the variational equation along its dense output (`variation.hpp`); at an event
/// they are carried to its crossing, through the mode changes and on along the motion behind it: the saltation
/// matrix. It is the derivative of the motion, whatever the law and the stepper; over a period it agrees with the
/// exact engine's to 1e-7.

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "friction_models/law.hpp"
#include "sim/engine/drive.hpp"
#include "sim/engine/flow.hpp"
#include "sim/engine/smooth/guards.hpp"
#include "sim/engine/smooth/smooth_step.hpp"
#include "sim/engine/velocity_history.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

class Variation;

class MotionDerivative {
 public:
  /// The motion at an instant.
  struct Present {
    friction::Instant now;
    double local_time = 0.0;  ///< s
    friction::Direction direction = friction::Direction::none;
    const std::vector<friction::Memory>& memories;
  };

  /// Model, drive and past must outlive it. `shortest_period`: of the oscillator and its drive [s].
  MotionDerivative(const Model& model, const Drive& drive, const VelocityHistory& past, double shortest_period);
  ~MotionDerivative();
  MotionDerivative(const MotionDerivative&) = delete;
  MotionDerivative& operator=(const MotionDerivative&) = delete;

  /// Sets it to identity for a motion that begins with these memories.
  void reset(const std::vector<friction::Memory>& memories, friction::Direction direction);
  /// Rows: x, v, states of the laws at `present`; columns: the same at the start.
  [[nodiscard]] Eigen::MatrixXd matrix(const Present& present) const;
  /// Work so far, in the units of Engine::work().
  [[nodiscard]] long work() const { return work_; }

  // Of each interval, in this order.

  void begin_interval() { changes_.clear(); }
  /// Over a step.
  void pass(const SmoothStep& step);
  /// To the crossing of a guard at the end of the step, on the motion before it.
  void enter(const Guards& guards, std::size_t guard, const SmoothStep& step);
  /// Whether an event that follows one of a law at the same instant has an instant of its own, which a perturbation
  /// delays by itself: its guard is one of another law, or was one of this law before its event.
  [[nodiscard]] bool has_own_instant(const Guards& guards, std::size_t guard, const SmoothStep& step) const;
  /// The step ends at a time that does not depend on the motion: there every perturbation is a change of the state.
  void drop_lead(const SmoothStep& step);
  /// The speed at the end of the step, an error of a creep, is replaced by zero.
  void drop_speed(const SmoothStep& step);
  /// An event follows: it may change the rates, so those of the step no longer hold.
  void forget_course() { course_.length = 0.0; }
  /// A law has changed its mode.
  void note_change(std::size_t law, const friction::Memory& before, friction::Trigger trigger,
                   friction::Direction direction);
  /// From the crossing, on the motion behind it. `sizes`: of the components before it.
  void leave(const Present& present, std::span<const double> sizes);

 private:
  /// A mode change of a law.
  struct Change {
    std::size_t law;
    friction::Memory before;
    friction::Trigger trigger;
    friction::Direction direction;
  };
  /// What the crossing of a guard added to lead_, to be taken back behind it.
  struct EventLead {
    Eigen::RowVectorXd time;  ///< of each column [s]; empty: there is none
    Eigen::VectorXd rates_before;
    Eigen::MatrixXd columns_before;
    Eigen::RowVectorXd lead_before;
  };
  /// The guards of a law beside the one that was crossed.
  struct Others {
    std::size_t law = 0;
    Eigen::MatrixXd gradients;  ///< a row of each
  };
  /// How the motion goes on behind an implicit step.
  struct Course {
    std::vector<double> rates;  ///< by the step's polynomial
    double length = 0.0;        ///< of the step [s]; 0: nothing is known
  };

  void note_course(const SmoothStep& step);
  void rates_of_motion(const Flow& flow, std::span<const double> X, double t, std::vector<double>& rates) const;
  [[nodiscard]] Eigen::VectorXd rates_now(const Present& present) const;
  [[nodiscard]] bool forgets_speed(const SmoothStep& step) const;
  void lead_near_stop(const SmoothStep& step);
  [[nodiscard]] Eigen::MatrixXd gradients(const Guards& guards, const SmoothStep& step) const;
  void note_others(const Guards& guards, std::size_t guard, const Eigen::MatrixXd& gradients);
  void take_back(const EventLead& added, const Eigen::MatrixXd& at_crossing, const Eigen::VectorXd& rates,
                 std::span<const double> sizes);
  void carry_through_changes(const Present& present, std::span<const double> sizes);
  [[nodiscard]] Eigen::VectorXd through(const Change& change, const friction::Instant& now, Eigen::Index column,
                                        const Eigen::VectorXd& states, std::span<const double> sizes) const;

  const Model& model_;
  const Drive& drive_;
  const VelocityHistory& past_;
  double shortest_period_;
  Eigen::MatrixXd columns_;
  Eigen::RowVectorXd lead_;  ///< of each column: the time by which its motion is ahead, beside columns_ [s]
  EventLead event_lead_;
  std::vector<Others> others_;  ///< of the crossings at the present instant
  Course course_;
  std::vector<Change> changes_;  ///< at the event that ends the interval
  std::unique_ptr<Variation> variation_;
  Eigen::Index variation_size_ = 0;
  long work_ = 0;
};

}  // namespace dualdamp::sim
