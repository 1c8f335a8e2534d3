#include "identify/methods/amplitudes/line_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/constants.hpp"
#include "identify/conclusion.hpp"
#include "identify/methods/amplitudes/bootstrap.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/profile_likelihood.hpp"
#include "identify/statistics/scatter.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

// Without cancellation: welford1962, and the parallel form of the same.
void Moments::add(double Y, double x) {
  count += 1.0;
  const double dY = Y - mean_Y;
  const double dx = x - mean_x;
  mean_Y += dY / count;
  mean_x += dx / count;
  S_YY += dY * (Y - mean_Y);
  S_xY += dx * (Y - mean_Y);
  S_xx += dx * (x - mean_x);
}

void Moments::add(const Moments& other) {
  const double total = count + other.count;
  const double dY = other.mean_Y - mean_Y;
  const double dx = other.mean_x - mean_x;
  const double weight = count * other.count / total;
  S_YY += other.S_YY + weight * dY * dY;
  S_xY += other.S_xY + weight * dx * dY;
  S_xx += other.S_xx + weight * dx * dx;
  mean_Y += dY * other.count / total;
  mean_x += dx * other.count / total;
  count = total;
}

Moments moments_of(const std::vector<Datum>& pairs) {
  Moments moments;
  for (const Datum& datum : pairs) moments.add(datum.Y, datum.x);
  return moments;
}

std::optional<Line> line_of(const Moments& m, double lambda) {
  if (!(m.S_YY > 0.0)) return std::nullopt;
  double slope = m.S_xY / m.S_YY;
  if (std::isfinite(lambda)) {
    const double d = m.S_xx - lambda * m.S_YY;
    const double root = std::sqrt(d * d + 4.0 * lambda * m.S_xY * m.S_xY);
    // A root of a quadratic in two forms; each is used where its terms do not cancel.
    slope = d > 0.0 ? (d + root) / (2.0 * m.S_xY) : 2.0 * lambda * m.S_xY / (root - d);
  }
  if (!std::isfinite(slope)) return std::nullopt;
  return Line{slope, m.mean_x - slope * m.mean_Y};
}

std::optional<Scatter> scatter_of(double sum_of_squares, double freedom, double slope,
                                  const KnownDeviations& options, double unit) {
  const double sigma_x = std::max(options.sigma_x, 0.0) / unit;
  const double sigma_Y = std::max(options.sigma_Y, 0.0) / unit;
  if (sigma_x > 0.0 || sigma_Y > 0.0) {
    const double variance = sigma_x * sigma_x + slope * slope * sigma_Y * sigma_Y;
    return Scatter{variance, normal95(), freedom < 1.0 ? 1.0 : sum_of_squares / freedom / variance, true};
  }
  if (freedom < 1.0) return std::nullopt;
  return Scatter{sum_of_squares / freedom, quantile95(freedom)};
}

CurvatureColumns curvature_columns(const std::vector<Datum>& pairs) {
  const auto [least, greatest] = std::ranges::minmax_element(pairs, {}, &Datum::Y);
  const double middle = 0.5 * (least->Y + greatest->Y);
  const double range = greatest->Y - least->Y;
  const auto count = static_cast<Eigen::Index>(pairs.size());
  CurvatureColumns columns{Eigen::MatrixXd(count, 2), Eigen::VectorXd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const double u = (pairs[static_cast<std::size_t>(i)].Y - middle) / range;
    columns.line.row(i) << 1.0, u;
    columns.square[i] = u * u;
  }
  return columns;
}

double output_range(const std::vector<Datum>& pairs) {
  const auto [least, greatest] = std::ranges::minmax_element(pairs, {}, &Datum::x);
  return greatest->x - least->x;
}

