#include "friction_models/parameters.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"

namespace dualdamp::friction {

namespace {

std::string with_unit(double value, std::string_view unit) {
  std::string text = core::format_number(value);
  if (!unit.empty() && unit != "1") text += " " + std::string(unit);
  return text;
}

void fill_in_default(const Parameter& parameter, ParameterValues& values) {
  if (values.contains(parameter.name)) return;
  if (parameter.fallback) {
    values.emplace(parameter.name, *parameter.fallback);
  } else if (const auto twin = values.find(parameter.same_as); !parameter.same_as.empty() && twin != values.end()) {
    const double value = twin->second;
    values.emplace(parameter.name, value);
  }
}

/// The first thing wrong with one value, if anything.
std::optional<ParameterFault> fault_of(const Parameter& parameter, double value, const ParameterValues& values) {
  const std::string name(parameter.name);
  const std::string found = with_unit(value, parameter.unit);
  if (!std::isfinite(value)) return ParameterFault{name, "'" + name + "' is not finite", "a finite number", found};
  if (!parameter.range.contains(value))
    return ParameterFault{name, "'" + name + "' is out of range", parameter.range.describe(parameter.unit), found};
  const auto floor = values.find(parameter.at_least);
  if (!parameter.at_least.empty() && floor != values.end() && value < floor->second)
    return ParameterFault{name, "'" + name + "' is below '" + std::string(parameter.at_least) + "'",
                          ">= " + with_unit(floor->second, parameter.unit), found};
  return std::nullopt;
}

std::string names(const std::vector<Parameter>& table) {
  std::string text;
  for (const Parameter& parameter : table) {
    if (!text.empty()) text += ", ";
    text += parameter.name;
  }
  return text.empty() ? "no parameter" : text;
}

}  // namespace

bool Range::contains(double value) const {
  const bool above = low_open ? value > low : value >= low;
  const bool below = high_open ? value < high : value <= high;
  return above && below;
}

std::string Range::describe(std::string_view unit) const {
  std::string text;
  if (std::isfinite(low)) text = (low_open ? "> " : ">= ") + with_unit(low, unit);
  if (std::isfinite(high))
    text += (text.empty() ? "" : " and ") + std::string(high_open ? "< " : "<= ") + with_unit(high, unit);
  return text.empty() ? "any finite value" : text;
}

std::vector<ParameterFault> complete(const std::vector<Parameter>& table, ParameterValues& values) {
  std::vector<ParameterFault> faults;
  for (const auto& [name, value] : values)
    if (std::ranges::find(table, std::string_view(name), &Parameter::name) == table.end())
      faults.push_back({name, "there is no parameter '" + name + "'", names(table), name});

  for (const Parameter& parameter : table) {
    fill_in_default(parameter, values);
    const auto found = values.find(parameter.name);
    if (found != values.end()) {
      if (auto fault = fault_of(parameter, found->second, values)) faults.push_back(*std::move(fault));
    } else if (parameter.required()) {
      const std::string name(parameter.name);
      faults.push_back({name, "'" + name + "' is missing", parameter.range.describe(parameter.unit), {}});
    }
  }
  return faults;
}

}  // namespace dualdamp::friction
