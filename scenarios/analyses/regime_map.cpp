#include "scenarios/analyses/regime_map.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "scenarios/analyses/shared/curves.hpp"
#include "scenarios/format/common_keys.hpp"
#include "scenarios/format/limits.hpp"
#include "scenarios/format/values.hpp"
#include "sim/curves/sticking_boundary.hpp"

namespace dualdamp::scenarios {

namespace {

Section regime_map_keys() {
  return {{frequencies(), amplitudes(),
           boolean("sticking_boundary",
                   "also find, at each frequency, the smallest amplitude whose steady state never sticks")
               .with_fallback(false)}};
}

ResultFields regime_map_fields() {
  return joined(
      {{"points[].omega", "rad/s", "forcing frequency"},
       {"points[].Y", unit_of_drive, "input amplitude"},
       {"points[].x", "m", "output amplitude (peak - trough)/2"},
       {"points[].stops", "1", "stops in a period"},
       {"points[].regime", "", "never moves, rests ('sticks' times in a period), slides through, no steady state"},
       {"points[].sticks", "1",
        "sticks in a period; under laws that do not hold the mass: stretches of more than 2 % of a period in which "
        "the speed is below 1e-3 of the largest"},
       {"points[].reason", "", "for a point without numbers: the reason"},
       {"regimes[].regime", "", "as in points"},
       {"regimes[].stops", "1", "stops in a period"},
       {"regimes[].sticks", "1", "sticks in a period"},
       {"regimes[].points", "1", "points of the map in this regime"},
       {"regimes[].omega_from", "rad/s", "their lowest frequency"},
       {"regimes[].omega_to", "rad/s", "their highest frequency"},
       {"regimes[].Y_from", unit_of_drive, "their smallest input amplitude"},
       {"regimes[].Y_to", unit_of_drive, "their largest input amplitude"},
       {"boundary[].omega", "rad/s", "forcing frequency"},
       {"boundary[].Y", unit_of_drive,
        "smallest input amplitude whose steady state never sticks; beyond plain Coulomb friction under one harmonic: "
        "the smallest that a scan of 32 steps a factor of two and the amplitudes of the map show"},
       {"boundary[].x", "m", "output amplitude there"},
       {"boundary[].Y_closed_form", unit_of_drive,
        "smallest input amplitude by Den Hartog's closed form; missing if it does not hold"},
       {"boundary[].Y_sticks_again_from", unit_of_drive,
        "smallest amplitude above Y at which the mass was seen to stick again; missing if it was not"},
       {"boundary[].Y_sticks_again_to", unit_of_drive,
        "largest such amplitude; between both it need not stick everywhere"},
       {"boundary[].Y_sticks", unit_of_drive,
        "if no boundary was found: the largest input amplitude found below it, whose steady state sticks"},
       {"boundary[].Y_slides", unit_of_drive,
        "likewise the smallest one found above it, whose steady state never sticks"},
       {"boundary[].reason", "", "if no boundary was found: the reason"}},
      certificate_fields());
}

void check_regime_map(CheckedFile& file) {
  const auto count = number_of_points(file, "points");
  if (count && static_cast<double>(*count) > max_points)
    file.complain("analysis.type", "the map has too many points",
                  "at most " + core::format_number(max_points, 6) + " frequencies times amplitudes",
                  std::to_string(*count));
}

std::unique_ptr<const Question> ask_regime_map(CheckedValues&& values) {
  const Json& section = values.analysis;
  return std::make_unique<RegimeMapQuestion>(grid_values(section.at("frequencies")),
                                             grid_values(section.at("amplitudes")),
                                             section.at("sticking_boundary").get<bool>());
}

std::optional<std::size_t> regime_map_length_of(const CheckedFile& file, std::string_view list) {
  if (list == "boundary" && file.has("analysis", "frequencies"))
    return grid_size(file.values().at("analysis").at("frequencies"));
  return number_of_points(file, list);
}

/// There are few names: each point has the number of its name.
Column regime_column(const sim::Curve& map) {
  Column column{.name = "regime", .kind = CellKind::text};
  for (const sim::Regime regime :
       {sim::Regime::no_steady_state, sim::Regime::never_moves, sim::Regime::sticks, sim::Regime::slides_through})
    column.texts.emplace_back(sim::name_of(regime));
  for (const sim::CurvePoint& point : map.points)
    column.choices.push_back(static_cast<std::uint32_t>(point.regime()));
  return column;
}

Table map_table(const sim::Curve& map, const std::string& unit) {
  using sim::CurvePoint;
  Table table{
      .name = "map",
      .columns = {column("omega", "rad/s", map.points, &CurvePoint::omega),
                  column("Y", unit, map.points, &CurvePoint::Y),
                  point_column("x", "m", map, CellKind::number, &CurvePoint::x),
                  point_column("stops", "", map, CellKind::count, &CurvePoint::stops),
                  point_column("sticks", "", map, CellKind::count, &CurvePoint::sticks), regime_column(map)},
      .is_long = true,
      .key = "points",
      .is_complete = true};
  add_reasons(table, map);
  return table;
}

/// The points of a map with equal numbers of stops and sticks in a period.
struct Regime {
  sim::Regime kind = sim::Regime::no_steady_state;
  std::size_t points = 0;
  double omega_from = core::infinity;
  double omega_to = 0.0;
  double Y_from = core::infinity;
  double Y_to = 0.0;

