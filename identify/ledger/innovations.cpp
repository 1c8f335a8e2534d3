#include "identify/ledger/innovations.hpp"

#include <Eigen/Cholesky>

namespace dualdamp::identify {

namespace {

/// With `readings` of x, or of x and v, at each sample: sizes known to the compiler, for this runs at every sample.
template <int readings>
void make_innovations(const std::vector<SampledOscillator::Step>& steps, const ReadingNoise& noise,
                      Eigen::MatrixXd& x, Eigen::MatrixXd& v) {
  using Readings = Eigen::Matrix<double, readings, readings>;
  using Gain = Eigen::Matrix<double, 2, readings>;
  const Eigen::Matrix<double, readings, 1> variances =
      Eigen::Vector2d(noise.x * noise.x, noise.v * noise.v).head<readings>();
  Eigen::Matrix2d P = Eigen::Matrix2d::Zero();
  Eigen::Matrix2Xd s = Eigen::Matrix2Xd::Zero(2, x.cols());  // of every column
  Eigen::Matrix<double, readings, Eigen::Dynamic> read(readings, x.cols());
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    if (i > 0) {
      const SampledOscillator::Step& step = steps[static_cast<std::size_t>(i)];
      s = step.carried.lazyProduct(s).eval();
      P = (step.carried * P * step.carried.transpose()).eval();
      P += noise.drive * noise.drive * step.pushed * step.pushed.transpose();
    }
    read.row(0) = x.row(i);
    if constexpr (readings == 2) read.row(1) = v.row(i);
    read -= s.template topRows<readings>();
    Readings S = P.template topLeftCorner<readings, readings>();
    S.diagonal() += variances;
    const Eigen::LLT<Readings> factor(S);
    const Gain gain = factor.solve(P.template topRows<readings>()).transpose();
    s += gain.lazyProduct(read);
    P -= (gain * P.template topRows<readings>()).eval();
    factor.matrixL().solveInPlace(read);
    x.row(i) = read.row(0);
    if constexpr (readings == 2) v.row(i) = read.row(1);
  }
}

}  // namespace

void make_innovations(const std::vector<SampledOscillator::Step>& steps, const ReadingNoise& noise,
                      Eigen::MatrixXd& x, Eigen::MatrixXd& v) {
  if (v.rows() > 0)
    make_innovations<2>(steps, noise, x, v);
  else
    make_innovations<1>(steps, noise, x, v);
}

}  // namespace dualdamp::identify