namespace {

using Blocks = std::vector<std::vector<std::size_t>>;

void take_out_means(Eigen::Ref<Eigen::VectorXd> column, const Blocks& blocks) {
  for (const std::vector<std::size_t>& block : blocks) {
    double mean = 0.0;
    for (const std::size_t i : block)
      mean += column[static_cast<Eigen::Index>(i)] / static_cast<double>(block.size());
    for (const std::size_t i : block) column[static_cast<Eigen::Index>(i)] -= mean;
  }
}

/// Residuals of x about the parallel lines of the blocks.
Eigen::VectorXd residuals_of(const std::vector<Datum>& pairs, const Blocks& blocks) {
  Eigen::VectorXd Y(static_cast<Eigen::Index>(pairs.size()));
  Eigen::VectorXd x(Y.size());
  for (Eigen::Index i = 0; i < Y.size(); ++i) {
    Y[i] = pairs[static_cast<std::size_t>(i)].Y;
    x[i] = pairs[static_cast<std::size_t>(i)].x;
  }
  take_out_means(Y, blocks);
  take_out_means(x, blocks);
  return x - Y.dot(x) / Y.squaredNorm() * Y;
}

/// The input as a function of the output, as in the balance of forces.
std::vector<Datum> turned(std::vector<Datum> pairs) {
  for (Datum& datum : pairs) std::swap(datum.Y, datum.x);
  return pairs;
}

/// Variance of the slope when x - a - b Y has the variance `scatter`.
double slope_variance(const Moments& m, const Line& line, double lambda, double scatter) {
  const double S = m.S_xY / line.slope;
  if (!std::isfinite(lambda)) return scatter / S;
  const double width = lambda + line.slope * line.slope;
  return scatter / S * (1.0 + (m.count - 1.0) * scatter * lambda / (width * width * S));
}

}  // namespace

std::optional<LackOfFit> friction_curvature_test(const std::vector<Datum>& pairs, const std::vector<Datum>& exact,
                                                 const Blocks& sweeps) {
  std::vector<Datum> balance = turned(pairs);
  if (!exact.empty()) {
    const Eigen::VectorXd departure = residuals_of(turned(exact), sweeps);
    for (std::size_t i = 0; i < balance.size(); ++i) balance[i].x -= departure[static_cast<Eigen::Index>(i)];
  }
  CurvatureColumns columns = curvature_columns(balance);
  take_out_means(columns.line.col(1), sweeps);
  take_out_means(columns.square, sweeps);
  // The constant column is one of the heights; the other heights cost further degrees of freedom.
  return added_term_test(columns.line, residuals_of(balance, sweeps), columns.square, output_range(balance),
                         "quadratic friction F-test", static_cast<int>(sweeps.size()) - 1);
}

namespace {

/// A line with its pairs and its results.
struct FittedLine {
  Moments moments;
  double lambda = 0.0;
  Line line;
  LineFriction friction;
  Eigen::VectorXd residuals;  ///< x - a - b Y