  void add(const sim::CurvePoint& point) {
    ++points;
    kind = point.regime();
    omega_from = std::min(omega_from, point.omega);
    omega_to = std::max(omega_to, point.omega);
    Y_from = std::min(Y_from, point.Y);
    Y_to = std::max(Y_to, point.Y);
  }
};

/// A summary of a map in a few rows.
Table regime_table(const sim::Curve& map, const std::string& unit) {
  // Sorted by stops and sticks; points without a steady state are last.
  std::map<std::tuple<bool, int, int>, Regime> found;
  for (const sim::CurvePoint& point : map.points) found[{!point.ok(), point.stops, point.sticks}].add(point);
  const std::vector<std::pair<std::tuple<bool, int, int>, Regime>> rows(found.begin(), found.end());
  const auto number_of = [](const auto& row, int number) {
    return row.second.kind == sim::Regime::no_steady_state ? none : static_cast<double>(number);
  };
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
          .columns = {text_column("regime", rows, [](const auto& row) { return sim::name_of(row.second.kind); }),
                      count("stops", [&](const auto& row) { return number_of(row, std::get<1>(row.first)); }),
                      count("sticks", [&](const auto& row) { return number_of(row, std::get<2>(row.first)); }),
                      count("points", [](const auto& row) { return static_cast<double>(row.second.points); }),
                      regime("omega_from", "rad/s", &Regime::omega_from),
                      regime("omega_to", "rad/s", &Regime::omega_to), regime("Y_from", unit, &Regime::Y_from),
                      regime("Y_to", unit, &Regime::Y_to)},
          .key = "regimes"};
}

/// Where the boundary is not the whole answer.
void warn_of_boundary(Answer& answer, const std::vector<sim::BoundaryPoint>& boundary, const std::string& unit) {
  const auto warn = [&](const auto& concerns, const std::string& what, const auto& detail) {
    const auto first = std::ranges::find_if(boundary, concerns);
    if (first == boundary.end()) return;
    answer.warnings.push_back("sticking boundary: at " + std::to_string(std::ranges::count_if(boundary, concerns)) +
                              " of " + std::to_string(boundary.size()) + " frequencies " + what +
                              "; the first is " + core::format_number(first->omega, 6) +
                              " rad/s: " + detail(*first));
  };
  const auto is_ok = [](const sim::BoundaryPoint& point) { return point.outcome.ok(); };
  warn([&](const sim::BoundaryPoint& point) { return is_ok(point) && point.sticks_again.has_value(); },
       "the mass sticks again at amplitudes above it",
       [&](const sim::BoundaryPoint& point) {
         return "it slides above " + core::format_number(point.amplitude, 6) + " " + unit +
                ", and sticks again somewhere from " + core::format_number(point.sticks_again->first, 6) + " to " +
                core::format_number(point.sticks_again->second, 6) + " " + unit;
       });
  warn([&](const sim::BoundaryPoint& point) { return is_ok(point) && point.unknown_below > 0; },
       "some amplitudes below it have no steady state, so that it need not be the smallest",
       [](const sim::BoundaryPoint& point) {
         return std::to_string(point.unknown_below) +
                (point.unknown_below == 1 ? " such amplitude" : " such amplitudes");
       });
  warn([](const sim::BoundaryPoint& point) { return point.is_stopped; },
       "the search for it was stopped, because it takes too long",
       [](const sim::BoundaryPoint& point) { return point.outcome.reason; });
  warn([&](const sim::BoundaryPoint& point) { return is_ok(point) && point.seen_up_to.has_value(); },
       "the scan above it was stopped, because it takes too long: whether the mass sticks again is not known",
       [&](const sim::BoundaryPoint& point) {
         return "it looked at amplitudes up to " + core::format_number(*point.seen_up_to, 6) + " " + unit;
       });
}

/// The sticking boundary beside a map.
void add_boundary(Answer& answer, const std::vector<sim::BoundaryPoint>& boundary, const std::string& unit) {
  const auto when_ok = [](double sim::BoundaryPoint::* value) {
    return [value](const sim::BoundaryPoint& point) { return point.outcome.ok() ? point.*value : none; };
  };
  Table table{.name = "boundary",
              .columns = {column("omega", "rad/s", boundary, &sim::BoundaryPoint::omega),
                          column("Y", unit, boundary, when_ok(&sim::BoundaryPoint::amplitude)),
                          column("x", "m", boundary, when_ok(&sim::BoundaryPoint::x))},
              .key = "boundary"};
  if (std::ranges::any_of(boundary, [](const sim::BoundaryPoint& point) { return point.closed_form.has_value(); }))
    table.columns.push_back(column("Y_closed_form", unit, boundary, [](const sim::BoundaryPoint& point) {
      return point.closed_form.value_or(none);
    }));
  if (std::ranges::any_of(boundary,
                          [](const sim::BoundaryPoint& point) { return point.sticks_again.has_value(); })) {
    const auto limit = [](double std::pair<double, double>::* value) {
      return [value](const sim::BoundaryPoint& point) {
        return point.sticks_again ? *point.sticks_again.*value : none;
      };
    };
    table.columns.push_back(
        column("Y_sticks_again_from", unit, boundary, limit(&std::pair<double, double>::first)));
    table.columns.push_back(column("Y_sticks_again_to", unit, boundary, limit(&std::pair<double, double>::second)));
  }
  warn_of_boundary(answer, boundary, unit);
  const auto is_open = [](const sim::BoundaryPoint& point) { return !point.outcome.ok(); };
  const auto side = [is_open](double sim::BoundaryPoint::* value) {
    return
        [=](const sim::BoundaryPoint& point) { return is_open(point) && point.*value > 0.0 ? point.*value : none; };
  };
  if (std::ranges::any_of(boundary, is_open)) {
    table.columns.push_back(column("Y_sticks", unit, boundary, side(&sim::BoundaryPoint::sticks)));
    table.columns.push_back(column("Y_slides", unit, boundary, side(&sim::BoundaryPoint::slides)));
    table.columns.push_back(
        text_column("reason", boundary, [](const sim::BoundaryPoint& point) { return point.outcome.reason; }));
  }
  answer.result["boundary"] = nullptr;
  answer.tables.push_back(std::move(table));
}

constexpr std::size_t most_sampled = 4;

std::vector<double> sampled_values(const std::vector<double>& values) {
  if (values.size() <= most_sampled) return values;
  std::vector<double> result;
  for (std::size_t i = 0; i < most_sampled; ++i)
    result.push_back(values[i * (values.size() - 1) / (most_sampled - 1)]);
  return result;
}

/// The rows whose values in the column `name` are among these; all rows of a table that has no such column.
Table with_rows(const Table& table, std::string_view name, const std::vector<double>& values) {
  const Column* const key = table.find(name);
  if (key == nullptr) return table;
  const std::vector<double> keys = key->numbers;
  const auto keep = [&](auto& list) {
    if (list.size() != keys.size()) return;
    std::size_t next = 0;
    for (std::size_t row = 0; row < keys.size(); ++row)
      if (std::ranges::find(values, keys[row]) != values.end()) list[next++] = list[row];
    list.resize(next);
  };
  Table result = table;
  for (Column& column : result.columns) {
    keep(column.numbers);
    if (column.choices.empty()) keep(column.texts);
    keep(column.choices);
  }
  return result;
}

}  // namespace

