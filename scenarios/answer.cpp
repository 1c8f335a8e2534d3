#include "scenarios/answer.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/numbers.hpp"
#include "scenarios/cells.hpp"

namespace dualdamp::scenarios {

namespace {

Json certificate_json(const core::SearchCount& count) {
  return {{"searches", count.searches},
          {"panels", count.panels},
          {"splits", count.splits},
          {"grazings", count.grazings}};
}

Json energy_json(const sim::Energy& energy) {
  return {{"input", finite(energy.input)},
          {"friction", finite(energy.friction)},
          {"viscous", finite(energy.viscous)},
          {"stored", finite(energy.stored)},
          {"defect", finite(energy.defect)}};
}

Table event_table(const std::vector<sim::Event>& events) {
  return {.name = "events",
          .columns = {column("t", "s", events, &sim::Event::t),
                      text_column("kind", events, [](const sim::Event& event) { return sim::name(event.kind); }),
                      column("x", "m", events, &sim::Event::x), column("v", "m/s", events, &sim::Event::v)},
          .key = "events"};
}

Table history_table(std::string name, const std::vector<sim::Sample>& samples, const sim::Excitation& excitation) {
  Table table{std::move(name), {column("t", "s", samples, &sim::Sample::t)}, true};
  if (excitation.moves_base()) table.columns.push_back(column("y", "m", samples, &sim::Sample::y));
  table.columns.push_back(column("x", "m", samples, &sim::Sample::x));
  table.columns.push_back(column("v", "m/s", samples, &sim::Sample::v));
  table.columns.push_back(column("a", "m/s^2", samples, &sim::Sample::a));
  table.columns.push_back(column("friction", "N", samples, &sim::Sample::force));
  if (excitation.type != sim::ExcitationType::none && !excitation.moves_base())
    table.columns.push_back(column("force", "N", samples, &sim::Sample::external));
  return table;
}

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

void add_reasons(Table& table, const sim::Curve& curve) {
  if (curve.reasons.size() == 1) return;
  Column column{.name = "reason", .texts = curve.reasons, .kind = CellKind::text};
  for (const sim::CurvePoint& point : curve.points) column.choices.push_back(point.reason);
  table.columns.push_back(std::move(column));
}

Table curve_table(const sim::Curve& curve, CurveOver over, const std::string& unit) {
  using sim::CurvePoint;
  Table table{.name = "curve", .key = "points"};
  std::vector<Column>& columns = table.columns;
  if (over == CurveOver::amplitude)
    columns.push_back(column("Y", unit, curve.points, &CurvePoint::Y));
  else
    columns.push_back(column("omega", "rad/s", curve.points, &CurvePoint::omega));
  columns.push_back(point_column("x", "m", curve, CellKind::number, &CurvePoint::x));
  if (over == CurveOver::frequency)
    columns.push_back(point_column("phase", "rad", curve, CellKind::number, &CurvePoint::phase));
  columns.push_back(point_column("stops", "", curve, CellKind::count, &CurvePoint::stops));
  columns.push_back(point_column("sticks", "", curve, CellKind::count, &CurvePoint::sticks));
  columns.push_back(point_column("stable", "", curve, CellKind::truth, &CurvePoint::stable));
  add_reasons(table, curve);
  return table;
}

Table map_table(const sim::Curve& map, const std::string& unit) {
  using sim::CurvePoint;
  Table table{.name = "map",
              .columns = {column("omega", "rad/s", map.points, &CurvePoint::omega),
                          column("Y", unit, map.points, &CurvePoint::Y),
                          point_column("x", "m", map, CellKind::number, &CurvePoint::x),
                          point_column("stops", "", map, CellKind::count, &CurvePoint::stops),
                          point_column("sticks", "", map, CellKind::count, &CurvePoint::sticks)},
              .is_long = true,
              .key = "points"};
  add_reasons(table, map);
  return table;
}

/// The points of a map with as many stops and rests a period.
struct Regime {
  std::size_t points = 0;
  double omega_from = std::numeric_limits<double>::infinity();
  double omega_to = 0.0;
  double Y_from = std::numeric_limits<double>::infinity();
  double Y_to = 0.0;

