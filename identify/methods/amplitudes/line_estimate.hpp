#pragma once
/// What the straight-line resonance methods share: the line itself and everything an estimate by it reports.
///
/// Pairs with independent errors of x and Y, lambda = var(x error)/var(Y error). The line that is most likely with
/// normal errors (Deming) needs the moments of the pairs alone:
///
///   b = [d + sqrt(d^2 + 4 lambda S_xY^2)]/(2 S_xY),   d = S_xx - lambda S_YY,   a = mean x - b mean Y
///
/// lambda = infinity is the ordinary least-squares line, errors in x alone. With v the variance of x - a - b Y,
///
///   var(a + b mean Y) = v/n,   var(b) = v/S [1 + (n - 1) v lambda/((lambda + b^2)^2 S)],   S = S_xY/b,
///
/// the two uncorrelated. Source: deming1943, fuller1987 (section 1.3). Cost: n log n for the gate, else linear.

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "identify/methods/amplitudes/resonance_line.hpp"

namespace dualdamp::identify {

/// Sums about the means, in the unit of the data.
struct Moments {
  double count = 0.0;
  double mean_Y = 0.0;
  double mean_x = 0.0;
  double S_YY = 0.0;
  double S_xY = 0.0;
  double S_xx = 0.0;

  void add(double Y, double x);
  void add(const Moments& other);
};

[[nodiscard]] Moments moments_of(const std::vector<Datum>& pairs);

/// Nothing when the inputs, or the outputs, are all equal.
[[nodiscard]] std::optional<Line> line_of(const Moments& moments, double lambda);

/// Variance of x - a - b Y and the half width of a 95 % interval in standard errors.
struct Scatter {
  double variance = 0.0;
  double half_width = 0.0;
  double ratio = 1.0;  ///< mean square of the residuals over a stated variance
  bool is_stated = false;
};

/// From the standard deviations in `options` if one is given, otherwise from the residuals with `freedom` degrees
/// of freedom; nothing without either.
[[nodiscard]] std::optional<Scatter> scatter_of(double sum_of_squares, double freedom, double slope,
                                                const KnownDeviations& options, double unit);

/// Columns of the test for curvature: 1 and u, and separately u^2, where u is the input over the range of inputs.
struct CurvatureColumns {
  Eigen::MatrixXd line;
  Eigen::VectorXd square;
};
[[nodiscard]] CurvatureColumns curvature_columns(const std::vector<Datum>& pairs);

/// Largest output less smallest output.
[[nodiscard]] double output_range(const std::vector<Datum>& pairs);

/// Tests whether a friction term quadratic in x describes the pairs better than Coulomb and viscous friction alone.
/// At resonance the balance of the fundamental is k Y = Phi(x): a term in x^2 is added to the line of Y over x,
/// with a height of its own for each of `sweeps` (indices of `pairs`), and tested by F. First the departure of the
/// exact law (`exact`, in the order of `pairs`; may be empty) from such a line is subtracted from Y, because it
/// does not count against the law. The errors of x are errors of the regressors: if they are small beside the range
/// of x, the test keeps its level (docs/theory.md, section 4).
[[nodiscard]] std::optional<LackOfFit> friction_curvature_test(const std::vector<Datum>& pairs,
                                                               const std::vector<Datum>& exact,
                                                               const std::vector<std::vector<std::size_t>>& sweeps);

/// One method of the family: its name, and lambda for pairs with these moments.
struct LineRule {
  std::string_view method;
  std::function<double(const Moments&)> lambda;
};

/// Prepares the record, leaves out pairs that stick, fits the line, reports it, and tests it.
[[nodiscard]] Estimate estimate_by_line(const LineRule& rule, const Record& record, const KnownConstants& constants,
                                        const LineOptions& options);

}  // namespace dualdamp::identify
