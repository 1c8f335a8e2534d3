#include "scenarios/measurements/method_choice.hpp"

#include <algorithm>

#include "core/diagnostics.hpp"
#include "identify/records/derived_records.hpp"

namespace dualdamp::scenarios {

namespace {

/// Why the histories hold no free vibration, what would do, and which rows were not searched for one.
std::string why_no_decay(const std::vector<identify::Record>& records) {
  std::string text;
  for (const identify::Record& record : records) {
    if (record.histories.empty()) continue;
    const std::string fault = identify::decay_of(record.histories.front()).fault;
    if (!fault.empty()) text += ": " + fault + "; needed are four extremes, so two periods after a release";
    break;
  }
  for (const identify::Record& record : records)
    for (const identify::History& history : record.histories)
      if (!history.gaps.empty()) text += "; " + history.gaps;
  return text;
}

/// Why histories give no x-Y pairs.
std::string why_no_pairs(const std::vector<identify::Record>& records) {
  for (const identify::Record& record : records)
    for (const identify::History& history : record.histories)
      if (!history.no_pair.empty()) return ": " + history.no_pair;
  for (const identify::Record& record : records) {
    if (record.pairs) continue;
    for (const std::string& why : identify::pairs_of(record.histories).lacking)
      if (!why.empty()) return ": " + why;
  }
  return {};
}

}  // namespace

Field methods_key(const std::string& all) {
  std::vector<std::string> names;
  for (const identify::MethodEntry& method : identify::methods()) names.emplace_back(method.name);
  return word_list("methods", std::move(names), "identification methods; default: " + all);
}

void resolve_methods(CheckedFile& file, const std::vector<identify::Record>& records, SlowMethods slow) {
  const auto lack_of = [&](const identify::MethodEntry& method) {
    for (const identify::Record& record : records)
      if (std::string lack = method.lacks(record); !lack.empty()) return lack;
    return std::string();
  };
  std::vector<std::string> fitting;
  std::vector<std::string> chosen;
  for (const identify::MethodEntry& method : identify::methods()) {
    if (!lack_of(method).empty()) continue;
    fitting.emplace_back(method.name);
    if (slow == SlowMethods::run || !method.takes_seconds) chosen.emplace_back(method.name);
  }

  const Json& analysis = file.values().at("analysis");
  if (!file.stands_in_file("analysis", "methods")) {
    file.fill_in("methods", chosen);
  } else if (analysis.contains("methods")) {
    for (std::size_t i = 0; i < analysis.at("methods").size(); ++i) {
      const auto name = analysis.at("methods")[i].get<std::string>();
      const identify::MethodEntry& method = *identify::find_method(name);
      std::string lack = lack_of(method);
      if (lack.empty()) continue;
      if (method.needs == identify::RecordKind::decay) lack += why_no_decay(records);
      if (identify::reads_pairs(method.needs)) lack += why_no_pairs(records);
      file.complain("analysis.methods[" + std::to_string(i) + "]", "method '" + name + "' cannot be used: " + lack,
                    core::joined(fitting));
    }
  }
}

std::vector<const identify::MethodEntry*> methods_of(const Json& names) {
  std::vector<const identify::MethodEntry*> methods;
  for (const Json& name : names) methods.push_back(identify::find_method(name.get<std::string>()));
  return methods;
}

}  // namespace dualdamp::scenarios
