#include "scenarios/results/laws.hpp"

#include "core/numbers.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

namespace {

using identify::LawAnswer;

Json ends_json(const identify::Interval& ends) {
  return Json::array({finite_or_null(ends[0]), finite_or_null(ends[1])});
}

Json both_json(const identify::Interval& zeta, const identify::Interval& F0) {
  return {{"zeta", ends_json(zeta)}, {"F0", ends_json(F0)}};
}

Json law_json(const LawAnswer& law) {
  return {{"name", law.name},
          {"p_value", finite_or_null(law.p_value)},
          {"rejected", law.rejected},
          {"severity", finite_or_null(law.severity)},
          {"zeta", finite_or_null(law.value.zeta)},
          {"F0", finite_or_null(law.value.F0)},
          {"zeta_interval95", ends_json(law.zeta_interval95)},
          {"F0_interval95", ends_json(law.F0_interval95)},
          {"weight", finite_or_null(law.weight)}};
}

Column with_ends(std::string name, std::string unit, const std::vector<LawAnswer>& laws,
                 double identify::ParameterSet::* member, identify::Interval LawAnswer::* interval) {
  Column cells{.name = std::move(name), .unit = std::move(unit)};
  cells.digits = 4;
  for (const LawAnswer& law : laws) {
    cells.numbers.push_back(law.value.*member);
    cells.intervals.push_back(law.*interval);
  }
  return cells;
}

Table readable_laws(const std::vector<LawAnswer>& laws, const identify::KnownConstants& constants) {
  constexpr int few = 2;
  const auto text = [&](const std::string& name, auto get) { return text_column(name, laws, get); };
  Table table{
      "friction laws",
      {text("law", [](const LawAnswer& law) { return law.name; }),
       text("", [](const LawAnswer& law) { return law.rejected ? "rejected" : "allowed"; }),
       text("p", [](const LawAnswer& law) { return core::format_number(law.p_value, few); }),
       text("severity", [](const LawAnswer& law) { return core::format_number(law.severity, few); }),
       with_ends("zeta (95 %)", "", laws, &identify::ParameterSet::zeta, &LawAnswer::zeta_interval95),
       with_ends("F0 (95 %)", constants.unit("N"), laws, &identify::ParameterSet::F0, &LawAnswer::F0_interval95),
       text("weight", [](const LawAnswer& law) { return core::format_number(law.weight, few); })}};
  table.is_file = false;
  return table;
}

Table law_file(const std::vector<LawAnswer>& laws) {
  const auto real = [&](const std::string& name, const std::string& unit, auto get) {
    return column(name, unit, laws, get);
  };
  return {"any_law",
          {text_column("law", laws, &LawAnswer::name),
           text_column("rejected", laws, [](const LawAnswer& law) { return law.rejected ? "yes" : "no"; }),
           real("p_value", "", [](const LawAnswer& law) { return law.p_value; }),
           real("severity", "", [](const LawAnswer& law) { return law.severity; }),
           real("zeta", "", [](const LawAnswer& law) { return law.value.zeta; }),
           real("zeta_low", "", [](const LawAnswer& law) { return law.zeta_interval95[0]; }),
           real("zeta_high", "", [](const LawAnswer& law) { return law.zeta_interval95[1]; }),
           real("F0", "N", [](const LawAnswer& law) { return law.value.F0; }),
           real("F0_low", "N", [](const LawAnswer& law) { return law.F0_interval95[0]; }),
           real("F0_high", "N", [](const LawAnswer& law) { return law.F0_interval95[1]; }),
           real("weight", "", [](const LawAnswer& law) { return law.weight; })},
          true};
}

}  // namespace

void add_laws(const identify::LawIntervals& laws, Json& estimate) {
  estimate["hull95"] = both_json(laws.zeta_hull, laws.F0_hull);
  estimate["average95"] = both_json(laws.zeta_average, laws.F0_average);
  estimate["inflation"] = finite_or_null(laws.inflation);
  estimate["laws"] = Json::array();
  for (const LawAnswer& law : laws.laws) estimate["laws"].push_back(law_json(law));
  estimate["aliases"] = laws.aliases;
  estimate["hull_ends"] = {{"zeta", laws.zeta_ends}, {"F0", laws.F0_ends}};
}

std::vector<Table> law_tables(const identify::LawIntervals& laws, const identify::KnownConstants& constants) {
  return {readable_laws(laws.laws, constants), law_file(laws.laws)};
}

ResultFields law_fields() {
  const std::string at = "estimates[].";
  const std::string law = at + "laws[].";
  return {{at + "hull95.zeta[]", "1", "any_law: ends of the union of the 95 % regions of all laws not rejected"},
          {at + "hull95.F0[]", "N", "any_law: the same of the friction force"},
          {at + "average95.zeta[]", "1", "any_law: 95 % interval of the average over laws"},
          {at + "average95.F0[]", "N", "any_law: the same of the friction force"},
          {at + "inflation", "1",
           "any_law: factor by which the noise must be larger so that the best law is not rejected"},
          {at + "hull_ends.zeta[]", "", "any_law: the laws at the lower and the upper end of the hull of zeta"},
          {at + "hull_ends.F0[]", "", "any_law: the laws at the lower and the upper end of the hull of F0"},
          {law + "name", "", "a law of the library, best first"},
          {law + "p_value", "1", "p value of the misfit of its best fit"},
          {law + "rejected", "", "p_value below 0.05"},
          {law + "severity", "1",
           "severity of its best fit: how far the law departs from Coulomb and viscous friction"},
          {law + "zeta", "1", "damping ratio of its best fit"},
          {law + "F0", "N", "friction force of its best fit"},
          {law + "zeta_interval95[]", "1", "95 % region over all severities"},
          {law + "F0_interval95[]", "N", "95 % region over all severities"},
          {law + "weight", "1", "weight in the average over laws"},
          {at + "aliases[][]", "", "names of laws that the record cannot tell apart"}};
}

}  // namespace dualdamp::scenarios
