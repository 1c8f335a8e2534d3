#include "scenarios/format/law_values.hpp"

#include "core/numbers.hpp"
#include "scenarios/format/values.hpp"

namespace dualdamp::scenarios {

namespace {

using friction::Parameter;
using friction::ParameterKind;
using friction::ParameterValues;

ParameterValues::Value value_of(const Parameter& parameter, const Json& json, core::Coordinate coordinate) {
  switch (parameter.kind) {
    case ParameterKind::choice:
      return json.get<std::string>();
    case ParameterKind::flag:
      return json.get<bool>();
    case ParameterKind::record:
      return std::vector<ParameterValues>{law_values(parameter.fields, json, coordinate)};
    case ParameterKind::list: {
      std::vector<ParameterValues> records;
      for (const Json& item : json) records.push_back(law_values(parameter.fields, item, coordinate));
      return records;
    }
    default:
      return number(json);
  }
}

Json json_of(const Parameter& parameter, const ParameterValues& values) {
  switch (parameter.kind) {
    case ParameterKind::number: {
      const double value = values.number(parameter.name);
      // The format refuses bare frequencies.
      return parameter.unit == "rad/s" ? Json(core::format_number(value) + " rad/s") : Json(value);
    }
    case ParameterKind::count:
    case ParameterKind::seed:
      return values.seed(parameter.name);
    case ParameterKind::choice:
      return values.choice(parameter.name);
    case ParameterKind::flag:
      return values.flag(parameter.name);
    case ParameterKind::record:
      return law_json(parameter.fields, values.record(parameter.name));
    case ParameterKind::list:
      break;
  }
  Json list = Json::array();
  for (const ParameterValues& record : values.list(parameter.name))
    list.push_back(law_json(parameter.fields, record));
  return list;
}

}  // namespace

ParameterValues law_values(const std::vector<Parameter>& table, const Json& section, core::Coordinate coordinate) {
  ParameterValues values;
  values.measure(coordinate);
  if (!section.is_object()) return values;  // a faulty item of a list
  for (const Parameter& parameter : table)
    if (const auto found = section.find(std::string(parameter.name)); found != section.end())
      values.set(parameter.name, value_of(parameter, *found, coordinate));
  return values;
}

Json law_json(const std::vector<Parameter>& table, const ParameterValues& values) {
  Json json = Json::object();
  for (const Parameter& parameter : table)
    if (values.has(parameter.name)) json[std::string(parameter.name)] = json_of(parameter, values);
  return json;
}

}  // namespace dualdamp::scenarios
