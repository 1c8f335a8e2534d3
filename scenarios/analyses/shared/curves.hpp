#pragma once
/// Common parts of the analyses of many steady states: curves and maps.

#include <string>
#include <vector>

#include "scenarios/analysis.hpp"
#include "scenarios/results/motion.hpp"
#include "sim/curves/curves.hpp"
#include "sim/curves/stepped_curves.hpp"

namespace dualdamp::scenarios {

/// A column of a curve; a point without a steady state has no number.
template <typename Value>
Column point_column(std::string name, std::string unit, const sim::Curve& curve, CellKind kind,
                    Value sim::CurvePoint::* value) {
  Column result{.name = std::move(name), .unit = std::move(unit), .kind = kind};
  result.numbers.reserve(curve.points.size());
  for (const sim::CurvePoint& point : curve.points)
    result.numbers.push_back(point.ok() ? static_cast<double>(point.*value) : none);
  return result;
}

/// The reasons of points without numbers, if there are such points.
void add_reasons(Table& table, const sim::Curve& curve);

/// An axis of a curve or map.
struct Axis {
  std::string name;
  double sim::CurvePoint::* value;
  std::string unit;
};

/// Adds remarks, the place of the list `points` and the certificate; no result when no point has a number.
[[nodiscard]] Answer answer_of_points(const sim::Curve& curve, const sim::Model& model, const std::string& what,
                                      const std::vector<Axis>& axes);

/// A curve over one axis; `with_phase`: its points have a phase. Points that were stepped through have a direction.
[[nodiscard]] Answer answer_of_curve(const sim::Curve& curve, const sim::Model& model, const Axis& axis,
                                     bool with_phase, std::optional<sim::Stepping> stepping);

/// The key `continue`: in which direction the levels are stepped through.
[[nodiscard]] Field continue_key();
/// Nothing without the key: each level is computed separately.
[[nodiscard]] std::optional<sim::Stepping> stepping_of(const Json& analysis);
/// Number of points: levels that are stepped through twice count twice.
void check_stepping(CheckedFile& file);
/// The fields of a curve; `own`: those of its axis.
[[nodiscard]] ResultFields curve_fields(const ResultFields& own);

/// Number of points: the values of all of `amplitudes` and `frequencies` that the analysis has.
[[nodiscard]] std::optional<std::size_t> number_of_points(const CheckedFile& file, std::string_view list);

}  // namespace dualdamp::scenarios
