#include "sim/orbits/attraction.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace dualdamp::sim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// sum_k (M^T)^k M^k by doubling: the sum of the first 2 n terms from that of the first n and M^n.
MatrixXd sum_of_powers(const MatrixXd& monodromy) {
  constexpr int doublings = 48;
  MatrixXd sum = MatrixXd::Identity(monodromy.rows(), monodromy.rows());
  MatrixXd power = monodromy;
  for (int i = 0; i < doublings && power.norm() > 1e-20; ++i) {
    sum += (power.transpose() * sum * power).eval();
    power = (power * power).eval();
  }
  return sum;
}

}  // namespace

Attraction::Attraction(const ForcingPeriod& orbit, double omega, double resolution)
    : orbit_(orbit.begin), resolution_(resolution), free_(orbit.free_coordinates()) {
  const VectorXd at = coordinates(orbit.begin);
  const double size = std::max(orbit.size, std::abs(at[1]) / omega);
  scale_ = VectorXd::Constant(at.size(), size);
  scale_[1] = size * omega;
  for (Index i = 2; i < at.size(); ++i) scale_[i] = std::max(std::abs(at[i]), size);
  const MatrixXd scaled = scale_.cwiseInverse().asDiagonal() * orbit.monodromy * scale_.asDiagonal();
  monodromy_ = scaled(free_, free_);
  root_ = sum_of_powers(monodromy_).llt().matrixU();
}

/// The scaled deviation of the free coordinates. Empty if the motion is in another mode, or if a coordinate that
/// the orbit never changes has another value.
VectorXd Attraction::from_orbit(const State& state) const {
  if (!are_comparable(state, orbit_)) return {};
  const VectorXd all = (coordinates(state) - coordinates(orbit_)).cwiseQuotient(scale_);
  VectorXd free = all(free_);
  for (Index i = 0; i < all.size(); ++i) {
    if (std::ranges::find(free_, i) == free_.end() && std::abs(all[i]) > resolution_) return {};
  }
  return free;
}

void Attraction::observe(const State& state) {
  const VectorXd now = from_orbit(state);
  const bool comparable = now.size() > 0 && last_.size() > 0;
  // At v = 0 the mode must be the same too, because friction jumps there.
  const bool there = now.size() > 0 && now.norm() <= resolution_ && same_mode(state, orbit_);
  bool closer = false;
  if (comparable && !there) {
    const VectorXd linear = monodromy_ * last_;
    const double gain = last_.squaredNorm() / (norm(last_) + norm(linear));
    closer = norm(now - linear) <= 0.5 * gain;
  }
  approaching_ = there || closer ? approaching_ + 1 : 0;
  deviation_ = now.size() > 0 ? norm(now) : std::numeric_limits<double>::infinity();
  const bool first = nearest_ == 0.0;
  if (first) first_ = deviation_;
  nearest_ = first ? deviation_ : std::min(nearest_, deviation_);
  last_ = now;
}

}  // namespace dualdamp::sim
