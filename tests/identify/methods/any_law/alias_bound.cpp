#include "tests/identify/methods/any_law/alias_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <variant>
#include <vector>

#include "identify/methods/any_law/library.hpp"
#include "identify/methods/any_law/severity_curve.hpp"
#include "identify/methods/any_law/steady_readings.hpp"

namespace dualdamp::identify::testing {

namespace {

using Curves = std::vector<std::vector<SeverityPoint>>;

double below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// int Phi(1.645 - d) over the values of laws with a distance below `reach`.
double least_length(const Curves& curves, double SeverityPoint::* value, double SeverityPoint::* deviation) {
  constexpr double reach = 6.0;
  constexpr double one_sided = 1.6448536269514722;
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const auto& curve : curves) {
    for (const SeverityPoint& point : curve) {
      if (point.chi2 > reach * reach) continue;
      low = std::min(low, point.*value - reach * point.*deviation);
      high = std::max(high, point.*value + reach * point.*deviation);
    }
  }
  low = std::max(low, 0.0);
  constexpr int parts = 2000;
  double length = 0.0;
  for (int i = 0; i < parts; ++i) {
    const double theta = std::lerp(low, high, (i + 0.5) / parts);
    double square = std::numeric_limits<double>::infinity();
    for (const auto& curve : curves)
      for (const SeverityPoint& point : curve)
        square = std::min(square, point.chi2 + std::pow((theta - point.*value) / (point.*deviation), 2));
    length += (high - low) / parts * below(one_sided - std::sqrt(square));
  }
  return length;
}

}  // namespace

std::optional<Interval> alias_bound(LawRecord kind, const LawRig& rig) {
  LawRig quiet = rig;
  quiet.noise = 0.0;
  const Record record = law_record(kind, quiet, nullptr, 0.0, 1);
  const auto readings = steady_readings(record, rig.constants, {});
  const auto* model = std::get_if<0>(&readings);
  if (model == nullptr) return std::nullopt;
  PlainFit plain;
  plain.noise = {{rig.noise * rig.reference.amplitude, rig.noise}, std::numeric_limits<double>::infinity()};
  const auto near = (*model)->no_orbits(plain.noise.deviations);
  const std::optional<SeverityFit> fit = fit_law(**model, {}, plain.noise, {.unknowns = (*model)->start()}, *near);
  if (!fit) return std::nullopt;
  plain.fit = *fit;
  Curves curves;
  for (const LawFits& law : fit_library(**model, {}, plain))
    curves.push_back(severity_curve(**model, SeverityScale(law.law.departure), law.fits));
  const double critical = 2.0 * std::sqrt(rig.constants.mass * rig.constants.stiffness);
  return std::array{0.5 * least_length(curves, &SeverityPoint::c, &SeverityPoint::c_deviation) / critical,
                    0.5 * least_length(curves, &SeverityPoint::F0, &SeverityPoint::F0_deviation)};
}

}  // namespace dualdamp::identify::testing
