#pragma once
/// Collects the results of a steady state along one period of its orbit.

#include "sim/motion/observers.hpp"
#include "sim/orbits/period_map.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::sim {

/// What is collected.
struct AccountParts {
  OrbitDetail detail = OrbitDetail::full;
  bool sticks_by_speed = false;  ///< count sticks by speed if no law holds the mass
};

/// Observes a period of the motion from its start; the period map calls it for every interval.
class OrbitAccount final : public PeriodObserver {
 public:
  OrbitAccount(const Model& model, AccountParts parts);

  void begin(const State& start) override;
  void observe(const Interval& interval, double x) override;

  /// Fills in the numbers of `result` after a period has passed.
  void write(SteadyState& result);

 private:
  void collect_speeds(const Interval& interval);
  [[nodiscard]] int slow_spans(double period) const;
  void collect_stick(const Interval& interval, double x);
  void join_stick_across_boundary();
  [[nodiscard]] double lag(int forcing_periods) const;
  [[nodiscard]] bool is_at_rest(double period, int forcing_periods) const;

  OrbitDetail detail_;
  double drive_;  ///< amplitude of the fundamental of the excitation [m or N]
  double drive_phase_;
  double accuracy_;  ///< of x, relative to the largest |x|
  PeakAndTrough extremes_;
  EnergyAudit energy_;
  Fundamental fundamental_;
  bool sticks_by_speed_ = false;
  double spacing_ = 0.0;  ///< of the sampled speeds [s]
  std::vector<double> speeds_;
  double peak_ = 0.0;
  double trough_ = 0.0;
  int stops_ = 0;
  std::vector<Stick> sticks_;
  std::vector<EventKind> sequence_;
  bool sticks_at_start_ = false;
  bool sticking_ = false;  ///< at the end of the last interval
};

/// Computes the orbit that starts at `result.start` and fills in the other numbers of `result`. `map`: over
/// `result.period_ratio` forcing periods.
void account_for_orbit(const Model& model, PeriodMap& map, AccountParts parts, SteadyState& result);

/// The orbit from `start` as a steady state without the full account and without Floquet multipliers. `map`: over
/// `period_ratio` forcing periods.
[[nodiscard]] SteadyState outline_of_orbit(const Model& model, PeriodMap& map, const State& start,
                                           int period_ratio);

}  // namespace dualdamp::sim
