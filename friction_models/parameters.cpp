#include "friction_models/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"

namespace dualdamp::friction {

namespace {

using Value = ParameterValues::Value;
using List = std::vector<ParameterValues>;

std::string with_unit(double value, std::string_view unit) {
  std::string text = core::format_number(value);
  if (!unit.empty() && unit != "1") text += " " + std::string(unit);
  return text;
}

std::string names(const std::vector<Parameter>& table) {
  std::vector<std::string_view> list;
  for (const Parameter& parameter : table) list.push_back(parameter.name);
  return list.empty() ? "no parameter" : core::joined(list);
}

std::string shown(const Value& value, std::string_view unit) {
  if (const auto* number = std::get_if<double>(&value)) return with_unit(*number, unit);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  return std::to_string(std::get<List>(value).size()) + " records";
}

bool is_numeric(ParameterKind kind) {
  return kind == ParameterKind::number || kind == ParameterKind::count || kind == ParameterKind::seed;
}

bool is_of_kind(const Value& value, ParameterKind kind) {
  switch (kind) {
    case ParameterKind::choice:
      return std::holds_alternative<std::string>(value);
    case ParameterKind::flag:
      return std::holds_alternative<bool>(value);
    case ParameterKind::record:
      return std::holds_alternative<List>(value) && std::get<List>(value).size() == 1;
    case ParameterKind::list:
      return std::holds_alternative<List>(value);
    default:
      return std::holds_alternative<double>(value);
  }
}

/// Checks the values of one table; `prefix` is the path of a record: "elements[2].".
class Completion {
 public:
  Completion(const std::vector<Parameter>& table, ParameterValues& values, std::string prefix,
             std::vector<ParameterFault>& faults)
      : table_(table), values_(values), prefix_(std::move(prefix)), faults_(faults) {}

  void run() {
    refuse_unknown();
    for (const Parameter& parameter : table_) {
      if (!parameter.instead_of.empty() && values_.has(parameter.instead_of)) {
        refuse_beside_other_form(parameter);
        continue;
      }
      fill_in_default(parameter);
      if (Value* value = values_.find(parameter.name))
        check(parameter, *value);
      else if (is_missing(parameter))
        complain_about_missing(parameter);
    }
  }

 private:
  void complain(const Parameter& parameter, const std::string& what, std::string allowed, std::string found) {
    const std::string name = prefix_ + std::string(parameter.name);
    faults_.push_back({name, "'" + name + "' " + what, std::move(allowed), std::move(found)});
  }

  void refuse_unknown() {
    for (const auto& [name, value] : values_.values())
      if (std::ranges::find(table_, std::string_view(name), &Parameter::name) == table_.end())
        faults_.push_back({prefix_ + name, "there is no parameter '" + prefix_ + name + "'", names(table_), name});
  }

  void refuse_beside_other_form(const Parameter& parameter) {
    if (const Value* value = values_.find(parameter.name))
      complain(parameter, "stands beside '" + std::string(parameter.instead_of) + "', which it replaces",
               "one of the two", shown(*value, values_.unit(parameter.unit)));
  }

  /// Whether no parameter of the form without `name` is given.
  [[nodiscard]] bool other_form_is_absent(std::string_view name) const {
    return std::ranges::none_of(table_, [&](const Parameter& other) {
      return other.instead_of == name && !name.empty() && values_.has(other.name);
    });
  }

  /// Where both forms are absent only the first is missing.
  [[nodiscard]] bool is_missing(const Parameter& parameter) const {
    if (!parameter.required()) return false;
    if (parameter.instead_of.empty()) return other_form_is_absent(parameter.name);
    return !other_form_is_absent(parameter.instead_of);
  }

  void complain_about_missing(const Parameter& parameter) {
    const std::string others = core::joined(names_instead_of(table_, parameter.name));
    complain(parameter, "is missing",
             parameter.describe(values_.coordinate()) + (others.empty() ? "" : "; or " + others + " instead"), {});
    faults_.back().is_missing = true;
  }

  void fill_in_default(const Parameter& parameter) {
    if (values_.has(parameter.name)) return;
    // A default is no part of a form that is not given: with both absent the first one is missing.
    if (!parameter.instead_of.empty() && other_form_is_absent(parameter.instead_of)) return;
    if (parameter.fallback) {
      values_.set(parameter.name, *parameter.fallback);
    } else if (const Value* twin = values_.find(parameter.same_as)) {
      values_.set(parameter.name, Value(*twin));
    }
  }

  void check(const Parameter& parameter, Value& value) {
    if (!is_of_kind(value, parameter.kind))
      return complain(parameter, "is of the wrong kind", parameter.describe(values_.coordinate()),
                      shown(value, values_.unit(parameter.unit)));
    if (is_numeric(parameter.kind)) {
      check_number(parameter, std::get<double>(value));
    } else if (parameter.kind == ParameterKind::choice) {
      const auto& word = std::get<std::string>(value);
      if (std::ranges::find(parameter.words, word) == parameter.words.end())
        complain(parameter, "cannot be '" + word + "'", parameter.describe(values_.coordinate()), word);
    } else if (parameter.kind != ParameterKind::flag) {
      check_records(parameter, std::get<List>(value));
    }
    refuse_beside(parameter, value);
  }

