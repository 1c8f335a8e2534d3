#include "identify/records/faults/drive_gain.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "core/constants.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/noise_level.hpp"

namespace dualdamp::identify {

namespace {

constexpr std::ptrdiff_t windows_in_period = 4;

/// sin^4 over a window, and its derivatives over time.
struct Weights {
  Eigen::ArrayXd own, slope, curvature;

  Weights(Eigen::Index samples, double rate) {
    const double w = std::numbers::pi * rate / static_cast<double>(samples);
    const Eigen::ArrayXd angle = Eigen::ArrayXd::LinSpaced(samples + 1, 0.0, std::numbers::pi);
    const Eigen::ArrayXd s = angle.sin();
    const Eigen::ArrayXd c = angle.cos();
    own = s.square().square();
    slope = 4.0 * w * s.cube() * c;
    curvature = 4.0 * w * w * (3.0 * s.square() * c.square() - own);
  }
};

/// 1 or -1 for the direction of x at each sample, by the means over a sixteenth of the period before and after it;
/// 0 where they differ by no more than their noise, as where the mass sticks, and beside such samples.
Eigen::ArrayXd direction_of(const Eigen::ArrayXd& x, Eigen::Index period) {
  constexpr Eigen::Index parts = 16;
  constexpr double wide = 4.0;
  constexpr double rounding = 1e-6;  // of the range of x
  const Eigen::Index by = std::max<Eigen::Index>(1, period / parts);
  const double noise = robust_noise_level({x.data(), static_cast<std::size_t>(x.size())});
  const double least =
      wide * noise * std::sqrt(2.0 / static_cast<double>(by)) + rounding * (x.maxCoeff() - x.minCoeff());
  Eigen::ArrayXd sums = Eigen::ArrayXd::Zero(x.size() + 1);
  for (Eigen::Index i = 0; i < x.size(); ++i) sums[i + 1] = sums[i] + (x[i] - x[0]);
  Eigen::ArrayXd direction = Eigen::ArrayXd::Zero(x.size());
  // A mean that reaches from a stick into the motion beside it has moved as well.
  const Eigen::Index beside = by / 2;
  Eigen::Index last_unclear = by - 1;
  for (Eigen::Index i = by; i + by < x.size(); ++i) {
    const double change = (sums[i + 1 + by] - sums[i + 1] - sums[i] + sums[i - by]) / static_cast<double>(by);
    const bool is_clear = std::abs(change) > least;
    if (is_clear && i > last_unclear + beside) direction[i] = change > 0.0 ? 1.0 : -1.0;
    if (is_clear) continue;
    // What lies before the last unclear sample is zero already.
    const Eigen::Index from = std::max(i - beside, last_unclear + 1);
    direction.segment(from, i - from + 1).setZero();
    last_unclear = i;
  }
  return direction;
}

/// Balances over windows.
struct Balances {
  /// m a + k x, then drive, -v and -sgn v, of each window.
  Eigen::MatrixXd sums;
  /// By how much friction may differ from F0 sgn v in the sum of each window: a mass that sticks is held by what
  /// the drive and the spring leave, up to the largest drive, which has set it moving.
  Eigen::ArrayXd unknown_friction;
};

/// Windows in which the mass hardly moves, or sticks for long, are left out.
Balances balances(const Eigen::ArrayXd& x, const Eigen::ArrayXd& drive, Eigen::Index period, double rate,
                  const KnownConstants& constants) {
  constexpr double little = 0.05;  // of the range of x
  constexpr double long_stick = 0.3;
  const Weights weights(period, rate);
  const Eigen::ArrayXd direction = direction_of(x, period);
  const Eigen::ArrayXd held =
      (drive - constants.stiffness * x).abs().min(drive.abs().maxCoeff()) * (1.0 - direction.abs());
  const double range = x.maxCoeff() - x.minCoeff();
  std::vector<Eigen::Vector4d> rows;
  std::vector<double> unknown;
  for (Eigen::Index i = 0; i + period < x.size(); i += std::max<Eigen::Index>(1, period / windows_in_period)) {
    const Eigen::ArrayXd part = x.segment(i, period + 1);
    const double moving = (direction.segment(i, period + 1).abs() * weights.own).sum();
    if (part.maxCoeff() - part.minCoeff() < little * range) continue;
    if (moving < (1.0 - long_stick) * weights.own.sum()) continue;
    rows.emplace_back((part * (constants.mass * weights.curvature + constants.stiffness * weights.own)).sum(),
                      (drive.segment(i, period + 1) * weights.own).sum(), (part * weights.slope).sum(),
                      -(direction.segment(i, period + 1) * weights.own).sum());
    unknown.push_back((held.segment(i, period + 1) * weights.own).sum());
  }
  const auto count = static_cast<Eigen::Index>(rows.size());
  Balances all{Eigen::MatrixXd(count, 4), Eigen::Map<const Eigen::ArrayXd>(unknown.data(), count)};
  for (Eigen::Index i = 0; i < count; ++i) all.sums.row(i) = rows[static_cast<std::size_t>(i)].transpose();
  return all;
}

}  // namespace

std::optional<double> gain_of_drive(const History& history, const KnownConstants& constants) {
  const bool is_force = !history.force.empty();
  if (is_force != history.y.empty() || history.x.empty()) return std::nullopt;
  if (!(constants.mass > 0.0) || !(constants.stiffness > 0.0)) return std::nullopt;
  const auto map = [](const std::vector<double>& signal) {
    return Eigen::Map<const Eigen::ArrayXd>(signal.data(), static_cast<Eigen::Index>(signal.size()));
  };
  const double samples = history.sample_rate * core::two_pi / constants.natural_frequency();
  constexpr double fewest = 8.0;
  constexpr double periods = 6.0;
  if (!(samples > fewest) || !(periods * samples < static_cast<double>(history.x.size()))) return std::nullopt;
  const Eigen::ArrayXd drive = (is_force ? 1.0 : constants.stiffness) * map(is_force ? history.force : history.y);
  const auto [rows, unknown_friction] = balances(
      map(history.x), drive, static_cast<Eigen::Index>(std::lround(samples)), history.sample_rate, constants);
  if (rows.rows() < static_cast<Eigen::Index>(periods)) return std::nullopt;
  const Eigen::VectorXd needed = rows.col(0);
  const Eigen::MatrixXd friction = rows.rightCols(2);
  const double all = needed.squaredNorm();
  const double missing = left_beside(friction, needed - rows.col(1)).norm() - unknown_friction.matrix().norm();
  const double as_stated = std::pow(std::max(missing, 0.0), 2);
  const Eigen::VectorXd beside = left_beside(friction, rows.col(1));
  const Eigen::VectorXd wanted = left_beside(friction, needed);
  const double share = beside.dot(wanted) / beside.squaredNorm();
  const double left = (wanted - share * beside).squaredNorm();
  constexpr double explained = 0.02;
  constexpr double missed = 0.1;
  constexpr double clearly = 0.05;  // standard error of the share over itself; windows overlap
  const double variance =
      static_cast<double>(windows_in_period) * left / static_cast<double>(rows.rows()) / beside.squaredNorm();
  const bool is_told = share > 0.0 && left < explained * all && variance < clearly * clearly * share * share;
  if (!is_told || !(as_stated > missed * all)) return std::nullopt;
  return 1.0 / share;
}

}  // namespace dualdamp::identify