  [[nodiscard]] double freedom() const { return moments.count - 2.0; }
};

/// The pairs that do not stick, in order of their numbers.
std::vector<Datum> sliding_pairs(const LineRule& rule, const ResonanceData& data, Estimate& estimate) {
  // Moments of all upper ends of the list in one pass, so that many rounds of leaving out stay cheap.
  std::vector<std::optional<Line>> lines(data.pairs.size());
  Moments moments;
  for (std::size_t i = data.pairs.size(); i-- > 0;) {
    moments.add(data.pairs[i].Y, data.pairs[i].x);
    lines[i] = line_of(moments, rule.lambda(moments));
  }
  const std::size_t first = first_sliding_pair(data, [&lines](std::size_t i) { return lines[i]; }, estimate);
  std::vector<Datum> left(data.pairs.begin() + static_cast<std::ptrdiff_t>(first), data.pairs.end());
  std::ranges::sort(left, {}, &Datum::number);
  return left;
}

Eigen::VectorXd residuals_of(const std::vector<Datum>& pairs, const Line& line) {
  Eigen::VectorXd residuals(static_cast<Eigen::Index>(pairs.size()));
  for (std::size_t i = 0; i < pairs.size(); ++i)
    residuals[static_cast<Eigen::Index>(i)] = pairs[i].x - (line.intercept + line.slope * pairs[i].Y);
  return residuals;
}

std::optional<FittedLine> fit_line(const LineRule& rule, const ResonanceData& data,
                                   const std::vector<Datum>& used) {
  FittedLine fit;
  fit.moments = moments_of(used);
  fit.lambda = rule.lambda(fit.moments);
  const std::optional<Line> line = line_of(fit.moments, fit.lambda);
  const std::optional<LineFriction> friction = line ? friction_of(*line, data.G) : std::nullopt;
  if (!friction) return std::nullopt;
  fit.line = *line;
  fit.friction = *friction;
  fit.residuals = residuals_of(used, fit.line);
  return fit;
}

LineFit line_fit(const FittedLine& fit, double unit) {
  const double deviation = fit.freedom() > 0.0 ? std::sqrt(fit.residuals.squaredNorm() / fit.freedom()) : 0.0;
  LineFit line{fit.line.slope, fit.line.intercept * unit, deviation * unit, fit.friction.G, {}};
  line.residuals.reserve(static_cast<std::size_t>(fit.residuals.size()));
  for (const double residual : fit.residuals) line.residuals.push_back(residual * unit);
  return line;
}

/// Covariance of (zeta, x_f): the height of the line at the mean input and its slope are uncorrelated.
Eigen::Matrix2d covariance(const FittedLine& fit, const ResonanceG& G, double scatter) {
  const LineFriction& friction = fit.friction;
  const double zeta_slope = -2.0 * friction.zeta * friction.zeta;  // d zeta/d b
  const double G_slope = G.derivative(friction.zeta) * zeta_slope;
  Eigen::Matrix2d jacobian;  // of (zeta, x_f) with respect to (height, slope)
  jacobian << 0.0, zeta_slope, -1.0 / friction.G,
      fit.moments.mean_Y / friction.G + fit.line.intercept * G_slope / (friction.G * friction.G);
  const Eigen::Vector2d variance(scatter / fit.moments.count,
                                 slope_variance(fit.moments, fit.line, fit.lambda, scatter));
  return jacobian * variance.asDiagonal() * jacobian.transpose();
}

void test_line_curvature(const std::vector<Datum>& used, const std::vector<Datum>& exact, Estimate& estimate) {
  std::vector<std::size_t> all(used.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  estimate.lack_of_fit = friction_curvature_test(used, exact, {all});
  if (estimate.lack_of_fit && estimate.lack_of_fit->fired) {
    estimate.findings.emplace_back(
        "the pairs do not lie on a straight line, so no single zeta and F0 describes them "
        "(see the fits of their lower parts)");
  }
}

/// Fits of all and of the lower 4/5, 3/5 and 2/5 of the pairs; pairs of equal input stay together.
std::vector<SubsetFit> subset_fits(const LineRule& rule, const ResonanceData& data, std::vector<Datum> pairs) {
  std::vector<SubsetFit> fits;
  if (pairs.size() < 5) return fits;
  std::ranges::sort(pairs, {}, [](const Datum& datum) { return std::pair(datum.Y, datum.number); });
  for (int fifths = 5; fifths >= 2; --fifths) {
    auto count = static_cast<std::size_t>(std::lround(static_cast<double>(pairs.size()) * fifths / 5.0));
    while (count < pairs.size() && pairs[count].Y == pairs[count - 1].Y) ++count;
    const std::vector<Datum> lower(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(count));
    const Moments moments = moments_of(lower);
    const std::optional<Line> line = line_of(moments, rule.lambda(moments));
    const std::optional<LineFriction> friction = line ? friction_of(*line, data.G) : std::nullopt;
    if (!friction) continue;
    fits.push_back({std::to_string(fifths) + "/5", static_cast<int>(count),
                    parameters(friction->zeta, friction->x_f * data.unit, data.constants)});
  }
  return fits;
}

/// The weighted sum of squares above its smallest value, in units of the variance of one datum.
Deviance deviance_of(const FittedLine& fit, const ResonanceData& data, double scatter) {
  const auto sum = [m = fit.moments, lambda = fit.lambda](double b, double a) {
    const double height = m.mean_x - a - b * m.mean_Y;
    const double squares = m.count * height * height + m.S_xx - 2.0 * b * m.S_xY + b * b * m.S_YY;
    return std::isfinite(lambda) ? squares / (lambda + b * b) : squares;
  };
  const double unit =
      std::isfinite(fit.lambda) ? scatter / (fit.lambda + fit.line.slope * fit.line.slope) : scatter;
  return [=, least = sum(fit.line.slope, fit.line.intercept), G = data.G, length = data.unit](double zeta,
                                                                                              double x_f) {
    if (!(zeta > 0.0)) return core::infinity;
    return (sum(0.5 / zeta, -G.value(zeta) * x_f / length) - least) / unit;
  };
}

/// Draws whole sweeps; only the sums of a sweep are needed.
Replicate sweep_replicate(const LineRule& rule, const ResonanceData& data, std::vector<Moments> sweeps) {
  return [&rule, &data, sweeps = std::move(sweeps)](Draws& draws) -> std::optional<Eigen::Vector2d> {
    Moments moments;
    for (std::size_t i = 0; i < sweeps.size(); ++i) moments.add(sweeps[draws.below(sweeps.size())]);
    const std::optional<Line> line = line_of(moments, rule.lambda(moments));
    const std::optional<LineFriction> friction = line ? friction_of(*line, data.G) : std::nullopt;
    if (!friction) return std::nullopt;
    return Eigen::Vector2d(friction->zeta, friction->x_f * data.unit);
  };
}

/// Each pair is moved to the line along the direction of its errors, and the residual of a drawn pair is added
/// there.
Replicate residual_replicate(const FittedLine& fit, const ResonanceData& data, const std::vector<Datum>& used) {
  const double share = std::isfinite(fit.lambda) ? fit.line.slope / (fit.lambda + fit.line.slope * fit.line.slope)
                                                 : 0.0;  // share of a residual that is added to the input
  const double widen = std::sqrt(fit.moments.count / std::max(fit.freedom(), 1.0));
  return [&fit, &data, &used, share, widen](Draws& draws) -> std::optional<Eigen::Vector2d> {
    Moments moments;
    for (std::size_t i = 0; i < used.size(); ++i) {
      const double drawn = widen * fit.residuals[static_cast<Eigen::Index>(draws.below(used.size()))];
      const double Y = used[i].Y + share * fit.residuals[static_cast<Eigen::Index>(i)];
      moments.add(Y - share * drawn, fit.line.intercept + fit.line.slope * (Y - share * drawn) + drawn);
    }
    const std::optional<Line> line = line_of(moments, fit.lambda);
    const std::optional<LineFriction> friction = line ? friction_of(*line, data.G) : std::nullopt;
    if (!friction) return std::nullopt;
    return Eigen::Vector2d(friction->zeta, friction->x_f * data.unit);
  };
}

void bootstrap(const LineRule& rule, const FittedLine& fit, const ResonanceData& data,
               const std::vector<Datum>& used, int replicates, Estimate& estimate) {
  std::vector<Moments> sweeps;
  for (const std::vector<std::size_t>& block : sweep_blocks(used)) {
    Moments moments;
    for (const std::size_t i : block) moments.add(used[i].Y, used[i].x);
    sweeps.push_back(moments);
  }
  const std::size_t count = sweeps.size();
  add_bootstrap(estimate, replicates, count, data.constants,
                count > 1 ? sweep_replicate(rule, data, std::move(sweeps)) : residual_replicate(fit, data, used));
}

}  // namespace

Estimate estimate_by_line(const LineRule& rule, const Record& record, const KnownConstants& constants,
                          const LineOptions& options) {
  Estimate estimate;
  estimate.method = rule.method;
  const std::optional<ResonanceData> data = prepare(record, constants, options, estimate);
  if (!data) return estimate;
  const std::vector<Datum> used = sliding_pairs(rule, *data, estimate);
  if (std::string fault = fault_of(used, record.pairs->pairs.size(), estimate.excluded); !fault.empty()) {
    refuse(estimate, std::move(fault));
    return estimate;
  }
  const std::optional<FittedLine> fit = fit_line(rule, *data, used);
  if (!fit) {
    refuse(estimate, "the output amplitude does not grow with the input amplitude");
    return estimate;
  }
  estimate.value = parameters(fit->friction.zeta, fit->friction.x_f * data->unit, constants);
  estimate.used = numbers_of(used);
  estimate.line = line_fit(*fit, data->unit);
  const auto scatter =
      scatter_of(fit->residuals.squaredNorm(), fit->freedom(), fit->line.slope, options, data->unit);
  if (scatter) {
    const Eigen::DiagonalMatrix<double, 2> to_metres(1.0, data->unit);
    set_uncertainty(estimate, to_metres * covariance(*fit, data->G, scatter->variance) * to_metres,
                    scatter->half_width, constants);
    warn_of_scatter(scatter->ratio, fit->freedom(), estimate);
  }

  std::vector<std::string> faults;
  judge_signs(estimate, fit->moments.mean_Y * data->unit, faults);
  const std::vector<Datum> exact = exact_pairs(*data, used, fit->friction);
  test_line_curvature(used, exact, estimate);
  const auto line_through = [&](const std::vector<Datum>& pairs) {
    return line_of(moments_of(pairs), fit->lambda);
  };
  estimate.subsets = subset_fits(rule, *data, used);
  if (options.profile && scatter)
    add_profiles(estimate, deviance_of(*fit, *data, scatter->variance), scatter->half_width, constants);
  if (options.bootstrap > 0) bootstrap(rule, *fit, *data, used, options.bootstrap, estimate);
  // After the profiles and replicates, which are those of the uncorrected estimate.
  judge_method(*data, exact, fit->friction, line_through, estimate, faults);
  conclude(estimate, faults,
           "rests on " + std::to_string(used.size()) + " of " + std::to_string(record.pairs->pairs.size()) +
               " pairs at " + frequency_text(*data));
  return estimate;
}

}  // namespace dualdamp::identify
