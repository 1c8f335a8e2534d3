#include <map>

#include "bench/analyses.hpp"
#include "friction_models/registry.hpp"
#include "identify/methods.hpp"
#include "python/src/parts.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/scenario_format.hpp"

namespace dualdamp::python {

namespace {

using scenarios::Json;

Json json_of(const scenarios::Section& section);

std::string_view name_of(scenarios::Kind kind) {
  using enum scenarios::Kind;
  static const std::map<scenarios::Kind, std::string_view> names = {
      {text, "text"},         {word, "word"},       {boolean, "boolean"}, {integer, "integer"},
      {quantity, "quantity"}, {quantities, "list"}, {grid, "grid"},       {integers, "integers"},
      {word_list, "words"},   {scalar, "scalar"},   {choice, "mapping"},  {sweep, "mapping"}};
  return names.at(kind);
}

std::string_view name_of(friction::ParameterKind kind) {
  using enum friction::ParameterKind;
  static const std::map<friction::ParameterKind, std::string_view> names = {
      {number, "quantity"}, {count, "integer"},  {seed, "integer"}, {choice, "word"},
      {flag, "boolean"},    {record, "mapping"}, {list, "mappings"}};
  return names.at(kind);
}

Json json_of(const scenarios::Field& field) {
  Json json = {
      {"name", field.name},           {"kind", name_of(field.kind)}, {"listed", field.listed || field.only_listed},
      {"words", field.words},         {"meaning", field.meaning},    {"values", scenarios::describe_values(field)},
      {"required", field.is_required}};
  if (!field.units.empty()) json["unit"] = field.units.front();
  if (!field.fallback.is_null()) json["default"] = field.fallback.dump();
  if (!field.fallback_words.empty()) json["default"] = field.fallback_words;
  return json;
}

Json json_of(const scenarios::Section& section) {
  Json list = Json::array();
  for (const scenarios::Field& field : section.fields) list.push_back(json_of(field));
  return list;
}

Json json_of(const friction::LawEntry& law) {
  Json parameters = Json::array();
  for (const friction::Parameter& parameter : law.parameters) {
    std::string allowed = parameter.describe();
    if (!parameter.at_least.empty()) allowed += ", >= " + std::string(parameter.at_least);
    parameters.push_back({{"name", parameter.name},
                          {"kind", name_of(parameter.kind)},
                          {"listed", false},
                          {"words", parameter.words},
                          {"meaning", parameter.meaning},
                          {"values", allowed},
                          {"required", parameter.required() && parameter.instead_of.empty()},
                          {"unit", parameter.unit},
                          {"default", friction::describe_default(law.parameters, parameter)}});
  }
  return {{"name", law.name},         {"summary", law.summary},
          {"equation", law.equation}, {"engine", law.engine == friction::EngineKind::exact ? "exact" : "smooth"},
          {"caution", law.caution},   {"sources", law.sources},
          {"keys", parameters}};
}

Json json_of(const scenarios::Analysis& analysis) {
  Json results = Json::array();
  for (const scenarios::ResultField& field : analysis.results)
    results.push_back({{"path", field.path}, {"unit", field.unit}, {"meaning", field.meaning}});
  return {{"name", analysis.name},
          {"summary", analysis.summary},
          {"keys", json_of(analysis.keys)},
          {"results", results}};
}

Json json_of(const identify::MethodEntry& method) {
  Json options = Json::array();
  for (const identify::Option* option : method.options())
    options.push_back({{"name", option->name},
                       {"unit", option->unit},
                       {"default", option->otherwise},
                       {"values", option->describe()},
                       {"meaning", option->meaning}});
  return {{"name", method.name},         {"summary", method.summary}, {"assumes", method.assumes},
          {"equation", method.equation}, {"sources", method.sources}, {"needs", identify::describe(method.needs)},
          {"options", options}};
}

/// The alternative maps of a key of the format, by the name that chooses one.
Json json_of(const scenarios::Choice& choice) {
  Json list = Json::array();
  for (const scenarios::Variant& variant : choice.variants)
    list.push_back({{"name", variant.name}, {"summary", variant.summary}, {"keys", json_of(variant.section)}});
  return list;
}

std::string tables() {
  Json json = {{"laws", Json::array()}, {"analyses", Json::array()}, {"methods", Json::array()}};
  for (const friction::LawEntry& law : friction::laws()) json["laws"].push_back(json_of(law));
  for (const scenarios::Analysis* analysis : bench::analyses()) json["analyses"].push_back(json_of(*analysis));
  for (const identify::MethodEntry& method : identify::methods()) json["methods"].push_back(json_of(method));
  const scenarios::Section format = scenarios::scenario_format(bench::analyses());
  json["scenario"] = json_of(format);
  for (const char* key : {"system", "excitation", "initial", "numerics"})
    json[key] = json_of(*format.find(key)->choice);
  return json.dump();
}

}  // namespace

void add_tables(pybind11::module_& module) { module.def("tables", &tables); }

}  // namespace dualdamp::python
