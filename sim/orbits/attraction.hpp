#pragma once
/// Whether a motion approaches an orbit, told from the motion itself.
///
/// Newton's method finds an orbit near the motion, but not always the one that the motion approaches. Let d be the
/// motion's deviation from the orbit, once every period, M the orbit's monodromy matrix with all Floquet
/// multipliers inside the unit circle, and
///
///   P = sum_k (M^T)^k M^k,   |d|_P^2 = d^T P d,   so that   |M d|_P^2 = |d|_P^2 - |d|^2:
///
/// in this norm the linear motion approaches the orbit with every period. The motion itself does where it departs
/// from the linear one by less than half of that gain. This is asked of several periods in a row; as the departure
/// is of second order in d, what holds there holds better and better from there on.

#include <Eigen/Core>

#include "sim/orbits/period_map.hpp"

namespace dualdamp::sim {

class Attraction {
 public:
  /// `orbit`: a period of the orbit with its monodromy matrix; `resolution`: relative to the size of the motion,
  /// deviations below it are none.
  Attraction(const ForcingPeriod& orbit, double omega, double resolution);

  /// Of the motion one period after the last call (or at first).
  void observe(const State& state);

  /// So many periods in a row brought the motion closer as they should.
  [[nodiscard]] bool approaches() const { return approaching_ >= enough_; }
  /// The motion is farther than it was: it approaches something else.
  [[nodiscard]] bool leaves() const { return deviation_ > 2.0 * nearest_; }
  /// Deviation now, and the first one, in the norm above.
  [[nodiscard]] double deviation() const { return deviation_; }
  [[nodiscard]] double first_deviation() const { return first_; }

 private:
  static constexpr int enough_ = 3;

  [[nodiscard]] Eigen::VectorXd from_orbit(const State& state) const;
  [[nodiscard]] double norm(const Eigen::VectorXd& d) const { return (root_ * d).norm(); }

  State orbit_;
  double resolution_;
  std::vector<Eigen::Index> free_;  ///< coordinates that the orbit does not leave as they are
  Eigen::VectorXd scale_;           ///< of all coordinates
  Eigen::MatrixXd monodromy_;       ///< scaled, of the free coordinates
  Eigen::MatrixXd root_;            ///< P = root^T root
  Eigen::VectorXd last_;            ///< deviation one period ago; empty: not comparable
  double deviation_ = 0.0;
  double nearest_ = 0.0;
  double first_ = 0.0;
  int approaching_ = 0;
};

}  // namespace dualdamp::sim