  void add(const sim::CurvePoint& point) {
    ++points;
    omega_from = std::min(omega_from, point.omega);
    omega_to = std::max(omega_to, point.omega);
    Y_from = std::min(Y_from, point.Y);
    Y_to = std::max(Y_to, point.Y);
  }
};

/// What a map shows, in a few rows.
Table regime_table(const sim::Curve& map, const std::string& unit) {
  std::map<std::pair<int, int>, Regime> found;  // by stops and sticks
  for (const sim::CurvePoint& point : map.points)
    if (point.ok()) found[{point.stops, point.sticks}].add(point);
  const std::vector<std::pair<std::pair<int, int>, Regime>> rows(found.begin(), found.end());
  const auto regime = [&](std::string name, std::string column_unit, double Regime::* value) {
    return column(std::move(name), std::move(column_unit), rows,
                  [value](const auto& row) { return row.second.*value; });
  };
  const auto count = [&](std::string name, auto get) {
    Column result = column(std::move(name), "", rows, get);
    result.kind = CellKind::count;
    return result;
  };
  return {.name = "regimes",
          .columns = {count("stops", [](const auto& row) { return row.first.first; }),
                      count("sticks", [](const auto& row) { return row.first.second; }),
                      count("points", [](const auto& row) { return static_cast<double>(row.second.points); }),
                      regime("omega_from", "rad/s", &Regime::omega_from),
                      regime("omega_to", "rad/s", &Regime::omega_to), regime("Y_from", unit, &Regime::Y_from),
                      regime("Y_to", unit, &Regime::Y_to)},
          .key = "regimes"};
}

Column typed(Column column, CellKind kind) {
  column.kind = kind;
  return column;
}

Table branch_table(const std::vector<sim::BranchPoint>& points, const std::string& name, const std::string& unit) {
  using sim::BranchPoint;
  using sim::SteadyState;
  const auto state = [&](const std::string& title, const std::string& unit_of, auto get) {
    return column(title, unit_of, points,
                  [get](const BranchPoint& point) { return static_cast<double>(std::invoke(get, point.state)); });
  };
  const auto sticks = [](const SteadyState& s) { return s.sticks.size(); };
  return {.name = "branch",
          .columns = {column(name, unit, points, &BranchPoint::parameter), state("x", "m", &SteadyState::amplitude),
                      state("peak", "m", &SteadyState::peak), state("trough", "m", &SteadyState::trough),
                      typed(state("stops", "", &SteadyState::stops_per_cycle), CellKind::count),
                      typed(state("sticks", "", sticks), CellKind::count),
                      typed(state("stable", "", &SteadyState::stable), CellKind::truth)},
          .key = "points"};
}

Table change_table(const std::vector<sim::BranchChange>& changes, const std::string& name,
                   const std::string& unit) {
  using sim::BranchChange;
  return {.name = "changes",
          .columns = {text_column("kind", changes, [](const BranchChange& c) { return sim::name(c.kind); }),
                      column(name, unit, changes, &BranchChange::parameter),
                      column("x", "m", changes, &BranchChange::amplitude),
                      typed(column("stops_before", "", changes, &BranchChange::stops_before), CellKind::count),
                      typed(column("stops_after", "", changes, &BranchChange::stops_after), CellKind::count)},
          .key = "changes"};
}

Answer failed(const std::string& reason) {
  Answer answer;
  answer.failure = reason;
  return answer;
}

/// A quantity that a curve or map runs over.
struct Axis {
  std::string name;
  double sim::CurvePoint::* value;
  std::string unit;
};

/// Remarks and the place of the list `points`; no result when no point has a number.
Answer answer_of_points(const sim::Curve& curve, const std::string& what, const std::vector<Axis>& axes) {
  if (std::ranges::none_of(curve.points, &sim::CurvePoint::ok))
    return failed("no point of the " + what + " has a number; the first: " + curve.reason(curve.points.front()));
  Answer answer;
  for (const sim::Remark& remark : curve.remarks) {
    const std::string count = remark.count > 1 ? std::to_string(remark.count) + " points; first " : "";
    std::string place = "points[" + std::to_string(remark.first) + "]";
    for (const Axis& axis : axes) {
      const double value = curve.points[remark.first].*axis.value;
      place += ", " + axis.name + " = " + core::format_number(value, 6) + " " + axis.unit;
    }
    answer.warnings.push_back(remark.text + " (" + count + place + ")");
  }
  answer.result["points"] = nullptr;
  answer.result["certificate"] = certificate_json(curve.certificate);
  return answer;
}

}  // namespace

Answer answer(const sim::History& history, const sim::Excitation& excitation) {
  if (!history.outcome.ok()) return failed(history.outcome.reason);
  Answer answer;
  answer.result["events"] = nullptr;
  answer.result["final"] = {
      {"t", finite(history.final.t)}, {"x", finite(history.final.x)}, {"v", finite(history.final.v)}};
  answer.result["energy"] = energy_json(history.energy);
  answer.result["certificate"] = certificate_json(history.certificate);
  answer.tables.push_back(event_table(history.events));
  if (!history.samples.empty()) answer.tables.push_back(history_table("history", history.samples, excitation));
  return answer;
}

Answer answer(const sim::SteadyState& state, const std::vector<sim::Sample>& orbit,
              const sim::Excitation& excitation) {
  if (!state.outcome.ok()) return failed(state.outcome.reason);
  Answer answer;
  answer.warnings = state.warnings;
  Json& result = answer.result;
  result["peak"] = finite(state.peak);
  result["trough"] = finite(state.trough);
  result["amplitude"] = finite(state.amplitude);
  result["phase"] = finite(state.phase);
  result["period"] = finite(state.period);
  result["max_speed"] = finite(state.max_speed);
  result["stops_per_cycle"] = state.stops_per_cycle;
  result["sticks"] = Json::array();
  for (const sim::Stick& stick : state.sticks)
    result["sticks"].push_back({{"start", finite(stick.start)},
                                {"duration", finite(stick.duration)},
                                {"position", finite(stick.position)}});
  result["multipliers"] = Json::array();
  for (const std::complex<double>& multiplier : state.multipliers)
    result["multipliers"].push_back({finite(multiplier.real()), finite(multiplier.imag())});
  result["stable"] = state.stable();
  result["energy"] = energy_json(state.energy);
  result["certificate"] = certificate_json(state.certificate);
  if (!state.sticks.empty())
    answer.tables.push_back({"sticks",
                             {column("start", "s", state.sticks, &sim::Stick::start),
                              column("duration", "s", state.sticks, &sim::Stick::duration),
                              column("position", "m", state.sticks, &sim::Stick::position)}});
  answer.tables.push_back(history_table("orbit", orbit, excitation));
  return answer;
}

Answer answer(const sim::FreeDecay& decay) {
  if (!decay.outcome.ok()) return failed(decay.outcome.reason);
  Answer answer;
  answer.result["peaks"] = nullptr;
  answer.result["came_to_rest"] = decay.came_to_rest;
  answer.tables.push_back({.name = "peaks",
                           .columns = {column("t", "s", decay.peaks, &sim::Extreme::t),
                                       column("x", "m", decay.peaks, &sim::Extreme::x)},
                           .key = "peaks"});
  return answer;
}

Answer answer(const sim::Curve& curve, CurveOver over, const std::string& unit) {
  const Axis axis = over == CurveOver::amplitude ? Axis{"Y", &sim::CurvePoint::Y, unit}
                                                 : Axis{"omega", &sim::CurvePoint::omega, "rad/s"};
  Answer answer = answer_of_points(curve, "curve", {axis});
  if (!answer.result.is_null()) answer.tables.push_back(curve_table(curve, over, unit));
  return answer;
}

Answer answer_map(const sim::Curve& map, const std::string& unit) {
  Answer answer =
      answer_of_points(map, "map", {{"omega", &sim::CurvePoint::omega, "rad/s"}, {"Y", &sim::CurvePoint::Y, unit}});
  if (answer.result.is_null()) return answer;
  answer.result["regimes"] = nullptr;
  answer.tables.push_back(map_table(map, unit));
  answer.tables.push_back(regime_table(map, unit));
  return answer;
}

void add_boundary(Answer& answer, const std::vector<sim::BoundaryPoint>& boundary, const std::string& unit) {
  const auto when_ok = [](double sim::BoundaryPoint::* value) {
    return [value](const sim::BoundaryPoint& point) { return point.outcome.ok() ? point.*value : none; };
  };
  Table table{.name = "boundary",
              .columns = {column("omega", "rad/s", boundary, &sim::BoundaryPoint::omega),
                          column("Y", unit, boundary, when_ok(&sim::BoundaryPoint::amplitude)),
                          column("x", "m", boundary, when_ok(&sim::BoundaryPoint::x)),
                          column("Y_closed_form", unit, boundary,
                                 [](const sim::BoundaryPoint& point) { return point.closed_form.value_or(none); })},
              .key = "boundary"};
  if (!std::ranges::all_of(boundary, [](const sim::BoundaryPoint& point) { return point.outcome.ok(); }))
    table.columns.push_back(
        text_column("reason", boundary, [](const sim::BoundaryPoint& point) { return point.outcome.reason; }));
  answer.result["boundary"] = nullptr;
  answer.tables.push_back(std::move(table));
}

Answer answer(const sim::Branch& branch, sim::BranchParameter parameter, const std::string& unit) {
  if (!branch.outcome.ok()) return failed("the branch has no first point: " + branch.outcome.reason);
  const bool amplitude = parameter == sim::BranchParameter::amplitude;
  Answer answer;
  answer.result["points"] = nullptr;
  answer.result["changes"] = nullptr;
  answer.result["certificate"] = certificate_json(branch.certificate);
  answer.tables.push_back(branch_table(branch.points, amplitude ? "Y" : "omega", amplitude ? unit : "rad/s"));
  answer.tables.push_back(change_table(branch.changes, amplitude ? "Y" : "omega", amplitude ? unit : "rad/s"));
  if (!branch.changes.empty() && branch.changes.back().kind == sim::ChangeKind::end)
    answer.warnings.emplace_back("the branch ends inside the range: no orbit continues it");
  return answer;
}

}  // namespace dualdamp::scenarios
