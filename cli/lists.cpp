#include "cli/lists.hpp"

#include "cli/print.hpp"
#include "core/numbers.hpp"
#include "friction_models/registry.hpp"
#include "identify/methods.hpp"

namespace dualdamp::cli {

namespace {

using Rows = std::vector<std::vector<std::string>>;

template <typename Entries>
Listing unknown(const std::string& what, const std::string& name, const Entries& entries) {
  std::string names;
  for (const auto& entry : entries) names += (names.empty() ? "" : ", ") + std::string(entry.name);
  return {"there is no " + what + " '" + name + "'; there are: " + names, false};
}

std::string engine_name(friction::EngineKind kind) {
  return kind == friction::EngineKind::exact ? "exact" : "smooth";
}

std::string default_of(const friction::Parameter& parameter) {
  if (parameter.required()) return "required";
  return parameter.fallback ? core::format_number(*parameter.fallback)
                            : "that of " + std::string(parameter.same_as);
}

std::string needs_of(const identify::MethodEntry& method) {
  return method.needs == identify::RecordKind::pairs ? "x-Y pairs" : "extremes of a free decay";
}

}  // namespace

Listing list_laws(const std::string& name) {
  if (name.empty()) {
    Rows rows;
    for (const friction::LawEntry& law : friction::laws())
      rows.push_back({std::string(law.name), engine_name(law.engine), std::string(law.summary)});
    return {columns(rows)};
  }
  const friction::LawEntry* law = friction::find_law(name);
  if (law == nullptr) return unknown("law", name, friction::laws());
  Rows rows = {{"parameter", "unit", "default", "range", "meaning"}};
  for (const friction::Parameter& parameter : law->parameters) {
    std::string range = parameter.range.describe(parameter.unit);
    if (!parameter.at_least.empty()) range += ", >= " + std::string(parameter.at_least);
    rows.push_back({std::string(parameter.name), std::string(parameter.unit), default_of(parameter), range,
                    std::string(parameter.meaning)});
  }
  return {std::string(law->name) + ": " + std::string(law->summary) + "\n\n  " + std::string(law->equation) +
          "\n  engine: " + engine_name(law->engine) + "\n\n" + columns(rows)};
}

Listing list_methods(const std::string& name) {
  if (name.empty()) {
    Rows rows;
    for (const identify::MethodEntry& method : identify::methods())
      rows.push_back({std::string(method.name), needs_of(method), std::string(method.summary)});
    return {columns(rows)};
  }
  const identify::MethodEntry* method = identify::find_method(name);
  if (method == nullptr) return unknown("method", name, identify::methods());
  return {std::string(method->name) + ": " + std::string(method->summary) + "\n\n  " +
          std::string(method->equation) + "\n\n  needs: " + needs_of(*method) +
          "\n  assumes: " + std::string(method->assumes) + "\n"};
}

}  // namespace dualdamp::cli
