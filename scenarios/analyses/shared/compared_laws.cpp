#include "scenarios/analyses/shared/compared_laws.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "core/diagnostics.hpp"
#include "core/units.hpp"
#include "friction_models/registry.hpp"

namespace dualdamp::scenarios {

namespace {

using friction::Parameter;
using friction::ParameterKind;

/// "iwan.count": the law and the name. Nothing if the name begins with no law.
struct NameOfLaw {
  std::string law;
  std::string name;
};

std::optional<NameOfLaw> name_of_law(const std::string& name) {
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos || friction::find_law(name.substr(0, dot)) == nullptr) return std::nullopt;
  return NameOfLaw{name.substr(0, dot), name.substr(dot + 1)};
}

const Parameter* parameter_of(const identify::Rig& rig, const std::string& name) {
  const std::vector<Parameter>& table = rig.laws.front().entry->parameters;
  const auto found = std::ranges::find(table, name, &Parameter::name);
  return found == table.end() ? nullptr : &*found;
}

std::string law_of(const identify::Rig& rig) { return std::string(rig.laws.front().entry->name); }

/// Sets one number of the law of a rig. Returns what is wrong with it.
std::string set_number(const Parameter& parameter, const std::string& text, identify::RigLaw& law) {
  if (parameter.kind != ParameterKind::number && parameter.kind != ParameterKind::count)
    return "it is no number: state it in a fit of this law alone";
  const core::Coordinate coordinate = law.values.coordinate();
  const std::string unit = parameter.kind == ParameterKind::number ? std::string(parameter.unit) : "1";
  const core::QuantityText quantity = core::parse_quantity(text, unit, coordinate);
  if (!quantity.value) return quantity.fault;
  const bool is_whole = std::floor(*quantity.value) == *quantity.value;
  if (!parameter.range.contains(*quantity.value) || (parameter.kind == ParameterKind::count && !is_whole))
    return "allowed is " + parameter.describe(coordinate);
  law.values.set(parameter.name, *quantity.value);
  return {};
}

/// The rigs whose law has the parameter: that of the law which the name states, or all that have it.
std::vector<identify::Rig*> rigs_with(const std::string& name, std::vector<identify::Rig>& rigs) {
  const std::optional<NameOfLaw> qualified = name_of_law(name);
  std::vector<identify::Rig*> found;
  for (identify::Rig& rig : rigs)
    if ((!qualified || qualified->law == law_of(rig)) &&
        parameter_of(rig, qualified ? qualified->name : name) != nullptr)
      found.push_back(&rig);
  return found;
}

std::string fault_of_statement(const std::string& name, const std::string& value,
                               std::vector<identify::Rig>& rigs) {
  const std::vector<identify::Rig*> found = rigs_with(name, rigs);
  if (found.empty()) return "no law of this fit has a parameter '" + name + "'";
  if (found.size() > 1) {
    std::vector<std::string> names;
    for (const identify::Rig* rig : found) names.push_back(law_of(*rig) + "." + name);
    return "'" + name + "' is a parameter of several laws: write " + core::joined(names, " or ");
  }
  const std::optional<NameOfLaw> qualified = name_of_law(name);
  const Parameter& parameter = *parameter_of(*found.front(), qualified ? qualified->name : name);
  const std::string fault = set_number(parameter, value, found.front()->laws.front());
  return fault.empty() ? fault : "'" + value + "' of " + name + ": " + fault;
}

}  // namespace

Sought sought_of_law(const Sought& sought, const std::vector<std::string>& laws, const std::string& law) {
  if (law.empty()) return sought;
  Sought own{.initial_is_known = sought.initial_is_known};
  const auto name_here = [&](const std::string& name) -> std::optional<std::string> {
    const std::optional<NameOfLaw> qualified = name_of_law(name);
    if (!qualified || std::ranges::find(laws, qualified->law) == laws.end()) return name;
    return qualified->law == law ? std::optional("friction." + qualified->name) : std::nullopt;
  };
  for (const std::string& name : sought.free)
    if (const auto here = name_here(name)) own.free.push_back(*here);
  for (const Bound& bound : sought.bounds)
    if (const auto here = name_here(bound.name)) own.bounds.push_back({*here, bound.low, bound.high});
  return own;
}

void state_values(const Json& analysis, std::vector<identify::Rig>& rigs, std::vector<SetupFault>& faults) {
  if (!analysis.contains("stated")) return;
  if (!analysis.contains("laws")) {
    faults.push_back(
        {"stated", "'stated' is for laws that are compared: 'system.friction' states the parameters of one law"});
    return;
  }
  for (const Json& item : analysis.at("stated")) {
    if (!item.is_object()) continue;  // one that could not be read has been reported
    std::string fault = fault_of_statement(item.value("name", ""), item.value("value", ""), rigs);
    if (!fault.empty()) faults.push_back({"stated", std::move(fault)});
  }
}

}  // namespace dualdamp::scenarios
