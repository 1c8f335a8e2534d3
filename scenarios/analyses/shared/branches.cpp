#include "scenarios/analyses/shared/branches.hpp"

#include <functional>

#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

namespace {

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
          .key = "points",
          .is_complete = true};
}

Table change_table(const std::vector<sim::BranchChange>& changes, const std::string& name,
                   const std::string& unit) {
  using sim::BranchChange;
  return {.name = "changes",
          .columns = {text_column("kind", changes, [](const BranchChange& c) { return sim::name_of(c.kind); }),
                      column(name, unit, changes, &BranchChange::parameter),
                      column("x", "m", changes, &BranchChange::amplitude),
                      typed(column("stops_before", "", changes, &BranchChange::stops_before), CellKind::count),
                      typed(column("stops_after", "", changes, &BranchChange::stops_after), CellKind::count),
                      typed(column("stable_before", "", changes, &BranchChange::stable_before), CellKind::truth),
                      typed(column("stable_after", "", changes, &BranchChange::stable_after), CellKind::truth)},
          .key = "changes",
          .is_complete = true};
}

}  // namespace

ResultFields branch_fields(const ResultField& parameter) {
  return joined(
      {{"end", "",
        "why the branch ends: it leaves the range (range), no orbit continues it (orbit), it has the "
        "largest number of points (points), no orbit was found at the end of the range (edge), orbits nearly close but no "
        "step to them converged, or neighbouring motions part too fast (step), its amplitude grows without bound (growth), "
        "the search took too long (work), or the mass never moves at the first value or ceases to move (rest); all but range give a warning"},
       {"points[]." + parameter.path, parameter.unit, parameter.meaning},
       {"points[].x", "m", "output amplitude (peak - trough)/2"},
       {"points[].peak", "m", "max x"},
       {"points[].trough", "m", "min x"},
       {"points[].stops", "1", "stops in a period"},
       {"points[].sticks", "1", "sticks in a period"},
       {"points[].stable", "", "no Floquet multiplier outside the unit circle"},
       {"changes[].kind", "",
        "what changes: sequence, sticking, stops, fold, flip, neimark_sacker, stability, jump, rest, end"},
       {"changes[]." + parameter.path, parameter.unit, parameter.meaning},
       {"changes[].x", "m", "output amplitude there"},
       {"changes[].stops_before", "1", "stops in a period before the change"},
       {"changes[].stops_after", "1", "stops in a period after the change"},
       {"changes[].stable_before", "", "whether the orbits before the change attract"},
       {"changes[].stable_after", "", "whether the orbits after the change attract"}},
      certificate_fields());
}

Answer BranchQuestion::run(const RunContext& context) const {
  const sim::Branch branch = sim::continue_branch(context.model, parameter_, from_, to_);
  if (!branch.outcome.ok()) return failed("the branch has no first point: " + branch.outcome.reason);
  const bool amplitude = parameter_ == sim::BranchParameter::amplitude;
  Answer answer;
  answer.result["end"] = sim::name_of(branch.end);
  answer.result["points"] = nullptr;
  answer.result["changes"] = nullptr;
  add_certificate(answer.result, context.model, branch.certificate);
  const std::string name = amplitude ? "Y" : "omega";
  const std::string unit = amplitude ? amplitude_unit(context.model.excitation) : "rad/s";
  answer.tables.push_back(branch_table(branch.points, name, unit));
  answer.tables.push_back(change_table(branch.changes, name, unit));
  answer.warnings = branch.warnings;
  return answer;
}

}  // namespace dualdamp::scenarios
