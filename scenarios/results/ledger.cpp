#include "scenarios/results/ledger.hpp"

#include "core/numbers.hpp"
#include "identify/methods.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

namespace {

using identify::LedgerEntry;

/// Methods whose estimates rest on an assumption.
std::vector<std::string> methods_on(const identify::Identification& found, identify::Assumption assumption) {
  std::vector<std::string> names;
  for (const identify::Estimate& estimate : found.estimates) {
    const identify::MethodEntry* method = identify::find_method(estimate.method);
    if (method != nullptr && method->rests_on.contains(assumption)) names.push_back(estimate.method);
  }
  return names;
}

Json number(const std::optional<double>& value) { return value ? finite_or_null(*value) : Json(nullptr); }

Json entry_json(const LedgerEntry& entry, const identify::Identification& found) {
  return {{"name", identify::name_of(entry.assumption)},
          {"status", identify::name_of(entry.standing)},
          {"test", entry.test.empty() ? Json(nullptr) : Json(entry.test)},
          {"p_value", number(entry.p_value)},
          {"zeta_change", number(entry.zeta_change)},
          {"F0_change", number(entry.F0_change)},
          {"reason", entry.reason},
          {"methods", methods_on(found, entry.assumption)}};
}

/// The interval and what no test excludes beyond it, with the names of what ends it.
Json range_json(const identify::Identification& found) {
  if (!found.range) return nullptr;
  Json json = interval_json(found.range->ends);
  json["zeta_by"] = found.range->zeta_by;
  json["F0_by"] = found.range->F0_by;
  return json;
}

Json answer_json(const identify::Identification& found) {
  const identify::Estimate& best = found.estimates[*found.answer];
  return {{"method", best.method},
          {"zeta", finite_or_null(best.value.zeta)},
          {"c", finite_or_null(best.value.c)},
          {"x_f", finite_or_null(best.value.x_f)},
          {"F0", finite_or_null(best.value.F0)},
          {"std", best.std ? parameters_json(*best.std) : Json(nullptr)},
          {"interval95", best.interval95 ? interval_json(*best.interval95) : Json(nullptr)},
          {"range", range_json(found)},
          {"reason", found.reason}};
}

Table assumption_table(const std::vector<LedgerEntry>& entries) {
  const auto text = [&](const std::string& name, auto get) { return text_column(name, entries, get); };
  const auto real = [&](const std::string& name, std::optional<double> LedgerEntry::* member) {
    return column(name, "", entries, [member](const LedgerEntry& entry) { return (entry.*member).value_or(none); });
  };
  return {"assumptions",
          {text("name", [](const LedgerEntry& e) { return std::string(identify::name_of(e.assumption)); }),
           text("status", [](const LedgerEntry& e) { return std::string(identify::name_of(e.standing)); }),
           text("test", [](const LedgerEntry& e) { return e.test; }), real("p_value", &LedgerEntry::p_value),
           real("zeta_change", &LedgerEntry::zeta_change), real("F0_change", &LedgerEntry::F0_change),
           text("reason", [](const LedgerEntry& e) { return e.reason; })},
          true};
}

/// The table of assumptions for a terminal.
Table readable_assumptions(const std::vector<LedgerEntry>& entries) {
  const auto text = [&](const std::string& name, auto get) { return text_column(name, entries, get); };
  Table table{
      "assumptions",
      {text("assumption", [](const LedgerEntry& e) { return std::string(identify::name_of(e.assumption)); }),
       text("status", [](const LedgerEntry& e) { return std::string(identify::name_of(e.standing)); }),
       text("relaxed: zeta", [](const LedgerEntry& e) { return change_text(e.zeta_change.value_or(none)); }),
       text("F0", [](const LedgerEntry& e) { return change_text(e.F0_change.value_or(none)); }),
       text("p",
            [](const LedgerEntry& e) {
              constexpr int digits = 2;
              return e.p_value ? core::format_number(*e.p_value, digits) : std::string("-");
            }),
       text("set free", [](const LedgerEntry& e) { return e.test.empty() ? std::string("-") : e.test; }),
       text("", [](const LedgerEntry& e) { return e.reason; })}};
  table.is_file = false;
  return table;
}

}  // namespace

void add_ledger(const identify::Identification& found, Answer& answer) {
  answer.result["answer"] = found.answer ? answer_json(found) : Json(nullptr);
  answer.result["answer_reason"] = found.reason;
  if (!found.answer) {
    answer.status = core::ExitStatus::numerical_failure;
    answer.failure = "there is no answer: " + found.reason;
  }
  answer.result["family_level"] = identify::family_level;
  answer.result["assumptions"] = Json::array();
  for (const LedgerEntry& entry : found.ledger.entries)
    answer.result["assumptions"].push_back(entry_json(entry, found));
  answer.result["tested"] = found.ledger.data.empty() ? Json(nullptr) : Json(found.ledger.data);
  answer.result["left_out"] = found.ledger.left_out;
  answer.result["verdict"] = found.verdict;
  answer.tables.push_back(readable_assumptions(found.ledger.entries));
  answer.tables.push_back(assumption_table(found.ledger.entries));
  for (const std::string& sentence : found.ledger.warnings) answer.warnings.push_back(sentence);
  for (const std::string& sentence : found.ledger.left_out) answer.warnings.push_back("not tested: " + sentence);
}

ResultFields ledger_fields() {
  ResultFields fields = {{"answer.method", "", "the method of the estimate to use"},
                         {"answer.reason", "", "why this estimate"},
                         {"answer_reason", "", "why this estimate, or why there is none and what would help"}};
  fields = joined(fields, parameter_fields("answer.", "", ""));
  fields = joined(fields, parameter_fields("answer.std.", "", "standard error of the "));
  fields = joined(fields, parameter_fields("answer.interval95.", "[]", "95 % interval of the "));
  fields = joined(
      fields, parameter_fields("answer.range.", "[]", "range that holds the interval and what no test excludes: "));
  return joined(fields,
                {{"answer.range.zeta_by[]", "",
                  "what moves zeta to each end of its range; empty: the interval reaches so far"},
                 {"answer.range.F0_by[]", "", "the same for F0"},
                 {"family_level", "1", "probability that any assumption is rejected in a record where all hold"},
                 {"tested", "", "the data in which the assumptions were tested"},
                 {"left_out[]", "", "parts of the record outside the conditions of the tests"},
                 {"assumptions[].name", "",
                  "constants, sensors, spring, one_mode, drive, stationarity, friction_velocity, "
                  "friction_displacement or symmetry"},
                 {"assumptions[].status", "", "holds, violated or untested"},
                 {"assumptions[].test", "", "what was relaxed to test it"},
                 {"assumptions[].p_value", "1", "p value, adjusted for all tests of the record"},
                 {"assumptions[].zeta_change", "1", "relative change of zeta when it is relaxed"},
                 {"assumptions[].F0_change", "1", "relative change of F0 when it is relaxed"},
                 {"assumptions[].reason", "",
                  "why it is untested, what else explains the departure, or how small a departure would be "
                  "detected"},
                 {"assumptions[].methods[]", "", "methods of this scenario whose estimates rest on it"}});
}

}  // namespace dualdamp::scenarios
