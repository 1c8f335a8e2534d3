#include "scenarios/results/estimates.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "core/numbers.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/results/laws.hpp"
#include "scenarios/results/ledger.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

Json parameters_json(const identify::ParameterSet& set) {
  Json json = Json::object();
  for (const identify::ReportedParameter& parameter : identify::reported_parameters)
    json[std::string(parameter.name)] = finite_or_null(set.*parameter.value);
  return json;
}

Json interval_json(const identify::ParameterIntervals& intervals) {
  Json json = Json::object();
  for (const identify::ReportedParameter& parameter : identify::reported_parameters) {
    const auto& [low, high] = intervals.*parameter.interval;
    json[std::string(parameter.name)] = Json::array({finite_or_null(low), finite_or_null(high)});
  }
  return json;
}

ResultFields parameter_fields(const std::string& prefix, const std::string& suffix, const std::string& what) {
  return {{prefix + "zeta" + suffix, "1", what + "damping ratio"},
          {prefix + "c" + suffix, "N.s/m", what + "damping"},
          {prefix + "x_f" + suffix, "m", what + "friction displacement F0/k"},
          {prefix + "F0" + suffix, "N", what + "friction force"}};
}

namespace {

Json lack_of_fit_json(const identify::LackOfFit& test) {
  return {{"test", test.test},
          {"statistic", finite_or_null(test.statistic)},
          {"freedom", test.freedom},
          {"p_value", finite_or_null(test.p_value)},
          {"effect", finite_or_null(test.effect)},
          {"fired", test.fired},
          {"level", test.level},
          {"least_effect", test.least_effect}};
}

Json line_json(const identify::LineFit& line) {
  return {{"slope", finite_or_null(line.slope)},
          {"intercept", finite_or_null(line.intercept)},
          {"residual_deviation", finite_or_null(line.residual_deviation)},
          {"G", finite_or_null(line.G)},
          {"residuals", finite_or_null(line.residuals)}};
}

Json decay_json(const identify::DecayFit& decay) {
  return {{"R", finite_or_null(decay.R)},
          {"first_amplitude", finite_or_null(decay.first_amplitude)},
          {"offset", finite_or_null(decay.offset)},
          {"residual_deviation", finite_or_null(decay.residual_deviation)},
          {"residuals", finite_or_null(decay.residuals)}};
}

Json others_json(const std::vector<identify::FurtherParameter>& parameters,
                 const identify::KnownConstants& constants) {
  Json list = Json::array();
  for (const identify::FurtherParameter& parameter : parameters) {
    Json item = {{"name", parameter.name},
                 {"unit", constants.unit(parameter.unit)},
                 {"value", finite_or_null(parameter.value)}};
    item["std"] = parameter.std ? finite_or_null(*parameter.std) : Json(nullptr);
    item["interval95"] =
        parameter.interval95
            ? Json::array({finite_or_null((*parameter.interval95)[0]), finite_or_null((*parameter.interval95)[1])})
            : Json(nullptr);
    list.push_back(std::move(item));
  }
  return list;
}

Json candidates_json(const std::vector<identify::LawCandidate>& candidates,
                     const identify::KnownConstants& constants) {
  Json list = Json::array();
  for (const identify::LawCandidate& candidate : candidates)
    list.push_back({{"law", candidate.law},
                    {"parameters", others_json(candidate.parameters, constants)},
                    {"residual_deviation", finite_or_null(candidate.residual_deviation)},
                    {"AICc", finite_or_null(candidate.AICc)},
                    {"BIC", finite_or_null(candidate.BIC)},
                    {"weight", finite_or_null(candidate.weight)}});
  return list;
}

/// Curves of the estimates, each in a separate file.
void add_curves(const std::vector<identify::Estimate>& estimates, Answer& answer) {
  for (const identify::Estimate& estimate : estimates) {
    for (const identify::EstimateCurve& curve : estimate.curves) {
      Table table{.name = estimate.method + "_" + curve.name, .is_long = true};
      for (const identify::CurveColumn& from : curve.columns)
        table.columns.push_back({.name = from.name, .unit = from.unit, .numbers = from.values});
      answer.tables.push_back(std::move(table));
    }
  }
}

Json diagnostics_json(const identify::Estimate& estimate, const identify::KnownConstants& constants) {
  Json json;
  json["reason"] = estimate.outcome.ok() ? estimate.reason : estimate.outcome.reason;
  json["used"] = estimate.used;
  json["excluded"] = Json::array();
  for (const identify::Exclusion& exclusion : estimate.excluded)
    json["excluded"].push_back({{"number", exclusion.number}, {"reason", exclusion.reason}});
  if (estimate.covariance) {
    const Eigen::Matrix2d& c = *estimate.covariance;
    json["covariance"] = {{finite_or_null(c(0, 0)), finite_or_null(c(0, 1))},
                          {finite_or_null(c(1, 0)), finite_or_null(c(1, 1))}};
  }
  if (estimate.correlation) json["correlation"] = finite_or_null(*estimate.correlation);
  if (estimate.lack_of_fit) json["lack_of_fit"] = lack_of_fit_json(*estimate.lack_of_fit);
  if (!estimate.subsets.empty()) {
    json["subsets"] = Json::array();
    for (const identify::SubsetFit& subset : estimate.subsets) {
      Json item = {{"label", subset.label}, {"used", subset.used}};
      item.update(parameters_json(subset.value));
      if (!subset.others.empty()) item["others"] = others_json(subset.others, constants);
      json["subsets"].push_back(std::move(item));
    }
  }
  if (estimate.line) json["line"] = line_json(*estimate.line);
  if (estimate.decay) json["decay"] = decay_json(*estimate.decay);
  if (!estimate.others.empty()) json["others"] = others_json(estimate.others, constants);
  if (!estimate.candidates.empty()) json["candidates"] = candidates_json(estimate.candidates, constants);
  json["warnings"] = estimate.warnings;
  return json;
}

Json estimate_json(const identify::Estimate& estimate, const identify::KnownConstants& constants) {
  const bool exists = estimate.outcome.ok();
  const identify::ParameterSet nothing{none, none, none, none};
  Json json = {{"method", estimate.method}};
  json.update(parameters_json(exists ? estimate.value : nothing));
  json["std"] = exists && estimate.std ? parameters_json(*estimate.std) : Json(nullptr);
  json["interval95"] = exists && estimate.interval95 ? interval_json(*estimate.interval95) : Json(nullptr);
  json["diagnostics"] = diagnostics_json(estimate, constants);
  json["usable"] = estimate.usable;
  if (estimate.laws) add_laws(*estimate.laws, json);
  return json;
}

Table estimate_table(const std::vector<identify::Estimate>& estimates) {
  using identify::Estimate;
  Table table{
      "estimates",
      {text_column("method", estimates, &Estimate::method),
       text_column("usable", estimates, [](const Estimate& estimate) { return estimate.usable ? "yes" : "no"; })},
      true};
  for (const identify::ReportedParameter& parameter : identify::reported_parameters) {
    const auto cell = [&](const std::string& suffix, auto get) {
      table.columns.push_back(
          column(std::string(parameter.name) + suffix, std::string(parameter.unit), estimates,
                 [&](const Estimate& estimate) { return estimate.outcome.ok() ? get(estimate) : none; }));
    };
    const auto end = [&](const Estimate& e, std::size_t i) {
      return e.interval95 ? ((*e.interval95).*parameter.interval)[i] : none;
    };
    cell("", [&](const Estimate& e) { return e.value.*parameter.value; });
    cell("_std", [&](const Estimate& e) { return e.std ? (*e.std).*parameter.value : none; });
    cell("_low", [&](const Estimate& e) { return end(e, 0); });
    cell("_high", [&](const Estimate& e) { return end(e, 1); });
  }
  return table;
}

constexpr int few = 5;  ///< digits in a terminal

/// The table of estimates for a terminal: a number with its interval is one cell.
Table readable_estimates(const std::vector<identify::Estimate>& estimates,
                         const identify::KnownConstants& constants) {
  using identify::Estimate;
  const auto with_interval = [&](const std::string& name, std::string unit, double identify::ParameterSet::* member,
                                 identify::Interval identify::ParameterIntervals::* interval) {
    Column cells{.name = name + " (95 %)", .unit = std::move(unit)};
    cells.digits = few;
    for (const Estimate& estimate : estimates) {
      const bool exists = estimate.outcome.ok();
      cells.numbers.push_back(exists ? estimate.value.*member : none);
      cells.intervals.push_back(exists && estimate.interval95 ? (*estimate.interval95).*interval
                                                              : identify::Interval{none, none});
    }
    return cells;
  };
  using Set = identify::ParameterSet;
  using Intervals = identify::ParameterIntervals;
  Table table{"estimates",
              {text_column("method", estimates, &Estimate::method),
               text_column("usable", estimates, [](const Estimate& e) { return e.usable ? "yes" : "no"; }),
               with_interval("zeta", "", &Set::zeta, &Intervals::zeta),
               with_interval("c", constants.unit("N.s/m"), &Set::c, &Intervals::c),
               with_interval("F0", constants.unit("N"), &Set::F0, &Intervals::F0)}};
  table.is_file = false;
  return table;
}

/// Further parameters of all estimates for a terminal.
Table readable_others(const std::vector<identify::Estimate>& estimates, const identify::KnownConstants& constants) {
  Column method{.name = "method", .kind = CellKind::text};
  Column name{.name = "parameter", .kind = CellKind::text};
  Column value{.name = "value (95 %)"};
  Column unit{.name = "unit", .kind = CellKind::text};
  value.digits = few;
  for (const identify::Estimate& estimate : estimates)
    for (const identify::FurtherParameter& parameter : estimate.others) {
      method.texts.push_back(estimate.method);
      name.texts.push_back(parameter.name);
      value.numbers.push_back(parameter.value);
      value.intervals.push_back(parameter.interval95.value_or(identify::Interval{none, none}));
      unit.texts.push_back(constants.unit(parameter.unit));
    }
  value.row_units = unit.texts;
  Table table{"parameters", {method, name, value, unit}};
  table.is_file = false;
  return table;
}

/// The straight lines x = intercept + slope Y behind the estimates, for a terminal.
Table readable_lines(const std::vector<identify::Estimate>& estimates, const identify::KnownConstants& constants) {
  std::vector<identify::Estimate> lines;
  std::ranges::copy_if(estimates, std::back_inserter(lines),
                       [](const identify::Estimate& estimate) { return estimate.line && estimate.outcome.ok(); });
  const auto line = [](double identify::LineFit::* value) {
    return [value](const identify::Estimate& estimate) { return (*estimate.line).*value; };
  };
  Table table{"lines",
              {text_column("x = a + b Y by", lines, &identify::Estimate::method),
               column("slope b", "", lines, line(&identify::LineFit::slope)),
               column("intercept a", constants.unit("m"), lines, line(&identify::LineFit::intercept)),
               column("G", "", lines, line(&identify::LineFit::G))}};
  table.is_file = false;
  return table;
}

/// e_0, e_1, ... of the decrement law.
std::vector<double> fitted_extremes(const identify::DecayFit& decay, double x_f, std::size_t count) {
  std::vector<double> extremes;
  double magnitude = std::abs(decay.first_amplitude);
  double sign = decay.first_amplitude < 0.0 ? -1.0 : 1.0;
  for (std::size_t i = 0; i < count; ++i) {
    extremes.push_back(decay.offset + sign * magnitude);
    magnitude = decay.R * magnitude - x_f * (1.0 + decay.R);
    sign = -sign;
  }
  return extremes;
}

/// The data and their fitted values by an estimate that has a curve: the answer, otherwise a usable one, otherwise
/// the first.
Json fit_json(const identify::Identification& found, const identify::Record& record) {
  const std::vector<identify::Estimate>& estimates = found.estimates;
  const auto has_curve = [](const identify::Estimate& estimate) {
    return estimate.outcome.ok() && (estimate.line || estimate.decay);
  };
  auto chosen = found.answer ? estimates.begin() + static_cast<std::ptrdiff_t>(*found.answer) : estimates.end();
  if (chosen == estimates.end() || !has_curve(*chosen))
    chosen = std::ranges::find_if(
        estimates, [&](const identify::Estimate& estimate) { return estimate.usable && has_curve(estimate); });
  if (chosen == estimates.end()) chosen = std::ranges::find_if(estimates, has_curve);
  if (chosen == estimates.end()) return nullptr;

  Json points = Json::array();
  if (chosen->line && record.pairs) {
    for (const identify::Pair& pair : record.pairs->pairs)
      points.push_back({{"number", pair.number},
                        {"Y", pair.Y},
                        {"x", pair.x},
                        {"fitted", finite_or_null(chosen->line->intercept + chosen->line->slope * pair.Y)}});
  } else if (chosen->decay && record.decay) {
    const std::vector<double>& extremes = record.decay->extremes;
    const std::vector<double> fitted = fitted_extremes(*chosen->decay, chosen->value.x_f, extremes.size());
    for (std::size_t i = 0; i < extremes.size(); ++i)
      points.push_back({{"number", i + 1}, {"x", extremes[i]}, {"fitted", finite_or_null(fitted[i])}});
  }
  return {{"method", chosen->method}, {"points", points}};
}

ResultFields diagnostics() {
  const std::string at = "estimates[].diagnostics.";
  return joined({{at + "reason", "", "why it is not usable, or which data it is from"},
                 {at + "used[]", "1", "numbers of the data used"},
                 {at + "excluded[].number", "1", "number of a datum left out"},
                 {at + "excluded[].reason", "", "why it was left out"},
                 {at + "covariance[][]", "", "covariance of (zeta, F0)"},
                 {at + "correlation", "1", "correlation of (zeta, F0)"},
                 {at + "lack_of_fit.statistic", "1", "F statistic"},
                 {at + "lack_of_fit.freedom", "1", "degrees of freedom left"},
                 {at + "lack_of_fit.p_value", "1", "probability of a larger statistic if the model holds"},
                 {at + "lack_of_fit.effect", "1", "rms of the added term over the range of the data"},
                 {at + "lack_of_fit.level", "1", "the test rejects below this p_value"},
                 {at + "lack_of_fit.least_effect", "1", "the test rejects only above this effect"},
                 {at + "lack_of_fit.fired", "", "the test rejects the model"},
                 {at + "subsets[].label", "", "name of a part of the data, or of another setting of the method"},
                 {at + "subsets[].used", "1", "number of data in the part"},
                 {at + "line.slope", "1", "slope of x over Y"},
                 {at + "line.intercept", "m", "x at Y = 0"},
                 {at + "line.residual_deviation", "m", "standard deviation of the residuals"},
                 {at + "line.G", "1", "parameter function G at the estimate"},
                 {at + "line.residuals[]", "m", "residuals of the data used"},
                 {at + "decay.R", "1", "decrement: factor by which viscous damping alone shrinks a half swing"},
                 {at + "decay.first_amplitude", "m", "first extreme without offset"},
                 {at + "decay.offset", "m", "middle of the extremes"},
                 {at + "decay.residual_deviation", "m", "standard deviation of the residuals"},
                 {at + "decay.residuals[]", "m", "residuals of the data used"},
                 {at + "others[].name", "", "a further parameter, such as mass or contact_stiffness"},
                 {at + "others[].unit", "", "its unit"},
                 {at + "others[].value", "", "its value"},
                 {at + "others[].std", "", "its standard error"},
                 {at + "others[].interval95[]", "", "its 95 % interval"},
                 {at + "subsets[].others[].name", "", "a further parameter from that part"},
                 {at + "subsets[].others[].value", "", "its value"},
                 {at + "candidates[].law", "", "a law that was compared, best first"},
                 {at + "candidates[].parameters[].name", "", "a parameter of the law"},
                 {at + "candidates[].parameters[].value", "", "its value"},
                 {at + "candidates[].parameters[].std", "", "its standard error"},
                 {at + "candidates[].parameters[].interval95[]", "", "its 95 % interval"},
                 {at + "candidates[].residual_deviation", "m", "standard deviation of its residuals"},
                 {at + "candidates[].AICc", "1", "Akaike's criterion, corrected for few data"},
                 {at + "candidates[].BIC", "1", "Bayesian criterion"},
                 {at + "candidates[].weight", "1", "Akaike weight"},
                 {at + "warnings[]", "", "further diagnostics"}},
                parameter_fields(at + "subsets[].", "", "from a part of the data: "));
}

}  // namespace

