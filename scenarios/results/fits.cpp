#include "scenarios/results/fits.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "core/coordinate.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

namespace {

Json pair_json(const identify::Interval& pair) {
  return Json::array({finite_or_null(pair[0]), finite_or_null(pair[1])});
}

Json rows_json(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (const auto& row : matrix.rowwise()) rows.push_back(std::vector<double>(row.begin(), row.end()));
  return rows;
}

/// SI unit for the coordinate of the rig. The fit itself names the units of a displacement.
std::string unit_in(const identify::Fit& fit, const std::string& unit) {
  return core::unit_for(fit.rig.known.oscillator.coordinate, unit);
}

Table parameter_table(const identify::Fit& fit) {
  using identify::FittedParameter;
  const std::vector<FittedParameter>& list = fit.parameters;
  const auto end_of = [](auto member, std::size_t end) {
    return [member, end](const FittedParameter& parameter) { return (parameter.*member)[end]; };
  };
  Table table{.name = "parameters"};
  table.columns.push_back(text_column("name", list, [](const FittedParameter& p) { return p.parameter.name; }));
  const Column unit =
      text_column("unit", list, [&](const FittedParameter& p) { return unit_in(fit, p.parameter.unit); });
  table.columns.push_back(unit);
  table.columns.push_back(column("value", "", list, &FittedParameter::value));
  table.columns.push_back(column("std", "", list, &FittedParameter::std));
  table.columns.push_back(column("low95", "", list, end_of(&FittedParameter::interval95, 0)));
  table.columns.push_back(column("high95", "", list, end_of(&FittedParameter::interval95, 1)));
  table.columns.push_back(column("profile_low95", "", list, end_of(&FittedParameter::profile95, 0)));
  table.columns.push_back(column("profile_high95", "", list, end_of(&FittedParameter::profile95, 1)));
  for (Column& column : table.columns)
    if (column.kind == CellKind::number) column.row_units = unit.texts;
  table.columns.push_back(text_column("remark", list, [](const FittedParameter& p) { return p.reason; }));
  return table;
}

/// Whether steady states lie at more amplitudes than frequencies: their curves are those over the amplitude.
bool has_more_values_beside(const identify::Signal& signal) {
  const auto count = [](const std::vector<double>& values) {
    return std::set(values.begin(), values.end()).size();
  };
  return signal.at_name == "omega" && count(signal.companion.values) > count(signal.at);
}

}  // namespace

std::string residual_unit(const identify::Fit& fit, const identify::Experiments& experiments) {
  return unit_in(fit, signal_of(experiments, fit.signals.front()).unit);
}

void add_fit(const identify::Fit& fit, const identify::Experiments& experiments, Answer& answer) {
  Json& result = answer.result;
  result["parameters"] = Json::array();
  for (const identify::FittedParameter& fitted : fit.parameters) {
    Json item = {{"name", fitted.parameter.name},
                 {"unit", unit_in(fit, fitted.parameter.unit)},
                 {"value", fitted.value},
                 {"std", finite_or_null(fitted.std)},
                 {"interval95", pair_json(fitted.interval95)},
                 {"profile95", pair_json(fitted.profile95)},
                 {"at_bound", fitted.at_bound}};
    if (!fitted.reason.empty()) item["reason"] = fitted.reason;
    result["parameters"].push_back(std::move(item));
  }
  result["not_identifiable"] = Json::array();
  for (const identify::TradeOff& trade : fit.not_identifiable) {
    result["not_identifiable"].push_back({{"parameters", trade.parameters}, {"text", trade.text}});
    answer.warnings.push_back("not identifiable: " + trade.text);
  }
  result["residual"] = {{"rms", fit.signals.front().rms},
                        {"unit", residual_unit(fit, experiments)},
                        {"noise_units", finite_or_null(fit.noise_units)}};
  for (const std::string& warning : fit.warnings) answer.warnings.push_back(warning);
  if (std::isnan(fit.noise_units))
    result["residual"]["reason"] = "the noise of the readings is neither stated nor to be seen in them";
  result["signals"] = Json::array();
  for (const identify::FittedSignal& signal : fit.signals)
    result["signals"].push_back({{"record", experiments[signal.rows.experiment]->label},
                                 {"name", signal_of(experiments, signal).name},
                                 {"unit", unit_in(fit, signal_of(experiments, signal).unit)},
                                 {"readings", signal.rows.size()},
                                 {"independent", signal.independent},
                                 {"freedom", signal.freedom},
                                 {"rms", signal.rms},
                                 {"relative", signal.range > 0.0 ? Json(signal.rms / signal.range) : Json(nullptr)},
                                 {"noise", finite_or_null(signal.noise)},
                                 {"noise_units", finite_or_null(signal.noise_units)},
                                 {"p_value", finite_or_null(signal.p_value)},
                                 {"chi2_per_freedom", finite_or_null(signal.chi2_per_freedom)}});
  result["covariance"] = rows_json(fit.covariance);
  result["undetermined"] = rows_json(fit.undetermined.transpose());
  result["starts"] = fit.starts;
  answer.tables.push_back(parameter_table(fit));
}

