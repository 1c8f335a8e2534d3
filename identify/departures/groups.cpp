#include "identify/departures/groups.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "friction_models/registry.hpp"

namespace dualdamp::identify::departures {

using friction::ParameterValues;

std::vector<Departure> joined(const std::vector<std::vector<Departure>>& groups) {
  std::vector<Departure> all;
  for (const std::vector<Departure>& group : groups) all.insert(all.end(), group.begin(), group.end());
  return all;
}

std::vector<Departure> of_family(Family family, std::vector<Departure> group) {
  for (Departure& departure : group)
    if (departure.family == Family::none) departure.family = family;
  return group;
}

sim::Model with_law(sim::Model model, std::string_view law, ParameterValues values) {
  const friction::LawEntry* entry = friction::find_law(law);
  if (entry == nullptr || !friction::complete(*entry, values).empty())
    throw std::logic_error("the law " + std::string(law) + " refuses the values of a table");
  for (friction::Law& part : entry->make(values)) model.friction.push_back(std::move(part));
  return model;
}

sim::Model with_coulomb(const RigBase& base, ParameterValues values) {
  values.set("kinetic", base.F0);
  return with_law(base.model, "coulomb", std::move(values));
}

sim::Model coulomb_viscous(const RigBase& base, DepartureValues) { return with_coulomb(base); }

std::vector<ParameterValues> warming(const RigBase& base, double power) {
  return {ParameterValues{{"power", power}, {"time_constant", base.warming_time}}};
}

double when_cold(const RigBase& base, double found, double heat, double power) {
  return base.found_at_reference ? found * std::exp(heat / power) : found;
}

}  // namespace dualdamp::identify::departures
