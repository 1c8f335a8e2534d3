#pragma once
/// c and F0 under one law, over its severity: fits at some severities, interpolated between them, and the region
/// that they span.

#include <functional>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/methods/any_law/law_profile.hpp"
#include "identify/methods/any_law/reading_model.hpp"
#include "identify/methods/any_law/severity_scale.hpp"

namespace dualdamp::identify {

/// Curve over one coordinate.
using Curve = std::function<double(double)>;

/// Curve through values at increasing coordinates: makima from four values on, else linear.
[[nodiscard]] Curve curve_through(std::vector<double> at, std::vector<double> values);

/// The fit at one severity, as far as regions need it.
struct SeverityPoint {
  double severity = 0.0;
  double chi2 = 0.0;
  double F0 = 0.0;  ///< N
  double c = 0.0;   ///< N.s/m
  double F0_deviation = 0.0;
  double c_deviation = 0.0;
  double log_volume = 0.0;  ///< half the logarithm of the determinant of the unknowns' covariance
};

/// The points of the fits, in the order of increasing severity, and points interpolated between them. chi2 follows
/// from interpolated residuals, so that it is a sum of squares between the fits, too.
[[nodiscard]] std::vector<SeverityPoint> severity_curve(const ReadingModel& model, SeverityScale scale,
                                                        const std::vector<SeverityFit>& fits);

/// The point of least chi2.
[[nodiscard]] const SeverityPoint& best_of(const std::vector<SeverityPoint>& points);

/// Ends of the region chi2 <= least chi2 + reach of the profile likelihood; not below zero.
[[nodiscard]] Interval region_of(const std::vector<SeverityPoint>& points, double reach,
                                 double SeverityPoint::* value, double SeverityPoint::* deviation);

}  // namespace dualdamp::identify
