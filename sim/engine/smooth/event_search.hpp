#pragma once
/// The search of the smooth engine for the event that ends an interval: which guard crosses first, and at which
/// part of a step.
///
/// Guards are watched on the dense output of each step: at five points, where a parabola through three of them dips
///   to zero, and where they fall into the step from its start or rise out of it at its end. Sides are frozen as in
///   the exact engine. Nothing proves here that a guard did not cross twice between two of those points; where
///   every law is affine the exact engine does.
/// Rounding. A velocity within 1e-13 of zero has not changed its sign: bristles that ring down to rounding make no
///   events. What counts as zero at the start of an interval also depends on how
///   well the step before knew the time of the mode change there. Guards that cross at one instant, to rounding,
///   act in the order of the list.
///
/// It knows guards and steps only: it takes no step, and changes neither modes nor the state.
///
/// Cost: of a step five evaluations of all guards; of a crossing some ten more, and its repeated step.

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/crossing/search_result.hpp"
#include "sim/engine/flow.hpp"
#include "sim/engine/smooth/guards.hpp"
#include "sim/engine/smooth/smooth_step.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

class EventSearch {
 public:
  /// Panels between the points of a step.
  static constexpr long panels = 4;
  /// Crossings within this part of the longest step are at the start of the interval.
  static constexpr double shortest_part = 1e-15;

  /// A guard that has crossed, and at which part of the step.
  struct Hit {
    std::size_t guard = 0;
    double part = 1.0;
  };

  /// Both must outlive it; `flow`: that of the present interval.
  EventSearch(const Model& model, const Flow& flow);

  /// Lists the guards of an interval that begins at X and t [s] and takes their sizes. `force`: that of the drive's
  /// force [N].
  void begin_interval(std::span<const double> X, double t, double force);
  /// The guards of the interval.
  [[nodiscard]] const Guards& guards() const { return guards_; }

  /// The kind of the steps that follow.
  void use_steps(bool are_implicit) { guards_.pass_over_relaxation(are_implicit); }

  /// A guard that is negative at the start of the interval, or zero and going to be.
  [[nodiscard]] std::optional<Hit> find_violated(const SmoothStep& step) const;
  /// Whether this guard of a law is reached at the same instant as that of the last event.
  [[nodiscard]] bool coincides(const Hit& hit, const SmoothStep& step) const;

  /// The first crossing on the step.
  [[nodiscard]] std::optional<Hit> find(const SmoothStep& step);
  /// Guards that only touch zero before it, or near it.
  [[nodiscard]] const std::vector<core::Grazing>& grazings() const { return grazings_; }
  /// Whether a slip is found to end where the equation of motion drives the mass on: friction that turns over
  /// within a speed far below the step's reach, so that an explicit step passes over the creep at which the forces
  /// balance.
  [[nodiscard]] bool ends_against_flow(const Hit& hit, const SmoothStep& step) const;
  /// Whether the dense output alone crosses: a shorter step shows.
  [[nodiscard]] bool may_be_swing_of_output(const Hit& hit, const SmoothStep& step) const;
  /// How far from zero a guard may be at the end of a step that ends at its crossing. `speed`: the error allowed in
  /// the velocity [m/s].
  [[nodiscard]] double zero(std::size_t guard, double speed) const;

  /// The step ends at the event: notes how well it knows the event, for the interval behind it.
  void note_landing(const Hit& hit, const SmoothStep& step);
  /// No event is near that has to be known better than that.
  void forget_landing() { landing_ = {}; }

  /// Whether a law's guard is far below what it was earlier in this interval, as behind the fast decay of a state:
  /// its size then has to be taken anew.
  [[nodiscard]] bool has_faded() const;

 private:
  static constexpr std::size_t points = panels + 1;
  /// A guard's values at 0, 1/4, ..., 1 of the step taken last, and what to judge them by.
  struct Watch {
    std::array<double, points> values{};
    double scale = 0.0;  ///< its size, to judge rounding by
    double reach = 0.0;  ///< of a law: what the sizes of x, v and the states make of it
    double parts = 0.0;  ///< of a law: what cancels in it at the start of the interval
  };
  /// How well the step before the present interval knows when the law changed its mode there. In time: a law's
  /// guards are forces in one mode and speeds in another.
  struct Landing {
    std::size_t law = 0;
    double error = 0.0;  ///< s
  };
  /// Three points of a step, as parts of it, and a guard there: the lowest in the middle.
  struct Triple {
    std::array<double, 3> at{};
    std::array<double, 3> value{};
  };

  void size_up(std::span<const double> X, double t);
  [[nodiscard]] double value(std::size_t guard, const SmoothStep& step, double part) const;
  [[nodiscard]] double level_at_start(std::size_t guard, const SmoothStep& step) const;
  [[nodiscard]] double landing_error(std::size_t guard, const SmoothStep& step) const;
  [[nodiscard]] bool is_clearly_positive(std::size_t guard, const SmoothStep& step, double value) const;
  [[nodiscard]] double value_along_flow(std::size_t guard, const SmoothStep& step, double length, int steps) const;
  [[nodiscard]] bool goes_negative(std::size_t guard, const SmoothStep& step, double value, double level) const;
  [[nodiscard]] bool cross_together(const Hit& later, double part, const SmoothStep& step) const;
  [[nodiscard]] double first_negative(std::size_t guard, const SmoothStep& step);
  [[nodiscard]] double dip(std::size_t guard, const SmoothStep& step, Triple around);
  [[nodiscard]] bool creeps_beside(std::size_t guard, const SmoothStep& step,
                                   const std::array<double, 3>& at) const;
  [[nodiscard]] bool falls_at_edge(std::size_t guard, const SmoothStep& step, std::size_t edge,
                                   Triple& around) const;
  [[nodiscard]] double crossing(std::size_t guard, const SmoothStep& step, double before, double negative) const;

  const Model& model_;
  const Flow& flow_;
  Guards guards_;
  std::vector<Watch> watches_;  ///< of each guard
  Landing landing_;
  std::vector<core::Grazing> grazings_;  ///< on the step searched last
  // Scratch.
  mutable std::vector<double> state_;
  mutable std::vector<double> rates_;
  mutable std::vector<double> values_;
};

}  // namespace dualdamp::sim