  void refuse_beside(const Parameter& parameter, const Value& value) {
    const Value* other = values_.find(parameter.not_beside);
    const auto* number = other == nullptr ? nullptr : std::get_if<double>(other);
    if (number != nullptr && *number != 0.0)
      complain(parameter, "is not possible beside '" + std::string(parameter.not_beside) + "'", "one of the two",
               shown(value, values_.unit(parameter.unit)));
  }

  void check_number(const Parameter& parameter, double value) {
    const std::string found = with_unit(value, values_.unit(parameter.unit));
    if (!std::isfinite(value)) return complain(parameter, "is not finite", "a finite number", found);
    if (parameter.kind != ParameterKind::number && value != std::floor(value))
      return complain(parameter, "is not a whole number", parameter.describe(values_.coordinate()), found);
    const Range range = parameter.allowed_range();
    if (!range.contains(value))
      return complain(parameter, "is out of range", range.describe(values_.unit(parameter.unit)), found);
    const Value* floor = values_.find(parameter.at_least);
    const auto* least = floor == nullptr ? nullptr : std::get_if<double>(floor);
    if (least != nullptr && value < *least)
      complain(parameter, "is below '" + std::string(parameter.at_least) + "'",
               ">= " + with_unit(*least, values_.unit(parameter.unit)), found);
  }

  void check_records(const Parameter& parameter, List& records) {
    const bool is_list = parameter.kind == ParameterKind::list;
    if (is_list && (records.empty() || records.size() > parameter.max_items))
      return complain(parameter, "has the wrong number of items", parameter.describe(values_.coordinate()),
                      std::to_string(records.size()));
    const std::string name = prefix_ + std::string(parameter.name);
    for (std::size_t i = 0; i < records.size(); ++i) {
      const std::string index = is_list ? "[" + std::to_string(i) + "]" : "";
      Completion(parameter.fields, records[i], name + index + ".", faults_).run();
    }
  }

  const std::vector<Parameter>& table_;
  ParameterValues& values_;
  std::string prefix_;
  std::vector<ParameterFault>& faults_;
};

}  // namespace

ParameterValues::ParameterValues(std::initializer_list<Map::value_type> values) : values_(values) {}

const ParameterValues::Value* ParameterValues::find(std::string_view name) const {
  const auto found = values_.find(name);
  return found == values_.end() ? nullptr : &found->second;
}

ParameterValues::Value* ParameterValues::find(std::string_view name) {
  const auto found = values_.find(name);
  return found == values_.end() ? nullptr : &found->second;
}

const ParameterValues::Value& ParameterValues::at(std::string_view name) const {
  if (const Value* value = find(name)) return *value;
  throw std::out_of_range("no parameter '" + std::string(name) + "'");
}

double ParameterValues::number(std::string_view name) const { return std::get<double>(at(name)); }

std::size_t ParameterValues::count(std::string_view name) const { return static_cast<std::size_t>(number(name)); }

std::uint64_t ParameterValues::seed(std::string_view name) const {
  return static_cast<std::uint64_t>(number(name));
}

const std::string& ParameterValues::choice(std::string_view name) const { return std::get<std::string>(at(name)); }

bool ParameterValues::flag(std::string_view name) const { return std::get<bool>(at(name)); }

const ParameterValues& ParameterValues::record(std::string_view name) const { return list(name).at(0); }

const std::vector<ParameterValues>& ParameterValues::list(std::string_view name) const {
  return std::get<List>(at(name));
}

void ParameterValues::set(std::string_view name, Value value) {
  values_.insert_or_assign(std::string(name), std::move(value));
}

void ParameterValues::erase(std::string_view name) { values_.erase(std::string(name)); }

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

std::string Parameter::describe(core::Coordinate coordinate) const {
  switch (kind) {
    case ParameterKind::number:
      return range.describe(core::unit_for(coordinate, unit));
    case ParameterKind::count:
    case ParameterKind::seed:
      return "a whole number, " + allowed_range().describe(unit);
    case ParameterKind::choice:
      return core::joined(words);
    case ParameterKind::flag:
      return "true, false";
    case ParameterKind::record:
      return "a record of " + names(fields);
    case ParameterKind::list:
      break;
  }
  return "a list of 1 to " + std::to_string(max_items) + " records of " + names(fields);
}

std::string describe_default(const std::vector<Parameter>& table, const Parameter& parameter) {
  if (parameter.fallback) return shown(*parameter.fallback, "1");
  if (!parameter.same_as.empty()) return "that of '" + std::string(parameter.same_as) + "'";
  if (parameter.is_optional) return {};
  if (!parameter.instead_of.empty()) return "required without '" + std::string(parameter.instead_of) + "'";
  const std::string others = core::joined(names_instead_of(table, parameter.name));
  return others.empty() ? "required" : "required, or " + others;
}

std::vector<std::string> names_instead_of(const std::vector<Parameter>& table, std::string_view name) {
  std::vector<std::string> result;
  for (const Parameter& parameter : table)
    if (!name.empty() && parameter.instead_of == name) result.emplace_back(parameter.name);
  return result;
}

std::vector<ParameterFault> complete(const std::vector<Parameter>& table, ParameterValues& values) {
  std::vector<ParameterFault> faults;
  Completion(table, values, "", faults).run();
  return faults;
}

}  // namespace dualdamp::friction
