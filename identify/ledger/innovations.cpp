#include "identify/ledger/innovations.hpp"

#include <Eigen/Cholesky>

namespace dualdamp::identify {

void make_innovations(const std::vector<SampledOscillator::Step>& steps, const ReadingNoise& noise,
                      Eigen::MatrixXd& x, Eigen::MatrixXd& v) {
  const bool both = v.rows() > 0;
  const Eigen::Index readings = both ? 2 : 1;
  Eigen::MatrixXd H = Eigen::MatrixXd::Identity(readings, 2);
  const Eigen::VectorXd variances = Eigen::Vector2d(noise.x * noise.x, noise.v * noise.v).head(readings);
  Eigen::Matrix2d P = Eigen::Matrix2d::Zero();
  Eigen::MatrixXd s = Eigen::MatrixXd::Zero(2, x.cols());  // of every column
  Eigen::MatrixXd read(readings, x.cols());
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    if (i > 0) {
      const SampledOscillator::Step& step = steps[static_cast<std::size_t>(i)];
      s = (step.carried * s).eval();
      P = (step.carried * P * step.carried.transpose()).eval();
      P += noise.drive * noise.drive * step.pushed * step.pushed.transpose();
    }
    read.row(0) = x.row(i);
    if (both) read.row(1) = v.row(i);
    read -= H * s;
    Eigen::MatrixXd S = H * P * H.transpose();
    S.diagonal() += variances;
    const Eigen::LLT<Eigen::MatrixXd> factor(S);
    const Eigen::MatrixXd gain = factor.solve(H * P).transpose();
    s += gain * read;
    P -= (gain * H * P).eval();
    const Eigen::MatrixXd white = factor.matrixL().solve(read);
    x.row(i) = white.row(0);
    if (both) v.row(i) = white.row(1);
  }
}

}  // namespace dualdamp::identify