ResultFields estimate_fields() {
  ResultFields fields =
      joined(ledger_fields(), {{"estimates[].method", "", "name of the method"},
                               {"estimates[].usable", "", "nothing that is known speaks against the estimate"}});
  fields = joined(fields, parameter_fields("estimates[].", "", ""));
  fields = joined(fields, parameter_fields("estimates[].std.", "", "standard error of the "));
  fields = joined(fields, parameter_fields("estimates[].interval95.", "[]", "95 % interval of the "));
  fields = joined(fields, law_fields());
  fields = joined(fields, diagnostics());
  return joined(fields, {{"verdict", "", "the answer, or why there is none, in plain words"},
                         {"fit.method", "", "method of the fit: that of the answer, otherwise a usable one"},
                         {"fit.points[].number", "1", "number of the datum"},
                         {"fit.points[].Y", "m", "measured input amplitude"},
                         {"fit.points[].x", "m", "measured output amplitude or extreme"},
                         {"fit.points[].fitted", "m", "x by the fit"}});
}

namespace {

/// "den_hartog_fit, receptance: the record has no pairs; free_decay: ...", of the methods without an estimate.
std::string failures_of(const std::vector<identify::Estimate>& estimates) {
  std::vector<std::pair<std::string, std::vector<std::string>>> by_reason;
  for (const identify::Estimate& estimate : estimates) {
    if (estimate.outcome.ok()) continue;
    const std::string& reason = estimate.outcome.reason;
    auto known = std::ranges::find(by_reason, reason, [](const auto& entry) { return entry.first; });
    if (known == by_reason.end()) known = by_reason.insert(known, {reason, {}});
    known->second.push_back(estimate.method);
  }
  std::string text;
  for (const auto& [reason, methods] : by_reason)
    text += (text.empty() ? "" : "; ") + core::joined(methods) + ": " + reason;
  return text;
}

/// "; a larger Y makes the mass slide" where states were left out because it sticks.
std::string help_for_sticking(const std::vector<identify::Estimate>& estimates) {
  const auto sticks = [](const identify::Exclusion& left_out) {
    return left_out.reason.find("the mass sticks") != std::string::npos;
  };
  const bool any = std::ranges::any_of(
      estimates, [&](const identify::Estimate& each) { return std::ranges::any_of(each.excluded, sticks); });
  return any ? "; a larger Y makes the mass slide" : "";
}

}  // namespace

