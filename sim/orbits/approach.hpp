#pragma once
/// The orbit that the motion from the initial state approaches, found by integrating that motion.
///
/// Once the motion nearly comes back after one forcing period, or after up to 64, Newton's method on the map over
/// as many periods finds an orbit near it. The motion goes on until it shows that it approaches this orbit
/// (`attraction.hpp`) or another one. So the result is the orbit that the motion approaches without end.

#include <array>
#include <optional>
#include <vector>

#include "sim/orbits/attraction.hpp"
#include "sim/orbits/growth.hpp"
#include "sim/orbits/monotone_model.hpp"
#include "sim/orbits/orbit_solver.hpp"
#include "sim/orbits/period_map.hpp"
#include "sim/orbits/recurrence.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::sim {

class Approach {
 public:
  /// `map`: over one forcing period; `solver`: for the same model; `motions`: whether several orbits may attract.
  Approach(const Model& model, const SteadyStateOptions& options, PeriodMap& map, OrbitSolver& solver,
           Motions motions);

  /// The orbit. Adds the number of periods and warnings to `result`, or sets its outcome to the reason why there is
  /// none.
  [[nodiscard]] std::optional<Orbit> find(SteadyState& result);
  /// Orbits that attract other motions, not this one.
  [[nodiscard]] const std::vector<Orbit>& others() const { return others_; }

 private:
  struct Candidate {
    Orbit orbit;
    Attraction attraction;
    long found_at = 0;  ///< forcing periods since the start
  };

  [[nodiscard]] std::optional<Orbit> look(const ForcingPeriod& period, SteadyState& result);
  [[nodiscard]] std::optional<Orbit> closed(const State& state);
  [[nodiscard]] bool is_closed_within_rounding(const State& state);
  [[nodiscard]] bool has_arrived(const State& state);
  [[nodiscard]] bool holds_ahead(const Candidate& candidate);
  [[nodiscard]] int worth_trying();
  [[nodiscard]] bool is_due();
  void try_candidate(const State& state);
  [[nodiscard]] bool never_moves(const Orbit& orbit);
  [[nodiscard]] Orbit at_start(const Candidate& candidate);
  [[nodiscard]] std::optional<Orbit> nearly_there(SteadyState& result);
  [[nodiscard]] double divergence(const State& state);
  [[nodiscard]] double error_of_multiplier() const;
  void warn_of_multipliers(double radius, SteadyState& result) const;
  [[nodiscard]] bool is_followed_enough() const;
  [[nodiscard]] bool creeps() const;
  [[nodiscard]] bool needs_divergence() const;
  [[nodiscard]] long next_after(long least) const;
  [[nodiscard]] long longer_period();
  [[nodiscard]] core::Outcome rotation();
  [[nodiscard]] core::Outcome failure();

  const Model& model_;
  SteadyStateOptions options_;
  double omega_;
  PeriodMap& map_;
  OrbitSolver& solver_;  ///< for attempts to find an orbit near the motion
  Motions motions_;
  bool has_past_;
  Recurrence recurrence_;
  Growth growth_;
  Creep creep_;
  double size_ = 0.0;                             ///< largest |x| in the last forcing period [m]
  std::array<double, longest_period + 1> level_;  ///< closure over n periods at which Newton's method is tried next
  std::array<int, longest_period + 1> streak_{};  ///< number of periods in a row that closed so well
  std::optional<Candidate> candidate_;
  std::vector<Orbit> others_;
  long passed_ = 0;  ///< forcing periods since the start
  Patience patience_;
  long begun_at_;             ///< work of the engine before this motion
  long next_trial_;           ///< number of periods at which Newton's method is tried whatever the closure
  long next_trial_work_;      ///< the same as work of the motion
  long next_look_ahead_ = 0;  ///< when a motion that seemed to approach the candidate is examined again
  long next_closing_ = 0;     ///< when a motion that came back over several periods is examined again
  long next_rounding_ = 0;    ///< when a motion that nearly came back is compared with rounding again
  double divergence_ = 0.0;
  bool has_divergence_ = false;  ///< divergence_ has been computed
};

}  // namespace dualdamp::sim
