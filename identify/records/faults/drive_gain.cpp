#include "identify/records/faults/drive_gain.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "core/constants.hpp"
#include "identify/statistics/decompositions.hpp"

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

/// 1, 0 or -1 for the direction of x over a sixteenth of the period around each sample.
Eigen::ArrayXd direction_of(const Eigen::ArrayXd& x, Eigen::Index period) {
  const Eigen::Index by = std::max<Eigen::Index>(1, period / 32);
  Eigen::ArrayXd direction(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double change = x[std::min(i + by, x.size() - 1)] - x[std::max<Eigen::Index>(i - by, 0)];
    direction[i] = static_cast<double>((change > 0.0) - (change < 0.0));
  }
  return direction;
}

/// Of each window: m a + k x, then drive, -v and -sgn v. Windows in which the mass hardly moves are left out.
Eigen::MatrixXd balances(const Eigen::ArrayXd& x, const Eigen::ArrayXd& drive, Eigen::Index period, double rate,
                         const KnownConstants& constants) {
  constexpr double little = 0.05;  // of the range of x
  const Weights weights(period, rate);
  const Eigen::ArrayXd direction = direction_of(x, period);
  const double range = x.maxCoeff() - x.minCoeff();
  std::vector<Eigen::Vector4d> rows;
  for (Eigen::Index i = 0; i + period < x.size(); i += std::max<Eigen::Index>(1, period / windows_in_period)) {
    const Eigen::ArrayXd part = x.segment(i, period + 1);
    if (part.maxCoeff() - part.minCoeff() < little * range) continue;
    rows.emplace_back((part * (constants.mass * weights.curvature + constants.stiffness * weights.own)).sum(),
                      (drive.segment(i, period + 1) * weights.own).sum(), (part * weights.slope).sum(),
                      -(direction.segment(i, period + 1) * weights.own).sum());
  }
  Eigen::MatrixXd all(static_cast<Eigen::Index>(rows.size()), 4);
  for (std::size_t i = 0; i < rows.size(); ++i) all.row(static_cast<Eigen::Index>(i)) = rows[i].transpose();
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
  const Eigen::MatrixXd rows = balances(map(history.x), drive, static_cast<Eigen::Index>(std::lround(samples)),
                                        history.sample_rate, constants);
  if (rows.rows() < static_cast<Eigen::Index>(periods)) return std::nullopt;
  const Eigen::VectorXd needed = rows.col(0);
  const Eigen::MatrixXd friction = rows.rightCols(2);
  const double all = needed.squaredNorm();
  const double as_stated = left_beside(friction, needed - rows.col(1)).squaredNorm();
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
