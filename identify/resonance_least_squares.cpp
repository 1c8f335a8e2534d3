#include "identify/resonance_least_squares.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "identify/resonance_line.hpp"
#include "identify/statistics.hpp"

namespace dualdamp::identify {

namespace {

/// Sums of a straight-line fit, about the means.
struct Moments {
  double count = 0.0;
  double mean_Y = 0.0;
  double mean_x = 0.0;
  double S_YY = 0.0;
  double S_xY = 0.0;

  /// Takes one more pair in, without cancellation (Welford).
  void add(const Datum& datum) {
    count += 1.0;
    const double dY = datum.Y - mean_Y;
    mean_Y += dY / count;
    mean_x += (datum.x - mean_x) / count;
    S_YY += dY * (datum.Y - mean_Y);
    S_xY += dY * (datum.x - mean_x);
  }

  [[nodiscard]] std::optional<Line> line() const {
    if (!(S_YY > 0.0)) return std::nullopt;
    const double slope = S_xY / S_YY;
    return Line{slope, mean_x - slope * mean_Y};
  }
};

Moments moments_of(const std::vector<Datum>& pairs) {
  Moments moments;
  for (const Datum& datum : pairs) moments.add(datum);
  return moments;
}

std::optional<Line> line_through(const std::vector<Datum>& pairs) { return moments_of(pairs).line(); }

/// The pairs that do not stick, in order of their numbers.
std::vector<Datum> sliding_pairs(const ResonanceData& data, Estimate& estimate) {
  // Lines of all upper ends of the list in one pass, so that a gate of many rounds stays cheap.
  std::vector<std::optional<Line>> lines(data.pairs.size());
  Moments moments;
  for (std::size_t i = data.pairs.size(); i-- > 0;) {
    moments.add(data.pairs[i]);
    lines[i] = moments.line();
  }
  const std::size_t first = first_sliding_pair(data, [&lines](std::size_t i) { return lines[i]; }, estimate);
  std::vector<Datum> left(data.pairs.begin() + static_cast<std::ptrdiff_t>(first), data.pairs.end());
  std::sort(left.begin(), left.end(), [](const Datum& a, const Datum& b) { return a.number < b.number; });
  return left;
}

Eigen::VectorXd residuals_of(const std::vector<Datum>& pairs, const Line& line) {
  Eigen::VectorXd residuals(static_cast<Eigen::Index>(pairs.size()));
  for (std::size_t i = 0; i < pairs.size(); ++i)
    residuals[static_cast<Eigen::Index>(i)] = pairs[i].x - (line.intercept + line.slope * pairs[i].Y);
  return residuals;
}

/// How the exact law departs from its own line: a curvature that speaks for the law and not against it.
Eigen::VectorXd exact_residuals(const std::vector<Datum>& exact, Eigen::Index count) {
  const std::optional<Line> line = line_through(exact);
  return line ? residuals_of(exact, *line) : Eigen::VectorXd::Zero(count);
}

/// Covariance of (zeta, x_f) for unit variance of one output: the mean of x and the slope are uncorrelated.
Eigen::Matrix2d unit_covariance(const Moments& moments, const Line& line, const LineFriction& friction,
                                const ResonanceG& G) {
  const double zeta_slope = -2.0 * friction.zeta * friction.zeta;  // d zeta/d b
  const double G_slope = G.derivative(friction.zeta) * zeta_slope;
  Eigen::Matrix2d jacobian;  // of (zeta, x_f) with respect to (mean x, slope)
  jacobian << 0.0, zeta_slope, -1.0 / friction.G,
      moments.mean_Y / friction.G + line.intercept * G_slope / (friction.G * friction.G);
  const Eigen::Vector2d variance(1.0 / moments.count, 1.0 / moments.S_YY);
  return jacobian * variance.asDiagonal() * jacobian.transpose();
}

/// Variance of one output and the half width of the interval; nothing when neither residuals nor options give one.
struct Scatter {
  double variance = 0.0;
  double half_width = 0.0;
};

std::optional<Scatter> scatter_of(const Eigen::VectorXd& residuals, double slope, const MethodOptions& options,
                                  double unit) {
  const double sigma_x = std::max(options.sigma_x, 0.0) / unit;
  const double sigma_Y = std::max(options.sigma_Y, 0.0) / unit;
  if (sigma_x > 0.0 || sigma_Y > 0.0) {
    return Scatter{sigma_x * sigma_x + slope * slope * sigma_Y * sigma_Y,
                   quantile95(std::numeric_limits<double>::infinity())};
  }
  const auto freedom = static_cast<double>(residuals.size() - 2);
  if (freedom < 1.0) return std::nullopt;
  return Scatter{residuals.squaredNorm() / freedom, quantile95(freedom)};
}

void test_curvature(const std::vector<Datum>& pairs, const Eigen::VectorXd& residuals, Estimate& estimate,
                    std::vector<std::string>& faults) {
  const auto by_Y = [](const Datum& a, const Datum& b) { return a.Y < b.Y; };
  const auto by_x = [](const Datum& a, const Datum& b) { return a.x < b.x; };
  const auto [least, greatest] = std::minmax_element(pairs.begin(), pairs.end(), by_Y);
  const auto [lowest, highest] = std::minmax_element(pairs.begin(), pairs.end(), by_x);
  const auto count = static_cast<Eigen::Index>(pairs.size());
  Eigen::MatrixXd columns(count, 2);
  Eigen::VectorXd square(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double middle = 0.5 * (least->Y + greatest->Y);
    const double u = (pairs[static_cast<std::size_t>(i)].Y - middle) / (greatest->Y - least->Y);
    columns.row(i) << 1.0, u;
    square[i] = u * u;
  }
  estimate.lack_of_fit =
      added_term_test(columns, residuals, square, highest->x - lowest->x, "quadratic term F-test");
  if (estimate.lack_of_fit && estimate.lack_of_fit->fired) {
    faults.emplace_back(
        "the pairs do not lie on a straight line, so no single zeta and F0 describes them "
        "(see the fits of their lower parts)");
  }
}

/// Fits of all and of the lower 4/5, 3/5 and 2/5 of the pairs; pairs of equal input stay together.
std::vector<SubsetFit> subset_fits(const ResonanceData& data, std::vector<Datum> pairs) {
  std::vector<SubsetFit> fits;
  if (pairs.size() < 5) return fits;
  std::stable_sort(pairs.begin(), pairs.end(), [](const Datum& a, const Datum& b) { return a.Y < b.Y; });
  for (int fifths = 5; fifths >= 2; --fifths) {
    auto count = static_cast<std::size_t>(std::lround(static_cast<double>(pairs.size()) * fifths / 5.0));
    while (count < pairs.size() && pairs[count].Y == pairs[count - 1].Y) ++count;
    const std::vector<Datum> lower(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(count));
    const std::optional<Line> line = line_through(lower);
    const std::optional<LineFriction> friction = line ? friction_of(*line, data.G) : std::nullopt;
    if (!friction) continue;
    fits.push_back({std::to_string(fifths) + "/5", static_cast<int>(count),
                    parameters(friction->zeta, friction->x_f * data.unit, data.constants)});
  }
  return fits;
}

}  // namespace

Estimate resonance_least_squares(const Record& record, const KnownConstants& constants,
                                 const MethodOptions& options) {
  Estimate estimate;
  estimate.method = "resonance_least_squares";
  const std::optional<ResonanceData> data = prepare(record, constants, options, estimate);
  if (!data) return estimate;
  const std::vector<Datum> used = sliding_pairs(*data, estimate);
  if (std::string fault = fault_of(used, record.pairs->pairs.size(), estimate.excluded); !fault.empty()) {
    refuse(estimate, std::move(fault));
    return estimate;
  }
  const Moments moments = moments_of(used);
  const std::optional<Line> line = moments.line();
  const std::optional<LineFriction> friction = line ? friction_of(*line, data->G) : std::nullopt;
  if (!friction) {
    refuse(estimate, "the output amplitude does not grow with the input amplitude");
    return estimate;
  }
  estimate.value = parameters(friction->zeta, friction->x_f * data->unit, constants);
  estimate.used = numbers_of(used);
  const Eigen::VectorXd residuals = residuals_of(used, *line);
  const auto freedom = static_cast<double>(residuals.size() - 2);
  const double deviation = freedom > 0.0 ? std::sqrt(residuals.squaredNorm() / freedom) : 0.0;
  estimate.line = LineFit{line->slope, line->intercept * data->unit, deviation * data->unit, friction->G, {}};
  for (const double residual : residuals) estimate.line->residuals.push_back(residual * data->unit);
  if (const auto scatter = scatter_of(residuals, line->slope, options, data->unit)) {
    const Eigen::DiagonalMatrix<double, 2> to_metres(1.0, data->unit);
    const Eigen::Matrix2d covariance = scatter->variance * unit_covariance(moments, *line, *friction, data->G);
    set_uncertainty(estimate, to_metres * covariance * to_metres, scatter->half_width, constants);
  }

  std::vector<std::string> faults;
  judge_signs(estimate, 1e-9 * moments.mean_Y * data->unit, faults);
  const std::vector<Datum> exact = exact_pairs(*data, used, *friction);
  test_curvature(used, residuals - exact_residuals(exact, residuals.size()), estimate, faults);
  judge_method(*data, exact, *friction, line_through, estimate, faults);
  estimate.subsets = subset_fits(*data, used);
  conclude(estimate, faults,
           "rests on " + std::to_string(used.size()) + " of " + std::to_string(record.pairs->pairs.size()) +
               " pairs at " + frequency_text(*data));
  return estimate;
}

}  // namespace dualdamp::identify
