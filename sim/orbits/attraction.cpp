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

MatrixXd power_of(const MatrixXd& matrix, int exponent) {
  MatrixXd power = MatrixXd::Identity(matrix.rows(), matrix.cols());
  for (MatrixXd square = matrix; exponent > 0; exponent /= 2) {
    if (exponent % 2 == 1) power = (power * square).eval();
    square = (square * square).eval();
  }
  return power;
}

}  // namespace

Attraction::Attraction(const ForcingPeriod& orbit, double omega, double resolution, double error)
    : orbit_(orbit.begin),
      resolution_(resolution),
      arrived_(std::max(resolution, error)),
      free_(orbit.free_coordinates()) {
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

/// The condition for two deviations, one period apart.
bool Attraction::comes_closer(const VectorXd& before, const VectorXd& after) const {
  const VectorXd linear = monodromy_ * before;
  const double gain = before.squaredNorm() / (norm(before) + norm(linear));
  return norm(after - linear) <= 0.5 * gain;
}

/// The state with these free coordinates.
State Attraction::at(const VectorXd& deviation) const {
  VectorXd all = VectorXd::Zero(scale_.size());
  all(free_) = deviation;
  State state = displaced(orbit_, all.cwiseProduct(scale_));
  // Far from the orbit the mass may move the other way.
  if (state.direction != friction::Direction::none && state.v != 0.0)
    state.direction = state.v < 0.0 ? friction::Direction::backward : friction::Direction::forward;
  return state;
}

bool Attraction::arrives_soon() const {
  constexpr int soon = 20;
  return last_.norm() > arrived_ && (power_of(monodromy_, soon) * last_).norm() <= arrived_;
}

bool Attraction::holds_ahead(PeriodMap& map) const {
  constexpr int farthest = 1 << 20;
  VectorXd before = last_;
  for (int ahead = 0; ahead < farthest;) {
    const int step = std::max(1, ahead / 4);
    before = power_of(monodromy_, step) * before;
    ahead += step;
    if (!(before.norm() > arrived_)) break;
    const VectorXd after = from_orbit(map.from(at(before), Monodromy::without).end);
    if (!map.outcome().ok() || after.size() == 0) return false;
    if (after.norm() > arrived_ && !comes_closer(before, after)) return false;
  }
  return true;
}

bool Attraction::has_come_nearer() const {
  if (deviations_.size() < 2) return false;
  constexpr double nearer = 0.9;
  const auto half = deviations_.begin() + static_cast<std::ptrdiff_t>(deviations_.size() / 2);
  return *std::max_element(half, deviations_.end()) < nearer * *std::max_element(deviations_.begin(), half);
}

void Attraction::observe(const State& state) {
  const VectorXd now = from_orbit(state);
  const bool comparable = now.size() > 0 && last_.size() > 0;
  // At v = 0 the mode must be the same too, because friction jumps there.
  const bool there = now.size() > 0 && now.norm() <= arrived_ && same_mode(state, orbit_);
  const bool closer = comparable && !there && comes_closer(last_, now);
  approaching_ = there || closer ? approaching_ + 1 : 0;
  deviation_ = now.size() > 0 ? norm(now) : std::numeric_limits<double>::infinity();
  nearest_ = nearest_ == 0.0 ? deviation_ : std::min(nearest_, deviation_);
  if (std::isfinite(deviation_)) deviations_.push_back(deviation_);
  last_ = now;
}

}  // namespace dualdamp::sim
