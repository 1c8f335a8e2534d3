#pragma once
/// Finds orbits that attract by Newton's method from a state near the orbit, over one forcing period or several.

#include <limits>
#include <memory>
#include <optional>

#include "core/crossing/search_result.hpp"
#include "sim/orbits/newton.hpp"
#include "sim/orbits/period_map.hpp"

namespace dualdamp::sim {

/// An orbit: one period of it with the monodromy matrix, and the period in forcing periods.
struct Orbit {
  ForcingPeriod period;
  int period_ratio = 1;
};

/// Two orbits whose distance, relative to their size, is below this or below the sum of their errors
/// (`error_of_orbit`) are the same.
inline constexpr double same_orbit = 1e-6;

class OrbitSolver {
 public:
  /// `tolerance`, `rounding`: as in NewtonOptions.
  OrbitSolver(const Model& model, double tolerance, double rounding);

  /// An orbit near the state that attracts. Its period is the shortest one that attracts by its own multipliers,
  /// which divides `periods`.
  [[nodiscard]] std::optional<Orbit> near(const State& state, int periods);
  /// The same orbit with its shortest period. Beside a continuum a period may hardly attract, so that Newton's
  /// method finds the orbit only as one of several periods.
  [[nodiscard]] Orbit with_shortest_period(Orbit orbit);
  /// The same orbit closed as well as rounding allows, if it attracts so slowly that the solver's closure leaves an
  /// error.
  [[nodiscard]] Orbit refined(Orbit orbit);
  /// Error of an orbit that this solver accepts, relative to the motion; 0 if it attracts fast enough for the error
  /// to be of the order of the closure.
  [[nodiscard]] double error(const Orbit& orbit) const;
  /// An orbit of one forcing period on which the mass moves, near the state or near the motion from it some periods
  /// later: Newton's method from a distant state may end at a rest, or fail.
  [[nodiscard]] std::optional<Orbit> near_motion_from(State state);
  /// The same orbit with its start moved on by `periods` forcing periods.
  [[nodiscard]] Orbit later(const Orbit& orbit, long periods);
  /// Whether both are one orbit with the same start.
  [[nodiscard]] bool same(const Orbit& a, const Orbit& b) const;
  /// Whether both are one orbit, with starts that may be some forcing periods apart.
  [[nodiscard]] bool coincide(const Orbit& a, const Orbit& b);
  /// A map over this number of forcing periods; valid until the next call of a member function.
  [[nodiscard]] PeriodMap& map_over(int periods);
  /// Such a map without a limit of its work, for a known orbit.
  [[nodiscard]] PeriodMap& patient_map_over(int periods);

  [[nodiscard]] int newton_steps() const { return newton_steps_; }
  [[nodiscard]] core::SearchCount count() const;
  [[nodiscard]] long work() const { return work_ + (map_ ? map_->engine().work() : 0); }  ///< `Engine::work`
  /// Limits the total work (`Engine::work`); beyond the limit no orbit is found.
  void limit(long work) { most_work_ = work; }

 private:
  [[nodiscard]] std::optional<Orbit> attracting(const State& state, int periods);

  const Model& model_;
  NewtonOptions options_;
  std::unique_ptr<PeriodMap> map_;
  core::SearchCount searched_;  ///< by deleted maps
  long work_ = 0;               ///< of deleted maps
  int newton_steps_ = 0;
  long most_work_ = std::numeric_limits<long>::max();
};

}  // namespace dualdamp::sim
