#include "bench/mechanisms/answer.hpp"

#include <algorithm>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"

namespace dualdamp::bench {

namespace {

using scenarios::Json;
using scenarios::Table;

Json parameters_json(const Departure& mechanism, const std::vector<double>& values,
                     const std::vector<bool>& at_bound = {}) {
  Json list = Json::array();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const DepartureParameter& parameter = mechanism.parameters[i];
    list.push_back({{"name", parameter.name}, {"unit", parameter.unit}, {"value", values[i]}});
    if (!at_bound.empty()) list.back()["at_bound"] = static_cast<bool>(at_bound[i]);
  }
  return list;
}

Json estimates_json(const std::vector<PartReading>& readings, const MechanismStudy& study) {
  Json list = Json::array();
  for (std::size_t i = 0; i < readings.size(); ++i)
    list.push_back({{"share", study.estimates[i].share}, {"zeta", readings[i].zeta}, {"F0", readings[i].F0}});
  return list;
}

Json levels_json(const Levels& levels) {
  Json list = Json::array();
  for (std::size_t i = 0; i < levels.Y.size(); ++i) list.push_back({{"Y", levels.Y[i]}, {"x", levels.x[i]}});
  return list;
}

Json decay_json(const DecayReading& decay) {
  const auto segment = [](const MeasuredDecay::Segment& s) { return Json{{"zeta", s.zeta}, {"x_f", s.x_f}}; };
  return {{"high", segment(decay.high)}, {"low", segment(decay.low)}, {"bend", decay.bend()}};
}

Json explanation_json(const Explanation& explanation, const MechanismStudy& study) {
  const MechanismFit& fit = explanation.fit;
  Json json = {{"mechanism", explanation.mechanism->name},
               {"meaning", explanation.mechanism->meaning},
               {"unknowns", explanation.unknowns}};
  if (!fit.outcome.ok()) {
    json["reason"] = fit.outcome.reason;
    return json;
  }
  json["chi2"] = fit.chi2;
  json["misfit"] = explanation.misfit;
  json["stretch"] = scenarios::finite_or_null(explanation.stretch);
  json["bend"] = bend_of(fit.readings);
  json["F0"] = fit.friction.F0;
  json["c"] = fit.friction.c;
  json["parameters"] = parameters_json(*explanation.mechanism, fit.values, fit.at_bound);
  json["estimates"] = estimates_json(fit.readings, study);
  json["levels"] = levels_json(fit.levels);
  json["aliases"] = explanation.aliases;
  if (explanation.decay) json["decay"] = decay_json(*explanation.decay);
  return json;
}

Json effect_json(const Effect& effect, const MechanismStudy& study) {
  Json json = {{"mechanism", effect.rig->mechanism->name}};
  if (!effect.rig->name.empty()) json["case"] = effect.rig->name;
  json["because"] = effect.rig->because;
  json["parameters"] = parameters_json(*effect.rig->mechanism, effect.rig->values);
  if (!effect.readings) {
    json["reason"] = "there is no steady state at one of the levels, or the output does not grow";
    return json;
  }
  json["bend"] = bend_of(*effect.readings);
  json["sticks"] = effect.response->sticks;
  json["estimates"] = estimates_json(*effect.readings, study);
  return json;
}

/// Texts such as "saturation_velocity 0.514 m/s".
scenarios::Column values_column(std::vector<std::vector<scenarios::Quantity>> rows) {
  scenarios::Column column{.name = "parameters", .kind = scenarios::CellKind::text};
  for (const std::vector<scenarios::Quantity>& row : rows) column.texts.push_back(scenarios::quantities_text(row));
  column.quantities = std::move(rows);
  return column;
}

std::vector<scenarios::Quantity> quantities(const Departure& mechanism, const std::vector<double>& values) {
  std::vector<scenarios::Quantity> list;
  for (std::size_t i = 0; i < values.size(); ++i)
    list.push_back(
        {std::string(mechanism.parameters[i].name), values[i], std::string(mechanism.parameters[i].unit)});
  return list;
}

/// A number of a fit; none without a fit.
template <typename Get>
auto of_fit(Get get) {
  return [get](const Explanation& e) { return e.fit.outcome.ok() ? get(e) : scenarios::none; };
}

Table mechanism_table(const std::vector<Explanation>& list) {
  using scenarios::column;
  using scenarios::text_column;
  const auto of_decay = [](double (*get)(const DecayReading&)) {
    return [get](const Explanation& e) { return e.decay ? get(*e.decay) : scenarios::none; };
  };
  std::vector<std::vector<scenarios::Quantity>> values;
  for (const Explanation& e : list) values.push_back(quantities(*e.mechanism, e.fit.values));
  return {"mechanisms",
          {text_column("mechanism", list, [](const Explanation& e) { return e.mechanism->name; }),
           column("chi2", "", list, of_fit([](const Explanation& e) { return e.fit.chi2; })),
           column("unknowns", "", list, [](const Explanation& e) { return static_cast<double>(e.unknowns); }),
           column("misfit", "", list, &Explanation::misfit), column("stretch", "", list, &Explanation::stretch),
           column("bend", "", list, of_fit([](const Explanation& e) { return bend_of(e.fit.readings); })),
           column("F0", "N", list, of_fit([](const Explanation& e) { return e.fit.friction.F0; })),
           column("c", "N.s/m", list, of_fit([](const Explanation& e) { return e.fit.friction.c; })),
           values_column(std::move(values)),
           column("decay_zeta_high", "", list, of_decay([](const DecayReading& d) { return d.high.zeta; })),
           column("decay_zeta_low", "", list, of_decay([](const DecayReading& d) { return d.low.zeta; })),
           column("decay_bend", "", list, of_decay([](const DecayReading& d) { return d.bend(); }))}};
}

Table effect_table(const std::vector<Effect>& list, const MechanismStudy& study) {
  using scenarios::column;
  using scenarios::text_column;
  const auto reading = [&](std::size_t part, double PartReading::* member) {
    return [=](const Effect& e) { return e.readings ? e.readings->at(part).*member : scenarios::none; };
  };
  const std::size_t last = study.estimates.size() - 1;
  std::vector<std::vector<scenarios::Quantity>> values;
  for (const Effect& e : list) values.push_back(quantities(*e.rig->mechanism, e.rig->values));
  return {"effects",
          {text_column("mechanism", list, [](const Effect& e) { return e.rig->mechanism->name; }),
           text_column("case", list, [](const Effect& e) { return e.rig->name; }),
           column("bend", "", list,
                  [](const Effect& e) { return e.readings ? bend_of(*e.readings) : scenarios::none; }),
           column("zeta_of_all", "", list, reading(0, &PartReading::zeta)),
           column("zeta_of_least", "", list, reading(last, &PartReading::zeta)),
           column("F0_of_all", "N", list, reading(0, &PartReading::F0)),
           column("F0_of_least", "N", list, reading(last, &PartReading::F0)), values_column(std::move(values))}};
}

/// Rows of input and output amplitudes, each list under a name.
Table amplitude_table(std::string name, const std::vector<std::pair<std::string, const Levels*>>& lists) {
  Table table{std::move(name),
              {{.name = "mechanism", .kind = scenarios::CellKind::text},
               {.name = "Y", .unit = "m"},
               {.name = "x", .unit = "m"}},
              true};
  for (const auto& [label, levels] : lists)
    for (std::size_t i = 0; i < levels->Y.size(); ++i) {
      table.columns[0].texts.push_back(label);
      table.columns[1].numbers.push_back(levels->Y[i]);
      table.columns[2].numbers.push_back(levels->x[i]);
    }
  return table;
}

/// Whether a decay bends in the direction of the measured one, by more than a tenth of it.
bool bends_alike(const Explanation& explanation, const DecayReading& measured) {
  const double bend = measured.bend();
  return explanation.decay && explanation.decay->bend() * bend > 0.1 * bend * bend;
}

/// Beyond this ratio to its plausible value a parameter is implausible for the rig.
constexpr double far_fetched = 10.0;

std::string verdict(const StudyAnswer& answer, const MechanismStudy& study) {
  const Explanation& best = answer.explanations.front();
  if (!best.fit.outcome.ok()) return "No mechanism could be fitted.";
  constexpr int digits = 2;
  std::string text = std::string(best.mechanism->name) + " comes closest: chi2 " +
                     core::format_number(best.fit.chi2, digits) + " with " + std::to_string(best.unknowns) +
                     " unknowns for " + std::to_string(2 * study.estimates.size()) +
                     " numbers, none of them off by more than " + core::percent(best.misfit, digits) + ". ";
  if (!best.aliases.empty())
    text += "Within the standard errors it cannot be told from " + core::joined(best.aliases, " and ") +
            ": amplitudes at one frequency do not tell mechanisms apart. ";
  std::vector<std::string> likely;
  std::vector<std::string> alike;
  for (const Explanation& one : answer.explanations) {
    const bool is_close = &one == &best || std::ranges::count(best.aliases, one.mechanism->name) > 0;
    if (!is_close || !(one.stretch <= far_fetched)) continue;
    likely.emplace_back(one.mechanism->name);
    if (study.decay && bends_alike(one, {study.decay->high, study.decay->low}))
      alike.emplace_back(one.mechanism->name);
  }
  if (likely.empty()) return text + "None of these is within a factor of 10 of plausible values.";
  text += "Within a factor of 10 of plausible values: " + core::joined(likely, " and ") + ". ";
  if (!study.decay) return text;
  return text + (alike.empty()
                     ? "None of those makes the free decay bend as measured."
                     : "Of those the free decay bends as measured with " + core::joined(alike, " and ") + ".");
}

std::vector<PartReading> measured_readings(const MechanismStudy& study) {
  std::vector<PartReading> readings;
  for (const PartEstimate& estimate : study.estimates) readings.push_back({estimate.zeta, estimate.F0});
  return readings;
}

}  // namespace