void add_curves(const identify::Fit& fit, const identify::Experiments& experiments, const std::string& prefix,
                Answer& answer) {
  for (const identify::FittedSignal& fitted : fit.signals) {
    const identify::Signal& signal = signal_of(experiments, fitted);
    Table table{.name = prefix + "_" + std::to_string(fitted.rows.experiment) + "_" + signal.name,
                .is_long = true,
                .is_complete = true};
    Column at{.name = signal.at_name, .unit = unit_in(fit, signal.at_unit), .numbers = signal.at};
    const std::string unit = unit_in(fit, signal.unit);
    Column measured{.name = "measured", .unit = unit, .numbers = signal.measured};
    Column output{.name = prefix == "fit" ? "fitted" : "predicted", .unit = unit};
    Column residual{.name = "residual", .unit = unit};
    for (Eigen::Index i = fitted.rows.begin; i < fitted.rows.end; ++i) {
      output.numbers.push_back(fit.outputs[i]);
      residual.numbers.push_back(signal.measured[static_cast<std::size_t>(i - fitted.rows.begin)] - fit.outputs[i]);
    }
    table.columns = {std::move(at)};
    if (const identify::Companion& beside = signal.companion; !beside.values.empty())
      table.columns.push_back({.name = beside.name, .unit = unit_in(fit, beside.unit), .numbers = beside.values});
    if (has_more_values_beside(signal)) std::swap(table.columns.front(), table.columns.back());
    std::ranges::move(std::vector{std::move(measured), std::move(output), std::move(residual)},
                      std::back_inserter(table.columns));
    answer.tables.push_back(std::move(table));
  }
}

Json validation_json(const identify::Prediction& prediction) {
  Json json = {{"error", finite_or_null(prediction.error)},
               {"noise_units", finite_or_null(prediction.noise_units)},
               {"attainable", finite_or_null(prediction.attainable)},
               {"attainable_noise_units", finite_or_null(prediction.attainable_noise_units)},
               {"uncertainty", finite_or_null(prediction.uncertainty)},
               {"compromise",
                {{"statistic", finite_or_null(prediction.compromise.statistic)},
                 {"freedom", prediction.compromise.freedom},
                 {"p_value", finite_or_null(prediction.compromise.p_value)}}},
               {"wrong", prediction.is_wrong},
               {"text", prediction.text},
               {"bands", Json::array()}};
  for (const identify::PredictionBand& band : prediction.bands)
    json["bands"].push_back({{"from", band.from},
                             {"to", band.to},
                             {"error", band.error},
                             {"noise_units", finite_or_null(band.noise_units)}});
  return json;
}

