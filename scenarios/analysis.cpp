#include "scenarios/analysis.hpp"

#include <algorithm>

namespace dualdamp::scenarios {

const Analysis* find_analysis(const AnalysisList& list, std::string_view name) {
  const auto found = std::ranges::find(list, name, [](const Analysis* analysis) { return analysis->name; });
  return found == list.end() ? nullptr : *found;
}

std::vector<ResultField> result_fields(const Analysis& analysis, const Json& section) {
  std::vector<ResultField> fields = analysis.results;
  for (const Field& field : analysis.keys.fields) {
    if (field.kind != Kind::choice || field.choice->key.empty() || !section.contains(field.name)) continue;
    const Json& chosen = section.at(field.name);
    if (!chosen.is_object() || !chosen.contains(field.choice->key)) continue;
    const Variant* variant = field.choice->find(chosen.at(field.choice->key).get<std::string>());
    if (variant != nullptr) fields.insert(fields.end(), variant->results.begin(), variant->results.end());
  }
  return fields;
}

}  // namespace dualdamp::scenarios
