#include "scenarios/schema.hpp"

#include <cmath>
#include <limits>

#include "core/units.hpp"
#include "scenarios/format/excitations.hpp"
#include "scenarios/format/limits.hpp"
#include "scenarios/scenario_format.hpp"

namespace dualdamp::scenarios {

namespace {

Json object_schema(const Section& section, const Choice* choice, const std::string& name);

/// Text as a regular expression that matches it.
std::string literal(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view(".^$*+?()[]{}|\\").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

/// Numbers of core/numbers.hpp; of the range only the sign is checked.
std::string number_pattern(const friction::Range& range) {
  const bool signless = range.low >= 0.0;
  const std::string digits = "(0|[1-9][0-9]*)(\\.[0-9]+)?([eE][+-]?[0-9]+)?";
  // A positive number has a digit other than 0 before its exponent.
  const bool positive = range.low > 0.0 || (range.low == 0.0 && range.low_open);
  return (signless ? "" : "-?") + std::string(positive ? "(?=[0-9.]*[1-9])" : "") + digits;
}

std::string quantity_pattern(const friction::Range& range, const std::string& unit) {
  std::string units;
  const auto add = [&](core::Coordinate coordinate) {
    for (const std::string_view name : core::usual_units(unit, coordinate))
      if (name != "1") units += (units.empty() ? "" : "|") + literal(name);
  };
  add(core::Coordinate::displacement);
  if (core::unit_for(core::Coordinate::angle, unit) != unit) add(core::Coordinate::angle);
  if (units.empty()) units = "[^0-9 ].*";
  return "^" + number_pattern(range) + " *(" + units + ")$";
}

/// The forms of core/uncertain_quantity.hpp, as far as a pattern can describe them.
std::string uncertain_pattern() { return "^\\(?[0-9.eE+-]+[^±+]*(±|\\+/?-) *[0-9].*$"; }

void add_range(Json& schema, const friction::Range& range) {
  if (std::isfinite(range.low)) schema[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
  if (std::isfinite(range.high)) schema[range.high_open ? "exclusiveMaximum" : "maximum"] = range.high;
}

Json number_schema(const friction::Range& range) {
  Json schema = {{"type", "number"}, {"not", {{"$ref", "#/definitions/not_finite"}}}};
  add_range(schema, range);
  return schema;
}

Json integer_schema(const friction::Range& range) {
  Json schema = {{"type", "integer"}};
  add_range(schema, range);
  return schema;
}

Json quantity_schema(const Field& field) {
  Json forms = Json::array();
  if (!field.words.empty()) forms.push_back({{"enum", field.words}});
  bool bare = false;
  for (const std::string& unit : field.units) {
    bare = bare || unit != "rad/s";
    forms.push_back({{"type", "string"}, {"pattern", quantity_pattern(field.range, unit)}});
  }
  if (field.takes_uncertainty) forms.push_back({{"type", "string"}, {"pattern", uncertain_pattern()}});
  if (bare) forms.push_back(number_schema(field.range));
  return forms.size() == 1 ? forms.front() : Json{{"anyOf", forms}};
}

Json list_schema(const Field& field, Json item) {
  Json schema = {
      {"type", "array"}, {"items", std::move(item)}, {"minItems", field.min_items}, {"maxItems", field.max_items}};
  if (field.kind == Kind::word_list) schema["uniqueItems"] = true;
  return schema;
}

/// Names that commas separate; `words`: those that are possible, empty: any.
std::string names_pattern(const std::vector<std::string>& words) {
  std::string name;
  for (const std::string& word : words) name += (name.empty() ? "" : "|") + literal(word);
  name = words.empty() ? "[^,]*[^, ][^,]*" : " *(" + name + ") *";
  return "^" + name + "(," + name + ")*$";
}

/// A map whose key selects the section: first the key, then the section with its name. So editors report faults of
/// that section only, not of all.
Json choice_schema(const Choice& choice, const std::string& name) {
  if (choice.key.empty()) return object_schema(choice.variants.front().section, nullptr, name);
  Json cases = Json::array();
  for (const Variant& variant : choice.variants) {
    Json section = object_schema(variant.section, &choice, variant.name);
    section["description"] = variant.summary;
    cases.push_back(
        {{"if", {{"properties", {{choice.key, {{"const", variant.name}}}}}}}, {"then", std::move(section)}});
  }
  return {{"type", "object"},
          {"required", Json::array({choice.key})},
          {"properties", {{choice.key, {{"enum", choice.names()}}}}},
          {"allOf", std::move(cases)}};
}

/// Paths are not checked, because the possible values depend on the key that the path names.
Json sweep_schema() {
  constexpr int most_keys = 2;
  Json number = {{"type", {"number", "string"}}};
  Json list = {{"type", "array"}, {"items", number}, {"minItems", 1}, {"maxItems", max_swept}};
  Json range = {{"type", "object"},
                {"properties",
                 {{"from", number},
                  {"to", number},
                  {"count", {{"type", "integer"}, {"minimum", 2}, {"maximum", max_swept}}},
                  {"spacing", {{"enum", {"linear", "log"}}}}}},
                {"required", {"from", "to", "count"}},
                {"additionalProperties", false}};
  return {{"type", "object"},
          {"minProperties", 1},
          {"maxProperties", most_keys},
          {"additionalProperties",
           {{"if", {{"type", "array"}}}, {"then", std::move(list)}, {"else", std::move(range)}}}};
}

Json field_form(const Field& field) {
  switch (field.kind) {
    case Kind::text:
      return {{"type", "string"}};
    case Kind::word:
      return {{"enum", field.words}};
    case Kind::boolean:
      return {{"type", "boolean"}};
    case Kind::integer:
      return integer_schema(field.range);
    case Kind::quantity:
      return quantity_schema(field);
    case Kind::quantities:
      return list_schema(field, quantity_schema(field));
    case Kind::grid:
      return {
          {"anyOf", {list_schema(field, quantity_schema(field)), object_schema(grid_section(field), nullptr, "")}}};
    case Kind::integers:
      return list_schema(field, integer_schema(field.range));
    case Kind::word_list:
      return {{"anyOf",
               {list_schema(field, field.words.empty() ? Json{{"type", "string"}} : Json{{"enum", field.words}}),
                {{"type", "string"}, {"pattern", names_pattern(field.words)}}}}};
    case Kind::scalar:
      return {{"anyOf", {number_schema({}), {{"type", "boolean"}}, {{"type", "string"}}}}};
    case Kind::sweep:
      return sweep_schema();
    case Kind::choice:
      break;
  }
  Json one = choice_schema(*field.choice, field.name);
  if (field.only_listed) return list_schema(field, std::move(one));
  if (!field.short_for.empty()) {
    const Json item = {{"anyOf", {{{"type", "string"}}, std::move(one)}}};
    return {{"anyOf", {{{"type", "string"}}, item.at("anyOf").at(1), list_schema(field, item)}}};
  }
  if (!field.listed) return one;
  // Not anyOf: an editor should report faults of the map or list that is there.
  Json list = list_schema(field, one);
  return {{"type", {"object", "array"}},
          {"if", {{"type", "object"}}},
          {"then", std::move(one)},
          {"else", std::move(list)}};
}

Json field_schema(const Field& field) {
  Json schema = field_form(field);
  schema["description"] = field.meaning;
  if (!field.fallback.is_null()) schema["default"] = field.fallback;
  return schema;
}

/// With the key `name` no key of the other form; without it, the keys that the other form requires.
Json either_form(const Section& section, const std::string& name) {
  Json any = Json::array();
  Json required = Json::array();
  for (const std::string& other : section.instead_of(name)) {
    any.push_back({{"required", {other}}});
    if (section.find(other)->is_required) required.push_back(other);
  }
  return {{"if", {{"required", {name}}}},
          {"then", {{"not", {{"anyOf", std::move(any)}}}}},
          {"else", {{"required", std::move(required)}}}};
}

Json object_schema(const Section& section, const Choice* choice, const std::string& variant) {
  Json properties = Json::object();
  Json required = Json::array();
  if (choice != nullptr) {
    properties[choice->key] = {{"const", variant}};
    required.push_back(choice->key);
  }
  for (const Field& field : section.fields) {
    properties[field.name] = field_schema(field);
    const bool is_of_two_forms = !field.instead_of.empty() || !section.instead_of(field.name).empty();
    if (field.is_required && !is_of_two_forms) required.push_back(field.name);
  }
  Json schema = {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!required.empty()) schema["required"] = std::move(required);
  Json conditions = Json::array();
  for (const Alternatives& alternatives : section.alternatives) {
    Json forms = Json::array();
    for (const std::string& name : alternatives.names) forms.push_back({{"required", {name}}});
    if (!alternatives.is_required) forms.push_back({{"not", {{"anyOf", forms}}}});
    conditions.push_back({{"oneOf", std::move(forms)}});
  }
  for (const Field& field : section.fields)
    if (!section.instead_of(field.name).empty()) conditions.push_back(either_form(section, field.name));
  if (!conditions.empty()) schema["allOf"] = std::move(conditions);
  return schema;
}

Json has_type(const std::string& section, const std::string& type) {
  return {{"required", {section}},
          {"properties", {{section, {{"required", {"type"}}, {"properties", {{"type", {{"const", type}}}}}}}}}};
}

/// The condition under which a row of needs holds.
Json condition_of(const Analysis& owner, const Needs& row) {
  Json condition = has_type("analysis", std::string(owner.name));
  Json& analysis = condition["properties"]["analysis"];
  if (row.source == "data") {
    analysis["required"].push_back("data");
  } else if (!row.source.empty()) {
    analysis["required"].push_back("measurement");
    analysis["properties"]["measurement"] = {{"required", {"type"}},
                                             {"properties", {{"type", {{"const", row.source}}}}}};
  }
  return condition;
}

/// Requirements on the other sections under this condition.
Json demands_of(const Needs& row) {
  if (row.excitations.empty()) {
    Json forbidden = Json::array();
    for (const char* section : {"system", "excitation", "initial", "numerics"})
      forbidden.push_back({{"required", {section}}});
    return {{"not", {{"anyOf", forbidden}}}};
  }
  Json demands = {{"required", {"system"}},
                  {"properties", {{"excitation", {{"properties", {{"type", {{"enum", row.excitations}}}}}}}}}};
  const bool may_be_free = std::ranges::find(row.excitations, "none") != row.excitations.end();
  if (!may_be_free) demands["required"].push_back("excitation");
  if (row.whole_system)
    demands["properties"]["system"] = {
        {"required", {"mass"}},
        {"properties", {{"stiffness", {{"not", {{"const", 0}}}}}}},
        {"allOf",
         {{{"anyOf", {{{"required", {"stiffness"}}}, {{"required", {"gravity_stiffness"}}}}}},
          {{"anyOf", {{{"required", {"damping"}}}, {{"required", {"damping_ratio"}}}}}}}}};
  Json drive = Json::array();
  for (const std::string& type : row.excitations)
    if (excitations().find(type)->section.find("frequency") != nullptr && !row.drive.empty())
      drive.push_back(
          {{"if", {{"properties", {{"type", {{"const", type}}}}}}}, {"then", {{"required", row.drive}}}});
  if (!drive.empty()) demands["properties"]["excitation"]["allOf"] = std::move(drive);
  return demands;
}

}  // namespace

std::string json_schema(const AnalysisList& list) {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                 {"title", "dualdamp scenario"},
                 {"description", "Made by 'dualdamp schema' from the tables of the scenario reader."}};
  // YAML readers accept .inf and .nan. NaN passes any bound; the negation of a bound excludes it.
  constexpr double largest = std::numeric_limits<double>::max();
  schema["definitions"]["not_finite"] = {{"anyOf", {{{"minimum", largest}}, {{"maximum", -largest}}}}};
  schema.update(object_schema(scenario_format(list), nullptr, ""));
  schema["allOf"] = Json::array();
  for (const Analysis* analysis : list)
    for (const Needs& row : analysis->needs)
      schema["allOf"].push_back({{"if", condition_of(*analysis, row)}, {"then", demands_of(row)}});
  return schema.dump(1) + "\n";
}

}  // namespace dualdamp::scenarios
