#include "identify/ledger/histories/innovations.hpp"

#include <cmath>

namespace dualdamp::identify {

namespace {

/// The disturbance (x, v, force) of a motion at one sample, as far as the readings tell, in every column.
struct Disturbance {
  Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
  Eigen::Matrix3Xd s;

  void carry(const SampledOscillator::Step& step, double drive) {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    A.topLeftCorner<2, 2>() = step.carried;
    A.topRightCorner<2, 1>() = step.pushed;
    s = A.lazyProduct(s).eval();
    P = (A * P * A.transpose()).eval();
    P(2, 2) = drive * drive;
  }

  /// Replaces a row by its innovation: read with this sensitivity to the disturbance and this variance of noise.
  void read(Eigen::Ref<Eigen::RowVectorXd, 0, Eigen::InnerStride<>> row, const Eigen::Vector3d& by,
            double variance) {
    const Eigen::Vector3d covariance = P * by;
    const double sum = by.dot(covariance) + variance;
    row -= by.transpose().lazyProduct(s);
    s += (covariance / sum).lazyProduct(row);
    P -= covariance * covariance.transpose() / sum;
    row /= std::sqrt(sum);
  }
};

}  // namespace

void make_innovations(const std::vector<SampledOscillator::Step>& steps, const ReadingNoise& noise,
                      const ForceParameters& force, SensorRows& rows) {
  Disturbance now{.s = Eigen::Matrix3Xd::Zero(3, rows.x.cols())};
  now.P(2, 2) = noise.drive * noise.drive;
  const Eigen::Vector3d of_a(-force.k / force.m, -force.c / force.m, 1.0 / force.m);
  for (Eigen::Index i = 0; i < rows.x.rows(); ++i) {
    if (i > 0) now.carry(steps[static_cast<std::size_t>(i)], noise.drive);
    now.read(rows.x.row(i), Eigen::Vector3d::UnitX(), noise.x * noise.x);
    if (rows.v.rows() > 0) now.read(rows.v.row(i), Eigen::Vector3d::UnitY(), noise.v * noise.v);
    // Rows left out at reversals are zero, and tell nothing.
    if (rows.a.rows() > 0 && rows.a.row(i).any()) now.read(rows.a.row(i), of_a, noise.a * noise.a);
  }
}

}  // namespace dualdamp::identify