Answer answer_of(const identify::Identification& found, const identify::Record& record,
                 const identify::KnownConstants& constants) {
  const std::vector<identify::Estimate>& estimates = found.estimates;
  Answer answer;
  Json list = Json::array();
  const std::string reasons = failures_of(estimates);
  bool any = false;
  for (const identify::Estimate& estimate : estimates) {
    list.push_back(estimate_json(estimate, constants));
    any = any || estimate.outcome.ok();
    if (estimate.outcome.ok() && !estimate.usable)
      answer.warnings.push_back(estimate.method + " is not usable: " + estimate.reason);
    for (const std::string& warning : estimate.warnings)
      answer.warnings.push_back(estimate.method + ": " + warning);
  }
  if (!any) {
    const std::string& gross = found.ledger.gross_error;
    answer.failure =
        "no estimate is possible; " + gross + (gross.empty() ? "" : "; ") + reasons + help_for_sticking(estimates);
    return answer;
  }
  if (!reasons.empty()) answer.warnings.push_back("no estimate by " + reasons);
  answer.result["estimates"] = std::move(list);
  answer.result["fit"] = fit_json(found, record);
  add_ledger(found, answer);
  answer.tables.push_back(readable_estimates(estimates, constants));
  answer.tables.push_back(readable_lines(estimates, constants));
  answer.tables.push_back(readable_others(estimates, constants));
  answer.tables.push_back(estimate_table(estimates));
  for (const identify::Estimate& estimate : estimates)
    if (estimate.laws) std::ranges::move(law_tables(*estimate.laws, constants), std::back_inserter(answer.tables));
  add_curves(estimates, answer);
  return answer;
}

}  // namespace dualdamp::scenarios
