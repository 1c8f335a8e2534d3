#pragma once
/// The orbit that the motion from the initial state approaches, found by integrating that motion.
///
/// Once the motion nearly comes back after one forcing period, or after up to 64, Newton's method on the map over
/// as many periods finds the orbit near it. The motion goes on until it shows that it approaches this orbit
/// (`attraction.hpp`) or another one. So the answer is the orbit that an integration for ever would end on.

#include <array>
#include <optional>
#include <vector>

#include "sim/orbits/attraction.hpp"
#include "sim/orbits/growth.hpp"
#include "sim/orbits/monotone_model.hpp"
#include "sim/orbits/orbit_solver.hpp"
#include "sim/orbits/patience.hpp"
#include "sim/orbits/period_map.hpp"
#include "sim/orbits/recurrence.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::sim {

class Approach {
 public:
  /// `map`: of one forcing period; `solver`: of the same model; `motions`: whether several orbits are looked for.
  Approach(const Model& model, const SteadyStateOptions& options, PeriodMap& map, OrbitSolver& solver,
           Motions motions);

  /// Counts the periods in `result`, adds warnings to it, or says why there is no orbit.
  [[nodiscard]] std::optional<Orbit> find(SteadyState& result);
  /// Orbits that attract but not this motion.
  [[nodiscard]] const std::vector<Orbit>& others() const { return others_; }

 private:
  struct Candidate {
    Orbit orbit;
    Attraction attraction;
    long found_at = 0;  ///< forcing periods since the start
  };

  [[nodiscard]] std::optional<Orbit> look(const ForcingPeriod& period, SteadyState& result);
  [[nodiscard]] std::optional<Orbit> closed(const State& state);
  [[nodiscard]] bool has_arrived(const State& state);
  [[nodiscard]] int worth_trying();
  [[nodiscard]] bool is_due();
  void try_candidate(const State& state);
  [[nodiscard]] bool is_at_rest(const Orbit& orbit);
  [[nodiscard]] Orbit at_start(const Candidate& candidate);
  [[nodiscard]] std::optional<Orbit> nearly_there(SteadyState& result);
  [[nodiscard]] double divergence(const State& state);
  [[nodiscard]] bool is_followed_enough() const;
  [[nodiscard]] bool is_time_to_tell() const;
  [[nodiscard]] core::Outcome failure() const;

  const Model& model_;
  SteadyStateOptions options_;
  double omega_;
  PeriodMap& map_;
  OrbitSolver& solver_;  ///< for attempts beside the motion
  Motions motions_;
  bool has_past_;
  Recurrence recurrence_;
  Growth growth_;
  std::array<double, longest_period + 1> level_;  ///< closure over n periods at which Newton's method is tried next
  std::array<int, longest_period + 1> streak_{};  ///< for how many periods it has closed so well
  std::optional<Candidate> candidate_;
  std::vector<Orbit> others_;
  long passed_ = 0;  ///< forcing periods since the start
  Patience patience_;
  long begun_at_;          ///< work of the engine before
  long next_trial_;        ///< when Newton's method is tried whatever the closure
  long next_trial_work_;   ///< likewise, by the work of the motion
  long next_closing_ = 0;  ///< when a motion that has come back over several periods is looked at again
  double divergence_ = 0.0;
  bool is_told_ = false;  ///< divergence_ was asked for
};

}  // namespace dualdamp::sim
