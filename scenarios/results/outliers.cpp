#include "scenarios/results/outliers.hpp"

#include <cmath>
#include <string>

#include "core/numbers.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

namespace {

std::string rounded(double value) {
  constexpr int digits = 2;
  return core::format_number(value, digits);
}

}  // namespace

void add_outliers(const std::vector<identify::Outlier>& outliers, bool bounded, Answer& answer) {
  answer.result["outliers"] = Json::array();
  for (const identify::Outlier& outlier : outliers) {
    answer.result["outliers"].push_back(
        {{"reading", outlier.reading}, {"deviations", outlier.deviations}, {"weight", outlier.weight}});
    answer.warnings.push_back(
        outlier.reading + " lies " + rounded(std::abs(outlier.deviations)) + " standard deviations " +
        (outlier.deviations > 0.0 ? "above" : "below") + " what the others say" +
        (bounded ? "; it counts " + rounded(outlier.weight) + " of a reading" : "; 'robust' bounds its influence"));
  }
}

void add_sensitivities(const std::vector<identify::Sensitivity>& sensitivities, Answer& answer) {
  answer.result["sensitivities"] = Json::array();
  for (const identify::Sensitivity& one : sensitivities)
    answer.result["sensitivities"].push_back({{"constant", one.constant},
                                              {"zeta_change", finite_or_null(one.zeta_change)},
                                              {"F0_change", finite_or_null(one.F0_change)}});
  if (sensitivities.empty()) return;
  using identify::Sensitivity;
  Table table{
      "sensitivities",
      {text_column("1 % more", sensitivities, &Sensitivity::constant),
       text_column("moves zeta by", sensitivities, [](const Sensitivity& s) { return change_text(s.zeta_change); }),
       text_column("F0 by", sensitivities, [](const Sensitivity& s) { return change_text(s.F0_change); })}};
  table.is_file = false;
  answer.tables.push_back(std::move(table));
}

ResultFields outlier_fields() {
  return {
      {"outliers[].reading", "", "a reading that does not agree with the others"},
      {"outliers[].deviations", "1", "how far off it lies, in standard deviations of the others"},
      {"outliers[].weight", "1", "its weight if 'robust' limits its influence"},
      {"sensitivities[].constant", "", "a constant whose uncertainty is not stated"},
      {"sensitivities[].zeta_change", "1", "relative change of the answer's zeta if the constant is 1 % larger"},
      {"sensitivities[].F0_change", "1", "relative change of the answer's F0 if the constant is 1 % larger"}};
}

}  // namespace dualdamp::scenarios
