#include "cli/lists.hpp"

#include <type_traits>

#include "bench/analyses.hpp"
#include "cli/print.hpp"
#include "core/diagnostics.hpp"
#include "core/nearest.hpp"
#include "friction_models/registry.hpp"
#include "identify/methods.hpp"

namespace dualdamp::cli {

namespace {

using Rows = std::vector<std::vector<std::string>>;

template <typename Entry>
std::string name_of(const Entry& entry) {
  if constexpr (std::is_pointer_v<Entry>)
    return std::string(entry->name);
  else
    return std::string(entry.name);
}

template <typename Entries>
Listing unknown(const std::string& what, const std::string& name, const Entries& entries) {
  std::vector<std::string> names;
  for (const auto& entry : entries) names.push_back(name_of(entry));
  const std::string meant = core::nearest(name, names);
  return {"there is no " + what + " '" + name + "'; " +
              (meant.empty() ? "there are: " + core::joined(names) : "did you mean '" + meant + "'?"),
          false};
}

std::string engine_name(friction::EngineKind kind) {
  return kind == friction::EngineKind::exact ? "exact" : "smooth";
}

/// The rows of a table of parameters. The parameters of a record follow it.
void add_rows(Rows& rows, const std::vector<friction::Parameter>& table, const std::string& prefix) {
  for (const friction::Parameter& parameter : table) {
    const std::string name = prefix + std::string(parameter.name);
    std::string allowed = parameter.describe();
    if (!parameter.at_least.empty()) allowed += ", >= " + std::string(parameter.at_least);
    rows.push_back({name, std::string(parameter.unit), friction::describe_default(table, parameter), allowed,
                    std::string(parameter.meaning)});
    const bool is_list = parameter.kind == friction::ParameterKind::list;
    add_rows(rows, parameter.fields, name + (is_list ? "[]." : "."));
  }
}

/// The facts about a law besides its equation and parameters.
std::string facts_of(const friction::LawEntry& law) {
  Rows rows = {{"engine", engine_name(law.engine)},
               {"remembers", law.states.empty() ? "nothing" : std::string(law.states)},
               {"random", law.is_random ? "yes" : "no"},
               {"passive", law.is_passive ? "yes" : "no: it may give out more work than it took in"}};
  if (!law.caution.empty()) rows.push_back({"caution", std::string(law.caution)});
  if (law.plugin) {
    if (!law.sources.empty()) rows.push_back({"sources", std::string(law.sources)});
    rows.push_back({"plugin", law.plugin->file + ", version " + law.plugin->version});
    return folded_columns(rows);
  }
  rows.push_back({"sources", std::string(law.sources) + " in docs/refs.bib"});
  rows.push_back({"page", "docs/laws/" + std::string(law.name) + ".md"});
  return folded_columns(rows);
}

/// The keys of an analysis, without its type.
std::string keys_of(const scenarios::Analysis& analysis) {
  if (analysis.keys.fields.empty()) return {};
  Rows rows = {{"key", "values", "meaning"}};
  for (const scenarios::Field& field : analysis.keys.fields)
    rows.push_back({field.name, scenarios::describe_values(field), field.meaning});
  return "\n" + folded_columns(rows);
}

/// The fields of the result of an analysis.
std::string results_of(const scenarios::Analysis& analysis) {
  if (analysis.results.empty()) return {};
  Rows rows = {{"result", "unit", "meaning"}};
  for (const scenarios::ResultField& field : analysis.results)
    rows.push_back({field.path, field.unit == "1" ? "-" : field.unit, field.meaning});
  return "\n" + folded_columns(rows);
}

/// What an analysis needs, for each possible source of its data: "with data: a system, excitation none".
std::string facts_of(const scenarios::Analysis& analysis) {
  Rows rows;
  for (const scenarios::Needs& needs : analysis.needs)
    rows.push_back(
        {"needs", (needs.source.empty() ? "" : "with " + needs.source + ": ") +
                      (needs.excitations.empty() ? "no system"
                                                 : "a system, excitation " + core::joined(needs.excitations))});
  rows.push_back({"page", "docs/analyses.md"});
  return folded_columns(rows);
}

/// The table of a method's options.
std::string options_of(const identify::MethodEntry& method) {
  if (method.options().empty()) return "  options  none\n";
  Rows rows = {{"option", "unit", "default", "values", "meaning"}};
  for (const identify::Option* option : method.options()) {
    const bool is_flag = option->kind == identify::OptionKind::flag;
    rows.push_back({std::string(option->name), std::string(option->unit),
                    is_flag ? "false" : std::string(option->otherwise), option->describe(),
                    std::string(option->meaning)});
  }
  return "\n" + folded_columns(rows);
}

std::string needs_of(const identify::MethodEntry& method) { return std::string(identify::describe(method.needs)); }

std::string facts_of(const identify::MethodEntry& method) {
  return folded_columns({{"needs", needs_of(method)},
                         {"assumes", std::string(method.assumes)},
                         {"sources", std::string(method.sources) + " in docs/refs.bib"},
                         {"page", "docs/methods/" + std::string(method.name) + ".md"}});
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
  if (law == nullptr) {
    Listing listing = unknown("law", name, friction::laws());
    if (!listing.text.ends_with('?')) listing.text += "; or that of a plugin, with --plugin LIB";
    return listing;
  }
  Rows rows = {{"parameter", "unit", "default", "values", "meaning"}};
  add_rows(rows, law->parameters, "");
  return {std::string(law->name) + ": " + std::string(law->summary) + "\n\n  " + std::string(law->equation) +
          "\n\n" + facts_of(*law) + "\n" + folded_columns(rows)};
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
          std::string(method->equation) + "\n\n" + facts_of(*method) + options_of(*method)};
}

Listing list_analyses(const std::string& name) {
  if (name.empty()) {
    Rows rows;
    for (const scenarios::Analysis* analysis : bench::analyses())
      rows.push_back({std::string(analysis->name), std::string(analysis->summary)});
    return {columns(rows)};
  }
  const scenarios::Analysis* analysis = scenarios::find_analysis(bench::analyses(), name);
  if (analysis == nullptr) return unknown("analysis", name, bench::analyses());
  return {name + ": " + std::string(analysis->summary) + "\n\n" + facts_of(*analysis) + keys_of(*analysis) +
          results_of(*analysis)};
}

}  // namespace dualdamp::cli
