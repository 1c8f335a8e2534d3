#include "identify/methods/any_law/severity_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/constants.hpp"
#include "identify/methods/any_law/severity_curve.hpp"

namespace dualdamp::identify {

namespace {

using core::infinity;
using Eigen::Index;
using Eigen::VectorXd;

/// Largest difference of the two curves: of all readings together, and of F0 and c, in standard deviations.
constexpr double close = 0.1;
/// chi2 above the least one at which no region reaches a severity.
constexpr double out_of_region = 15.0;
constexpr std::size_t most_further_fits = 8;

/// What is interpolated: residuals, then F0 and c over their units.
VectorXd row_of(const SeverityFit& fit) {
  VectorXd row(fit.residuals.size() + 2);
  row << fit.residuals, fit.unknowns.head(2);
  return row;
}

/// The polynomial through `count` neighbouring rows from `first` on.
VectorXd polynomial(const std::vector<double>& at, const std::vector<VectorXd>& rows, std::size_t first,
                    std::size_t count, double u) {
  VectorXd sum = VectorXd::Zero(rows.front().size());
  for (std::size_t i = first; i < first + count; ++i) {
    double share = 1.0;
    for (std::size_t j = first; j < first + count; ++j)
      if (j != i) share *= (u - at[j]) / (at[i] - at[j]);
    sum += share * rows[i];
  }
  return sum;
}

/// The fits of a law over its coordinate.
class Fitted {
 public:
  Fitted(SeverityScale scale, const std::vector<SeverityFit>& fits) : fits_(fits) {
    for (const SeverityFit& fit : fits) {
      // Coordinates of negative severities fall; makima wants increasing ones.
      at_.push_back(std::abs(scale.of(fit.severity)));
      rows_.push_back(row_of(fit));
    }
    for (Index row = 0; row < rows_.front().size(); ++row) {
      std::vector<double> values;
      for (const VectorXd& one : rows_) values.push_back(one[row]);
      curves_.push_back(curve_through(at_, std::move(values)));
    }
  }

  [[nodiscard]] std::size_t cells() const { return fits_.size() - 1; }
  [[nodiscard]] double middle(std::size_t cell) const { return 0.5 * (at_[cell] + at_[cell + 1]); }

  /// Least chi2 of a cell, on its curve.
  [[nodiscard]] double least(std::size_t cell) const {
    constexpr int parts = 12;
    double least = infinity;
    for (int i = 0; i <= parts; ++i) {
      const VectorXd row = curve_at(std::lerp(at_[cell], at_[cell + 1], static_cast<double>(i) / parts));
      least = std::min(least, row.head(row.size() - 2).squaredNorm());
    }
    return least;
  }

  /// Difference of the two curves in the middle of a cell, in standard deviations.
  [[nodiscard]] double difference(std::size_t cell) const {
    if (fits_.size() < 3) return infinity;
    constexpr std::size_t cubic = 4;
    const std::size_t count = std::min(cubic, fits_.size());
    const std::size_t first = std::min(cell == 0 ? 0 : cell - 1, fits_.size() - count);
    const VectorXd apart = curve_at(middle(cell)) - polynomial(at_, rows_, first, count, middle(cell));
    const auto over_deviation = [&](Index unknown) {
      const double variance =
          0.5 * (fits_[cell].covariance(unknown, unknown) + fits_[cell + 1].covariance(unknown, unknown));
      return std::abs(apart[apart.size() - 2 + unknown]) / std::sqrt(variance);
    };
    return std::max({apart.head(apart.size() - 2).norm(), over_deviation(0), over_deviation(1)});
  }

 private:
  [[nodiscard]] VectorXd curve_at(double u) const {
    VectorXd row(rows_.front().size());
    for (Index i = 0; i < row.size(); ++i) row[i] = curves_[static_cast<std::size_t>(i)](u);
    return row;
  }

  const std::vector<SeverityFit>& fits_;
  std::vector<double> at_;
  std::vector<VectorXd> rows_;
  std::vector<Curve> curves_;
};

/// The cell with the largest difference, of those that a region may reach; nothing if the curves agree.
std::optional<std::size_t> differing(const Fitted& fitted) {
  std::vector<double> least;
  for (std::size_t cell = 0; cell < fitted.cells(); ++cell) least.push_back(fitted.least(cell));
  const double reached = *std::ranges::min_element(least) + out_of_region;
  std::optional<std::size_t> worst;
  double most = close;
  for (std::size_t cell = 0; cell < fitted.cells(); ++cell) {
    if (least[cell] > reached) continue;
    const double apart = fitted.difference(cell);
    if (apart <= most) continue;
    most = apart;
    worst = cell;
  }
  return worst;
}

}  // namespace

void refine(const ReadingModel& model, const departures::Departure& departure, const ChannelNoise& noise,
            NearbyOrbits& near, std::vector<SeverityFit>& fits) {
  if (fits.size() < 2) return;
  const SeverityScale scale(&departure);
  for (std::size_t i = 0; i < most_further_fits; ++i) {
    const Fitted fitted(scale, fits);
    const std::optional<std::size_t> cell = differing(fitted);
    if (!cell) return;
    const SeverityFit& left = fits[*cell];
    const SeverityFit& right = fits[*cell + 1];
    const double severity = scale.severity(std::copysign(fitted.middle(*cell), right.severity));
    // Few fits lie far apart: their derivatives say little of those between them.
    constexpr std::size_t few = 4;
    const bool own_slopes = fits.size() < few;
    const LawStart start{0.5 * (left.unknowns + right.unknowns), 0.5 * (left.slopes + right.slopes), own_slopes};
    std::optional<SeverityFit> fit = fit_law(model, {&departure, severity}, noise, start, near);
    if (!fit) return;
    fits.insert(fits.begin() + static_cast<std::ptrdiff_t>(*cell) + 1, *std::move(fit));
    if (!own_slopes) share_slopes(scale, *cell + 1, fits);
  }
}

}  // namespace dualdamp::identify