scenarios::Json result_of(const StudyAnswer& answer, const MechanismStudy& study) {
  const std::vector<PartReading> measured = measured_readings(study);
  Json json = {{"verdict", verdict(answer, study)},
               {"explained",
                {{"bend", bend_of(measured)},
                 {"estimates", estimates_json(measured, study)},
                 {"levels", levels_json(answer.measured)}}}};
  if (study.decay) json["explained"]["decay"] = decay_json({study.decay->high, study.decay->low});
  json["mechanisms"] = Json::array();
  for (const Explanation& explanation : answer.explanations)
    json["mechanisms"].push_back(explanation_json(explanation, study));
  json["effects"] = Json::array();
  for (const Effect& effect : answer.effects) json["effects"].push_back(effect_json(effect, study));
  return json;
}

std::vector<Table> tables_of(const StudyAnswer& answer, const MechanismStudy& study) {
  std::vector<std::pair<std::string, const Levels*>> points = {{"measured", &answer.measured}};
  std::vector<std::pair<std::string, const Levels*>> curves;
  for (const Explanation& explanation : answer.explanations) {
    if (!explanation.fit.outcome.ok()) continue;
    points.emplace_back(explanation.mechanism->name, &explanation.fit.levels);
    curves.emplace_back(explanation.mechanism->name, &explanation.curve);
  }
  return {mechanism_table(answer.explanations), effect_table(answer.effects, study),
          amplitude_table("levels", points), amplitude_table("curves", curves)};
}

}  // namespace dualdamp::bench
