#pragma once
/// Changes of zeta and F0, relative to their values in a joint model.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "identify/ledger/joint_model.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/least_squares.hpp"

namespace dualdamp::identify {

/// Where a value is smaller than its standard error, changes are relative to that error.
class RelativeChanges {
 public:
  RelativeChanges(const JointModel& model, double freedom)
      : zeta_(std::abs(model.value.zeta)), F0_(std::abs(model.value.F0)) {
    const std::optional<Eigen::MatrixXd> covariance = unit_covariance(model.base);
    if (!covariance || !(freedom > 0.0)) return;
    const Eigen::VectorXd left = left_beside(model.base, model.residuals);
    const double deviation = model.is_stated ? 1.0 : std::sqrt(left.squaredNorm() / std::max(1.0, freedom));
    zeta_ = std::max(zeta_, deviation * std::sqrt((*covariance)(0, 0)));
    F0_ = std::max(F0_, deviation * std::sqrt((*covariance)(1, 1)));
  }
  [[nodiscard]] double zeta(double change) const { return change / zeta_; }
  [[nodiscard]] double F0(double change) const { return change / F0_; }

 private:
  double zeta_;
  double F0_;
};

}  // namespace dualdamp::identify
