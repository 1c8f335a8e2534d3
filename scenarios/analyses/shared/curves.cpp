#include "scenarios/analyses/shared/curves.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "scenarios/format/limits.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

namespace {

/// The direction in which each point was reached.
Column direction_column(const sim::Curve& curve, sim::Stepping stepping) {
  Column column{.name = "direction", .texts = {"up", "down"}, .kind = CellKind::text};
  const std::size_t up = stepping == sim::Stepping::up     ? curve.points.size()
                         : stepping == sim::Stepping::down ? 0
                                                           : curve.points.size() / 2;
  column.choices.assign(curve.points.size(), 1);
  std::fill_n(column.choices.begin(), up, 0);
  return column;
}

/// Why points have no phase.
Column phase_reasons(const sim::Curve& curve, const sim::Model& model) {
  Column column{.name = "phase_reason", .kind = CellKind::text};
  for (const sim::CurvePoint& point : curve.points) {
    const bool lacks = point.ok() && std::isnan(point.phase);
    column.texts.emplace_back(lacks ? why_no_phase(model, point.never_moves()) : "");
  }
  return column;
}

Table curve_table(const sim::Curve& curve, const sim::Model& model, const Axis& axis, bool with_phase,
                  std::optional<sim::Stepping> stepping) {
  using sim::CurvePoint;
  Table table{.name = "curve", .key = "points", .is_complete = true};
  std::vector<Column>& columns = table.columns;
  columns.push_back(column(axis.name, axis.unit, curve.points, axis.value));
  columns.push_back(point_column("x", "m", curve, CellKind::number, &CurvePoint::x));
  if (with_phase) columns.push_back(point_column("phase", "rad", curve, CellKind::number, &CurvePoint::phase));
  columns.push_back(point_column("stops", "", curve, CellKind::count, &CurvePoint::stops));
  columns.push_back(point_column("sticks", "", curve, CellKind::count, &CurvePoint::sticks));
  columns.push_back(point_column("stable", "", curve, CellKind::truth, &CurvePoint::stable));
  if (stepping) columns.push_back(direction_column(curve, *stepping));
  const auto lacks_phase = [](const sim::CurvePoint& point) { return std::isnan(point.phase); };
  if (with_phase && std::ranges::any_of(curve.points, lacks_phase)) columns.push_back(phase_reasons(curve, model));
  add_reasons(table, curve);
  return table;
}

}  // namespace

void add_reasons(Table& table, const sim::Curve& curve) {
  if (curve.reasons.size() == 1) return;
  Column column{.name = "reason", .texts = curve.reasons, .kind = CellKind::text};
  for (const sim::CurvePoint& point : curve.points) column.choices.push_back(point.reason);
  table.columns.push_back(std::move(column));
}

Answer answer_of_points(const sim::Curve& curve, const sim::Model& model, const std::string& what,
                        const std::vector<Axis>& axes) {
  if (std::ranges::none_of(curve.points, &sim::CurvePoint::ok))
    return failed("no point of the " + what + " has a number; the first: " + curve.reason(curve.points.front()));
  Answer answer;
  for (const sim::Remark& remark : curve.remarks) {
    const std::string count = remark.count > 1 ? std::to_string(remark.count) + " points; first " : "";
    std::string place = "points[" + std::to_string(remark.first) + "]";
    for (const Axis& axis : axes) {
      const double value = curve.points[remark.first].*axis.value;
      place += ", " + axis.name + " = " + core::format_number(value, 6) + " " +
               core::unit_for(model.oscillator.coordinate, axis.unit);
    }
    answer.warnings.push_back(remark.text + " (" + count + place + ")");
  }
  answer.result["points"] = nullptr;
  add_certificate(answer.result, model, curve.certificate);
  return answer;
}

Answer answer_of_curve(const sim::Curve& curve, const sim::Model& model, const Axis& axis, bool with_phase,
                       std::optional<sim::Stepping> stepping) {
  Answer answer = answer_of_points(curve, model, "curve", {axis});
  if (!answer.result.is_null()) answer.tables.push_back(curve_table(curve, model, axis, with_phase, stepping));
  return answer;
}

ResultFields curve_fields(const ResultFields& own) {
  return joined(
      joined(own, certificate_fields()),
      {{"points[].x", "m", "output amplitude (peak - trough)/2"},
       {"points[].stops", "1", "stops in a period"},
       {"points[].sticks", "1", "sticks in a period"},
       {"points[].stable", "", "no Floquet multiplier lies outside the unit circle"},
       {"points[].direction", "", "with 'continue': the direction in which the point was reached, up or down"},
       {"points[].reason", "", "for a point without numbers: the reason"}});
}

Field continue_key() {
  return words(
      "continue", {"up", "down", "both"},
      "each level starts from the steady state of the level before, in ascending order, in descending order, "
      "or up and then down again: jumps and hysteresis as on a shaker; default: from 'initial'");
}

std::optional<sim::Stepping> stepping_of(const Json& analysis) {
  if (!analysis.contains("continue")) return std::nullopt;
  const auto word = analysis.at("continue").get<std::string>();
  return word == "up" ? sim::Stepping::up : word == "down" ? sim::Stepping::down : sim::Stepping::both;
}

void check_stepping(CheckedFile& file) {
  const auto count = number_of_points(file, "points");
  if (count && static_cast<double>(*count) > max_points)
    file.complain("analysis.continue", "the curve has too many points up and down",
                  "at most " + core::format_number(max_points, 7), std::to_string(*count));
}

std::optional<std::size_t> number_of_points(const CheckedFile& file, std::string_view list) {
  if (list != "points") return std::nullopt;
  std::optional<std::size_t> count;
  for (const char* key : {"amplitudes", "frequencies"}) {
    if (file.has("analysis", key))
      count = count.value_or(1) * grid_size(file.values().at("analysis").at(key));
    else if (file.stands_in_file("analysis", key))
      return std::nullopt;
  }
  if (count && file.text_at("analysis", "continue") == "both") *count *= 2;
  return count;
}

}  // namespace dualdamp::scenarios
