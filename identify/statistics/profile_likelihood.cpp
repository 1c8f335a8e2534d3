#include "identify/statistics/profile_likelihood.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>

#include "core/constants.hpp"
#include "core/numbers.hpp"

namespace dualdamp::identify {

namespace {

using core::infinity;

struct Point {
  double value = 0.0;
  double other = 0.0;  ///< of the best fit
  double deviance = 0.0;
};

/// The profile of one parameter; the other one follows the ridge.
class Profile {
 public:
  struct Parameter {
    double value = 0.0;
    double deviation = 0.0;
  };

  /// `deviance` of (own, other).
  Profile(Parameter own, Parameter other, double correlation, Deviance deviance, double half_width)
      : own_(own), other_(other), correlation_(correlation), deviance_(std::move(deviance)), limit_(half_width) {}

  /// Points from the estimate to where the deviance has passed its limit, or at most `most_steps`.
  [[nodiscard]] std::vector<Point> side(double sign) const {
    std::vector<Point> points;
    double other = other_.value;
    double drift = sign * step * limit_ * correlation_ * other_.deviation;
    for (int i = 1; i <= most_steps; ++i) {
      const double value = own_.value + sign * step * limit_ * i * own_.deviation;
      const Point point = best(value, other + drift);
      if (!std::isfinite(point.deviance)) break;
      drift = point.other - other;
      other = point.other;
      points.push_back(point);
      if (point.deviance > beyond * limit_ * limit_) break;
    }
    return points;
  }

  /// Where the deviance reaches its limit. Its square root is nearly linear, so false position needs few rounds.
  [[nodiscard]] std::optional<double> end(const std::vector<Point>& side) const {
    Point inner{own_.value, other_.value, 0.0};
    for (const Point& outer : side) {
      if (root_of(outer) >= limit_) return between(inner, outer);
      inner = outer;
    }
    return std::nullopt;
  }

 private:
  static constexpr double step = 0.1;    // of the half width of the symmetric interval
  static constexpr double beyond = 1.5;  // the curve goes to this many times the limit of the deviance
  static constexpr int most_steps = 60;

  static double root_of(const Point& point) { return std::sqrt(std::max(point.deviance, 0.0)); }

  [[nodiscard]] double between(Point inner, Point outer) const {
    double value = outer.value;
    for (int i = 0; i < 4; ++i) {
      const double fraction = (limit_ - root_of(inner)) / (root_of(outer) - root_of(inner));
      value = inner.value + (outer.value - inner.value) * fraction;
      const Point point = best(value, inner.other + (outer.other - inner.other) * fraction);
      (root_of(point) >= limit_ ? outer : inner) = point;
      if (!(root_of(outer) > root_of(inner))) break;
    }
    return value;
  }

  [[nodiscard]] Point best(double value, double guess) const {
    const auto along = [&](double other) { return deviance_(value, other); };
    // Scatter of the other parameter at the best fit; the first guess is better than that.
    const double width = other_.deviation * std::max(std::sqrt(1.0 - correlation_ * correlation_), 1e-3) + 1e-300;
    double reach = 4.0 * limit_ * width;
    constexpr int digits = 26;
    for (int i = 0; i < 20; ++i, reach *= 2.0) {
      const auto [other, deviance] =
          boost::math::tools::brent_find_minima(along, guess - reach, guess + reach, digits);
      if (std::abs(other - guess) < 0.9 * reach) return {value, other, deviance};
      guess = other;
    }
    return {value, guess, infinity};
  }

  Parameter own_;
  Parameter other_;
  double correlation_;
  Deviance deviance_;
  double limit_;
};

struct Names {
  std::string own, own_unit, other, other_unit;
};

void add_profile(Estimate& estimate, const Profile& profile, const Profile::Parameter& own, double other,
                 const Names& names, const Interval& symmetric) {
  std::vector<Point> points = profile.side(-1.0);
  const std::optional<double> low = profile.end(points);
  std::ranges::reverse(points);
  points.push_back({own.value, other, 0.0});
  const std::vector<Point> right = profile.side(1.0);
  const std::optional<double> high = profile.end(right);
  points.insert(points.end(), right.begin(), right.end());

  EstimateCurve curve{"profile_" + names.own,
                      {{names.own, names.own_unit, {}}, {names.other, names.other_unit, {}}, {"deviance", "", {}}}};
  for (const Point& point : points) {
    curve.columns[0].values.push_back(point.value);
    curve.columns[1].values.push_back(point.other);
    curve.columns[2].values.push_back(point.deviance);
  }
  FurtherParameter parameter{curve.name, names.own_unit, own.value, std::nullopt, std::nullopt};
  estimate.curves.push_back(std::move(curve));
  if (!low || !high) {
    estimate.warnings.push_back("the likelihood of " + names.own + " has no " + (low ? "upper" : "lower") +
                                " end of a 95 % interval: the data do not bound it");
  } else {
    parameter.interval95 = {*low, *high};
    const double difference = std::max(std::abs(*low - symmetric[0]), std::abs(*high - symmetric[1]));
    if (difference > 0.1 * (symmetric[1] - symmetric[0]))
      estimate.warnings.push_back("the likelihood's 95 % interval of " + names.own + ", " +
                                  core::format_number(*low, 4) + " to " + core::format_number(*high, 4) +
                                  ", is not the symmetric one");
  }
  estimate.others.push_back(std::move(parameter));
}

}  // namespace

void add_profiles(Estimate& estimate, const Deviance& deviance, double half_width,
                  const KnownConstants& constants) {
  if (!estimate.std || !estimate.interval95 || !estimate.correlation) return;
  constexpr double rounding = 1e-10;
  if (!(estimate.std->zeta > rounding * std::abs(estimate.value.zeta))) return;
  const double k = constants.stiffness;
  const Profile::Parameter zeta{estimate.value.zeta, estimate.std->zeta};
  const Profile::Parameter F0{estimate.value.F0, estimate.std->F0};
  const double correlation = *estimate.correlation;
  const Profile of_zeta(zeta, F0, correlation, [&](double z, double F) { return deviance(z, F / k); }, half_width);
  const Profile of_F0(F0, zeta, correlation, [&](double F, double z) { return deviance(z, F / k); }, half_width);
  add_profile(estimate, of_zeta, zeta, F0.value, {"zeta", "", "F0", "N"}, estimate.interval95->zeta);
  add_profile(estimate, of_F0, F0, zeta.value, {"F0", "N", "zeta", ""}, estimate.interval95->F0);
}

}  // namespace dualdamp::identify
