#pragma once
/// Orbits that attract, found by Newton's method from a state near one, over one forcing period or several.

#include <limits>
#include <memory>
#include <optional>

#include "core/crossing/search_result.hpp"
#include "sim/orbits/newton.hpp"
#include "sim/orbits/period_map.hpp"

namespace dualdamp::sim {

/// An orbit with its monodromy matrix, and its period in forcing periods.
struct Orbit {
  ForcingPeriod period;
  int period_ratio = 1;
};

/// Orbits nearer to each other than this, relative to their size, are one.
inline constexpr double same_orbit = 1e-6;

class OrbitSolver {
 public:
  /// `tolerance`, `rounding`: as in NewtonOptions.
  OrbitSolver(const Model& model, double tolerance, double rounding);

  /// An orbit that attracts, of its shortest period, which divides `periods`.
  [[nodiscard]] std::optional<Orbit> near(const State& state, int periods);
  /// An orbit of one forcing period that moves, near the state or near where the motion from it is some periods
  /// later: Newton's method from far off may end at a rest, or nowhere.
  [[nodiscard]] std::optional<Orbit> near_motion_from(State state);
  /// The orbit from the state on that it reaches after `periods`.
  [[nodiscard]] Orbit later(const Orbit& orbit, long periods);
  /// Both are met at the same time.
  [[nodiscard]] bool same(const Orbit& a, const Orbit& b) const;
  /// The same, perhaps some forcing periods apart.
  [[nodiscard]] bool coincide(const Orbit& a, const Orbit& b);
  /// A map over so many forcing periods; valid until the next call of any function here.
  [[nodiscard]] PeriodMap& map_over(int periods);
  /// The same for an orbit that is known: without a limit of its work.
  [[nodiscard]] PeriodMap& patient_map_over(int periods);

  [[nodiscard]] int newton_steps() const { return newton_steps_; }
  [[nodiscard]] core::SearchCount count() const;
  /// How much work (`Engine::work`) there may be all in all; beyond it no orbit is found.
  void limit(long work) { most_work_ = work; }

 private:
  [[nodiscard]] std::optional<Orbit> attracting(const State& state, int periods);

  const Model& model_;
  NewtonOptions options_;
  std::unique_ptr<PeriodMap> map_;
  core::SearchCount searched_;  ///< by maps that are gone
  long work_ = 0;               ///< of maps that are gone
  int newton_steps_ = 0;
  long most_work_ = std::numeric_limits<long>::max();
};

}  // namespace dualdamp::sim
