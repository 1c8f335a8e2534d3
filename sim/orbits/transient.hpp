#pragma once
/// The motion from the initial state, forcing period by forcing period, until it repeats itself. Steady states are
/// checked against it: it shares the engine with `steady_state`, but neither Newton's method nor the monodromy
/// matrix.
///
/// Let d be the distance by which the last period closes, and q the factor by which it falls from period to period.
/// The rest of the transient is then about d q/(1 - q). The transient has settled if this is below
/// `TransientOptions::settled` of the size of the motion. A motion that winds about its orbit closes better and
/// worse in turn, so d and q are taken over 8, 16, 32 ... periods, and all must agree. Cost: one pass of the engine
/// for each period.

#include <functional>
#include <limits>
#include <string>

#include "core/outcome.hpp"
#include "sim/model.hpp"
#include "sim/orbits/period_map.hpp"

namespace dualdamp::sim {

struct TransientOptions {
  int max_periods = 2000;  ///< forcing periods
  int period_ratio = 1;    ///< forcing periods after which the motion is expected to repeat itself
  double settled = 1e-9;   ///< relative to the size of the motion
  long most_work = std::numeric_limits<long>::max();  ///< `Engine::work`
  std::function<bool()> give_up{};  ///< called after every period: true ends the transient; may be empty
};

struct Transient {
  core::Outcome outcome;  ///< of the engine
  bool settled = false;
  int periods = 0;       ///< forcing periods
  double closure = 0.0;  ///< of the last period of the motion, relative to the size of the motion
  double peak = 0.0;     ///< max x of the last period [m]
  double trough = 0.0;   ///< min x of the last period [m]
  int stops = 0;         ///< in the last period
};

/// Integrates the transient. Needs a harmonic excitation.
[[nodiscard]] Transient follow_transient(const Model& model, const TransientOptions& options = {});

/// The extremes of a period, and its events in order.
class PeriodEvents : public PeriodObserver {
 public:
  void begin(const State& start) override;
  void observe(const Interval& interval, double x) override;

  /// Two letters for each event: its kind, and the direction before it.
  [[nodiscard]] const std::string& sequence() const { return sequence_; }
  [[nodiscard]] double peak() const { return peak_; }      ///< m
  [[nodiscard]] double trough() const { return trough_; }  ///< m
  [[nodiscard]] int stops() const { return stops_; }

 private:
  std::string sequence_;
  double peak_ = 0.0;
  double trough_ = 0.0;
  int stops_ = 0;
};

}  // namespace dualdamp::sim