std::optional<Sampled> RegimeMapQuestion::sampled() const {
  const std::vector<double> frequencies = sampled_values(frequencies_);
  const std::vector<double> amplitudes = sampled_values(amplitudes_);
  const std::size_t all = frequencies_.size() * amplitudes_.size();
  const std::size_t some = frequencies.size() * amplitudes.size();
  if (some == all) return std::nullopt;
  const auto part = [=](const Answer& answer) {
    Answer result = answer;
    for (Table& table : result.tables) {
      table = with_rows(table, "omega", frequencies);
      if (table.key == "points") table = with_rows(table, "Y", amplitudes);
    }
    return result;
  };
  return Sampled{std::make_unique<RegimeMapQuestion>(frequencies, amplitudes, with_boundary_, scanned_), part,
                 std::to_string(some) + " of " + std::to_string(all) + " points"};
}

Answer RegimeMapQuestion::run(const RunContext& context) const {
  const sim::Model& model = context.model;
  const std::string unit = amplitude_unit(model.excitation);
  const sim::Curve map = sim::regime_map(model, frequencies_, amplitudes_, context.steady_states());
  Answer answer = answer_of_points(map, model, "map",
                                   {{"omega", &sim::CurvePoint::omega, "rad/s"}, {"Y", &sim::CurvePoint::Y, unit}});
  if (answer.result.is_null()) return answer;
  answer.result["regimes"] = nullptr;
  answer.tables.push_back(map_table(map, unit));
  answer.tables.push_back(regime_table(map, unit));
  if (with_boundary_) add_boundary(answer, sim::sticking_boundary(model, frequencies_, scanned_), unit);
  return answer;
}

const Analysis& regime_map_analysis() {
  static const Analysis analysis = {
      .name = "regime_map",
      .summary = "output amplitude, stops and sticks over frequency and input amplitude",
      .keys = regime_map_keys(),
      .needs = needs_of_steady_states({}),
      .results = regime_map_fields(),
      .chart = {.table = "map",
                .list = "points",
                .x = "omega",
                .y = "Y",
                .x_label = "frequency",
                .y_label = "input amplitude Y",
                .by = "regime",
                .kind = MainChart::Kind::cells},
      .steady_vibrations = true,
      .verifiable = true,
      .check = check_regime_map,
      .ask = ask_regime_map,
      .length_of = regime_map_length_of};
  return analysis;
}

}  // namespace dualdamp::scenarios
