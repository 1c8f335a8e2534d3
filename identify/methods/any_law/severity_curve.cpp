#include "identify/methods/any_law/severity_curve.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <boost/math/interpolators/makima.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "core/constants.hpp"

namespace dualdamp::identify {

namespace {

SeverityPoint severity_point(const ReadingModel& model, const SeverityFit& fit) {
  constexpr double least = std::numeric_limits<double>::min();
  return {fit.severity,
          fit.chi2,
          fit.unknowns[0] * model.F0_unit(),
          fit.unknowns[1] * model.c_unit(),
          std::sqrt(fit.covariance(0, 0)) * model.F0_unit(),
          std::sqrt(fit.covariance(1, 1)) * model.c_unit(),
          0.5 * std::log(std::max(fit.covariance.determinant(), least))};
}

/// Points between two fits: at least `fewest`, and so many that the readings move by a fraction of their deviation
/// from one to the next. Otherwise the best severity might lie between two points.
int parts_between(const SeverityFit& left, const SeverityFit& right) {
  constexpr double fewest = 24.0;
  constexpr double most = 480.0;
  constexpr double per_deviation = 3.0;
  return static_cast<int>(std::clamp(per_deviation * (right.residuals - left.residuals).norm(), fewest, most));
}

}  // namespace

Curve curve_through(std::vector<double> at, std::vector<double> values) {
  constexpr std::size_t fewest = 4;
  if (at.size() >= fewest) {
    using Makima = boost::math::interpolators::makima<std::vector<double>>;
    const auto curve = std::make_shared<Makima>(std::move(at), std::move(values));
    return [curve](double s) { return (*curve)(s); };
  }
  return [at, values](double s) {
    const auto right = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(std::ranges::upper_bound(at, s) - at.begin(), 1, std::ssize(at) - 1));
    return std::lerp(values[right - 1], values[right], (s - at[right - 1]) / (at[right] - at[right - 1]));
  };
}

std::vector<SeverityPoint> severity_curve(const ReadingModel& model, SeverityScale scale,
                                          const std::vector<SeverityFit>& fits) {
  if (fits.size() < 2) return {severity_point(model, fits.front())};
  std::vector<double> at;
  std::vector<SeverityPoint> known;
  for (const SeverityFit& fit : fits) {
    at.push_back(scale.of(fit.severity));
    known.push_back(severity_point(model, fit));
  }
  const auto curve = [&](const auto& value_of) {
    std::vector<double> values;
    for (std::size_t i = 0; i < fits.size(); ++i) values.push_back(value_of(i));
    return curve_through(at, values);
  };
  const auto member = [&](double SeverityPoint::* one) {
    return curve([&](std::size_t i) { return known[i].*one; });
  };
  using Point = SeverityPoint;
  const Curve F0 = member(&Point::F0);
  const Curve c = member(&Point::c);
  const Curve F0_deviation = member(&Point::F0_deviation);
  const Curve c_deviation = member(&Point::c_deviation);
  const Curve log_volume = member(&Point::log_volume);
  std::vector<Curve> residuals;
  for (Eigen::Index row = 0; row < fits.front().residuals.size(); ++row)
    residuals.push_back(curve([&](std::size_t i) { return fits[i].residuals[row]; }));
  std::vector<SeverityPoint> all;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const int parts = parts_between(fits[i], fits[i + 1]);
    for (int j = 0; j < parts; ++j) {
      const double u = std::lerp(at[i], at[i + 1], static_cast<double>(j) / parts);
      double chi2 = 0.0;
      for (const Curve& residual : residuals) chi2 += std::pow(residual(u), 2);
      all.push_back({scale.severity(u), chi2, F0(u), c(u), F0_deviation(u), c_deviation(u), log_volume(u)});
    }
  }
  all.push_back(known.back());
  return all;
}

const SeverityPoint& best_of(const std::vector<SeverityPoint>& points) {
  return *std::ranges::min_element(points, {}, &SeverityPoint::chi2);
}

Interval region_of(const std::vector<SeverityPoint>& points, double reach, double SeverityPoint::* value,
                   double SeverityPoint::* deviation) {
  const double least = best_of(points).chi2;
  Interval ends{core::infinity, -core::infinity};
  for (const SeverityPoint& point : points) {
    const double room = reach - (point.chi2 - least);
    if (room < 0.0) continue;
    const double half = std::sqrt(room) * point.*deviation;
    ends[0] = std::min(ends[0], point.*value - half);
    ends[1] = std::max(ends[1], point.*value + half);
  }
  // A force and a damping are not negative.
  ends[0] = std::max(ends[0], 0.0);
  return ends;
}

}  // namespace dualdamp::identify