ResultFields fit_fields() {
  return {
      {"law", "", "laws of the fit, + between laws in parallel"},
      {"parameters[].name", "",
       "name of a parameter; [1] after the name of a record's parameter: the second record"},
      {"parameters[].unit", "", "SI"},
      {"parameters[].value", "", "estimate"},
      {"parameters[].std", "", "standard error, allowing for residuals that are correlated from sample to sample"},
      {"parameters[].interval95[]", "", "95 % interval by the covariance, or by the profile if 'reason' says so"},
      {"parameters[].profile95[]", "", "95 % interval by the profile of the likelihood; null: no end on this side"},
      {"parameters[].at_bound", "", "the value lies at the end of its range"},
      {"parameters[].reason", "", "why a number is missing, or where the interval comes from"},
      {"not_identifiable[].parameters[]", "", "parameters that the data do not tell apart"},
      {"not_identifiable[].text", "", "how they compensate each other"},
      {"residual.rms", "", "rms of the residuals of the first signal"},
      {"residual.unit", "", "its unit"},
      {"residual.noise_units", "1",
       "rms of all residuals over the noise of their sensors; 'robust': without outliers"},
      {"residual.reason", "", "why noise_units is missing"},
      {"signals[].record", "", "data file, and label in it"},
      {"signals[].name", "", "x, v, a, phase, t (of extremes), force"},
      {"signals[].unit", "", "SI"},
      {"signals[].readings", "1", "number of readings"},
      {"signals[].independent", "1", "number of readings that count as independent"},
      {"signals[].freedom", "1", "readings that count, minus the number of parameters that they determine"},
      {"signals[].rms", "", "rms of the residuals"},
      {"signals[].relative", "1", "rms of the residuals over the rms of the signal about its mean"},
      {"signals[].noise", "", "noise level of the sensor: stated, or estimated from the signal's roughness"},
      {"signals[].noise_units", "1", "rms of the residuals over the noise level; 'robust': without outliers"},
      {"signals[].p_value", "1",
       "probability that the residuals are noise alone; null: too few readings, or no known noise"},
      {"signals[].chi2_per_freedom", "1",
       "variance of the residuals over that of the stated noise, per degree of freedom; null: no noise is stated"},
      {"covariance[][]", "",
       "covariance of the parameters, in their order, without changes along 'undetermined'; 0: no covariance"},
      {"undetermined[][]", "", "changes of the parameters, in their order, that the data do not show at any size"},
      {"fitted_readings[]", "1",
       "marks of the fitted readings, five numbers for each signal, by which 'predict' knows them again", true},
      {"starts", "1", "starts that were tried"},
      {"laws[].law", "", "laws that were compared, best first"},
      {"laws[].parameters", "1", "number of fitted parameters"},
      {"laws[].AICc", "1", "Akaike's criterion; the smallest is the best"},
      {"laws[].weight", "1", "Akaike's weight among the laws compared"},
      {"laws[].rms", "", "rms of the residuals of the first signal"},
      {"laws[].noise_units", "1", "rms of all residuals over the noise of their sensors"},
      {"laws[].reason", "", "why there is no fit"},
      {"rig", "",
       "title, system and drive of the fitted rig as text, for predictions; constants that the fit lacked are left "
       "out",
       true},
      {"scenario", "", "the fitted rig as the text of a scenario, with the first record's curve", true},
      {"scenarios[]", "", "the same for each record", true}};
}

ResultFields validation_fields(const std::string& prefix) {
  return {{prefix + "error", "1", "rms of the error of the prediction over the rms of the signal"},
          {prefix + "noise_units", "1", "the same over the noise of the sensors"},
          {prefix + "attainable", "1", "error that the same laws reach when they are fitted to this record itself"},
          {prefix + "attainable_noise_units", "1", "the same over the noise"},
          {prefix + "uncertainty", "1",
           "error to be expected from the uncertainty of the fitted parameters; null: the fit does not determine "
           "parameters that matter here"},
          {prefix + "compromise.statistic", "1",
           "-2 ln of the ratio of likelihoods: one set of parameters for the fitted records and these, over two "
           "sets"},
          {prefix + "compromise.freedom", "1", "its degrees of freedom: parameters that the fit determines"},
          {prefix + "compromise.p_value", "1",
           "probability of a larger statistic if one rig made both; null: the fit determines no parameter, or "
           "these records do not determine the rig"},
          {prefix + "wrong", "", "the law, or the rig, is not that of the fitted records"},
          {prefix + "text", "", "the conclusion as a sentence"},
          {prefix + "bands[].from", "Hz", "lower end of a band of frequencies"},
          {prefix + "bands[].to", "Hz", "its upper end"},
          {prefix + "bands[].error", "1", "rms of the error in the band over the rms of the whole signal"},
          {prefix + "bands[].noise_units", "1", "the same over the noise in the band"}};
}

}  // namespace dualdamp::scenarios
