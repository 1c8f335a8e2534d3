#pragma once
/// The smooth engine: walks from event to event for laws that are not affine, and with a spring that is not linear.
///
/// Between events the motion is integrated with the branch frozen (`flow.hpp`), so that the field is analytic on
/// every step and a step may overrun the event that ends it. Steps are those of DOP853; once these are limited
/// by stability instead of accuracy, of Radau IIA for the rest of the motion (`stepper.hpp`).
///
/// Events. A guard that crosses on a step is found on its dense output (`smooth/event_search.hpp`). The step is
/// then repeated so that it ends at the event, which is so known to the accuracy of a step's end.
///
/// Derivatives of the motion: `smooth/motion_derivative.hpp`.
///
/// Cost: for a law with one state about 1 us a step of Radau IIA, the same for one of DOP853, and the watch of the
/// guards.

#include <memory>
#include <optional>
#include <string>

#include "sim/engine/engine.hpp"
#include "sim/engine/flow.hpp"
#include "sim/engine/smooth/event_search.hpp"
#include "sim/engine/smooth/motion_derivative.hpp"
#include "sim/engine/smooth/steps.hpp"
#include "sim/engine/velocity_history.hpp"

namespace dualdamp::sim {

/// Part of force/stiffness that counts as the size of a motion that has none yet.
inline constexpr double small_motion = 1e-3;

/// Whether a motion of this length [m] is shorter than the error of one step: steps of this accuracy
/// (`Engine::accuracy`) do not resolve it beside the displacement that the drive can cause.
[[nodiscard]] bool is_below_steps(const Model& model, double length, double accuracy);

class SmoothEngine final : public Engine {
 public:
  explicit SmoothEngine(const Model& model);
  ~SmoothEngine() override;

  [[nodiscard]] double accuracy() const override { return 10.0 * model_.solver.tolerance; }
  [[nodiscard]] std::string fast_vibration() const override;
  [[nodiscard]] long work() const override;
  [[nodiscard]] bool has_past() const override { return reach_ > 0.0; }
  [[nodiscard]] State state() const override;

  void reset_sensitivity() override;
  [[nodiscard]] Eigen::MatrixXd sensitivity() const override;

 private:
  class StepInterval;
  using Hit = EventSearch::Hit;

  [[nodiscard]] const Interval* step(double left, bool to_period_end) override;
  [[nodiscard]] Balance balance() override;
  void begin_motion() override;
  void restore_past(const State& state) override;
  void jumped(std::size_t law, const friction::Memory& before, friction::Trigger trigger) override;

  void build_interval();
  void set_scales();
  [[nodiscard]] bool advance(double left);
  [[nodiscard]] bool is_past_turn(const Hit& hit, double value) const;
  [[nodiscard]] bool land(const Hit& hit);
  [[nodiscard]] bool move(double left, std::optional<Hit>& hit);
  void describe_step();
  void take_over(bool at_slip_end);
  void pass_time(bool to_period_end);
  [[nodiscard]] MotionDerivative::Present present() const;

  [[nodiscard]] bool is_near_end_of_range() const;
  [[nodiscard]] bool has_run_away() const;
  void stop_at_many_steps();
  void stop_at_short_steps();

  VelocityHistory past_;
  Flow flow_;   ///< of the present interval
  Flow judge_;  ///< of the instant of an event
  EventSearch search_;
  Steps steps_;
  MotionDerivative derivative_;
  double reach_ = 0.0;          ///< longest delay of a law [s]
  double x_scale_ = 0.0;        ///< m
  bool is_laid_ = false;        ///< flow_ and what depends on it are those of the present interval
  bool follows_event_ = false;  ///< the present interval begins with an event
  std::unique_ptr<StepInterval> interval_;
};

}  // namespace dualdamp::sim
