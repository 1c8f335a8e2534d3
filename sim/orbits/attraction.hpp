#pragma once
/// Decides from a motion whether it approaches an orbit.
///
/// Newton's method finds an orbit near the motion, but not always the one that the motion approaches. Let d be the
/// motion's deviation from the orbit, once in each period. Let M be the orbit's monodromy matrix, with all Floquet
/// multipliers inside the unit circle, and
///
///   P = sum_k (M^T)^k M^k,   |d|_P^2 = d^T P d,   so that   |M d|_P^2 = |d|_P^2 - |d|^2:
///
/// In this norm the linear motion approaches the orbit in every period. The motion itself does so too if it differs
/// from the linear one by less than half of this gain. The condition must hold in several periods in a row. The
/// difference is of second order in d, so it becomes ever smaller beside the gain as the motion approaches.
///
/// A motion far away that winds slowly obeys the condition by chance where it turns: there friction that falls
/// short of the linear one has no speed to act on. Or a slider that the orbit holds slips once on the way. So the
/// condition must also hold at the deviations M^k d that the linear motion would have later, until they count as
/// zero: at k = 1, 2, ..., 8 and from there on at steps of a quarter of k, so at some ten places of the first turn.
///
/// Orbits may lie so close beside each other that only the motion itself decides between them. Where the linear
/// motion arrives within twenty periods of the exact engine, which cost no more than this test, the motion is
/// followed to the end.

#include <Eigen/Core>
#include <vector>

#include "sim/orbits/period_map.hpp"

namespace dualdamp::sim {

class Attraction {
 public:
  /// `orbit`: a period of the orbit with its monodromy matrix; `resolution`: a smaller deviation, relative to the
  /// size of the motion, counts as zero; `error`: of the orbit (`error_of_orbit`): within it no motion comes
  /// closer.
  Attraction(const ForcingPeriod& orbit, double omega, double resolution, double error = 0.0);

  /// Takes the state of the motion one period after that of the last call.
  void observe(const State& state);

  /// Whether enough periods in a row brought the motion closer by the condition above.
  [[nodiscard]] bool approaches() const { return approaching_ >= enough_; }
  /// Whether the linear motion would reach the orbit within some periods, so that it is cheap to wait for the
  /// motion.
  [[nodiscard]] bool arrives_soon() const;
  /// Whether the condition holds at later deviations of the linear motion too. `map`: over a period of the orbit.
  [[nodiscard]] bool holds_ahead(PeriodMap& map) const;
  /// Whether the motion is twice as far away as it has been: it approaches something else.
  [[nodiscard]] bool leaves() const { return deviation_ > 2.0 * nearest_; }
  /// Whether the motion has come nearer so far: the largest deviation of the later half of the time against that of
  /// the first half. The deviation of a motion that winds rises and falls.
  [[nodiscard]] bool has_come_nearer() const;

 private:
  static constexpr int enough_ = 3;

  [[nodiscard]] Eigen::VectorXd from_orbit(const State& state) const;
  [[nodiscard]] bool comes_closer(const Eigen::VectorXd& before, const Eigen::VectorXd& after) const;
  [[nodiscard]] State at(const Eigen::VectorXd& deviation) const;
  [[nodiscard]] double norm(const Eigen::VectorXd& d) const { return (root_ * d).norm(); }

  State orbit_;
  double resolution_;               ///< of coordinates that a period never changes
  double arrived_;                  ///< a deviation of the others that counts as zero
  std::vector<Eigen::Index> free_;  ///< coordinates that a period of the orbit changes
  Eigen::VectorXd scale_;           ///< of all coordinates
  Eigen::MatrixXd monodromy_;       ///< scaled, of the free coordinates
  Eigen::MatrixXd root_;            ///< P = root^T root
  Eigen::VectorXd last_;            ///< deviation one period ago; empty: not comparable
  double deviation_ = 0.0;
  double nearest_ = 0.0;
  std::vector<double> deviations_;  ///< once in each period that begins in the mode of the orbit
  int approaching_ = 0;
};

}  // namespace dualdamp::sim
