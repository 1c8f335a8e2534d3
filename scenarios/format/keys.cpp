#include "scenarios/format/keys.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "core/units.hpp"

namespace dualdamp::scenarios {

namespace {

Field make(Kind kind, std::string name, std::string meaning) {
  Field field;
  field.kind = kind;
  field.name = std::move(name);
  field.meaning = std::move(meaning);
  return field;
}

/// A list of a law: its items may lack numbers where those of the law may.
Field part_of_law(Field list) {
  Choice items = *list.choice;
  items.names_laws = true;
  list.choice = std::make_shared<const Choice>(std::move(items));
  return list;
}

/// Name, kind and meaning of a law's parameter.
Field plain_field_of(const friction::Parameter& parameter) {
  using friction::ParameterKind;
  std::string name(parameter.name);
  std::string meaning(parameter.meaning);
  switch (parameter.kind) {
    case ParameterKind::number:
      break;
    case ParameterKind::count:
    case ParameterKind::seed:
      return integer(std::move(name), std::move(meaning));
    case ParameterKind::choice:
      return words(std::move(name), {parameter.words.begin(), parameter.words.end()}, std::move(meaning));
    case ParameterKind::flag:
      return boolean(std::move(name), std::move(meaning));
    case ParameterKind::record:
      return section(std::move(name), {fields_of(parameter.fields)}, std::move(meaning));
    case ParameterKind::list:
      return part_of_law(section_list(std::move(name), {fields_of(parameter.fields)}, std::move(meaning)))
          .items(1, parameter.max_items);
  }
  return quantity(std::move(name), {std::string(parameter.unit)}, std::move(meaning));
}

/// A short list of keys is written out; a long one has its own table on the page.
std::string map_in_words(const Choice& choice) {
  if (!choice.key.empty()) return "a map with the key '" + choice.key + "'";
  constexpr std::size_t few = 5;
  const std::vector<Field>& fields = choice.variants.front().section.fields;
  if (fields.empty() || fields.size() > few) return "a map";
  std::vector<std::string> names;
  for (const Field& field : fields) names.push_back(field.name);
  return "a map of " + core::joined(names);
}

}  // namespace

Field&& Field::required() && {
  is_required = true;
  return std::move(*this);
}

Field&& Field::with_fallback(Json value) && {
  fallback = std::move(value);
  return std::move(*this);
}

Field&& Field::or_words(std::vector<std::string> list) && {
  words = std::move(list);
  return std::move(*this);
}

Field&& Field::above(double low) && {
  range.low = low;
  range.low_open = true;
  return std::move(*this);
}

Field&& Field::with_uncertainty() && {
  takes_uncertainty = true;
  return std::move(*this);
}

Field&& Field::at_least(double low) && {
  range.low = low;
  return std::move(*this);
}

Field&& Field::at_most(double high) && {
  range.high = high;
  return std::move(*this);
}

Field&& Field::items(std::size_t least, std::size_t most) && {
  min_items = least;
  max_items = most;
  return std::move(*this);
}

const Field* Section::find(std::string_view name) const {
  const auto found = std::ranges::find(fields, name, &Field::name);
  return found == fields.end() ? nullptr : &*found;
}

std::vector<std::string> Section::instead_of(std::string_view name) const {
  std::vector<std::string> result;
  for (const Field& field : fields)
    if (!field.instead_of.empty() && field.instead_of == name) result.push_back(field.name);
  return result;
}

const Variant* Choice::find(std::string_view name) const {
  const auto found = std::ranges::find(variants, name, &Variant::name);
  return found == variants.end() ? nullptr : &*found;
}

std::vector<std::string> Choice::names() const {
  std::vector<std::string> result;
  for (const Variant& variant : variants) result.push_back(variant.name);
  return result;
}

Field text(std::string name, std::string meaning) { return make(Kind::text, std::move(name), std::move(meaning)); }

Field words(std::string name, std::vector<std::string> list, std::string meaning) {
  return make(Kind::word, std::move(name), std::move(meaning)).or_words(std::move(list));
}

Field boolean(std::string name, std::string meaning) {
  return make(Kind::boolean, std::move(name), std::move(meaning));
}

Field integer(std::string name, std::string meaning) {
  return make(Kind::integer, std::move(name), std::move(meaning));
}

Field integers(std::string name, std::string meaning) {
  return make(Kind::integers, std::move(name), std::move(meaning));
}

Field word_list(std::string name, std::vector<std::string> list, std::string meaning) {
  const std::size_t count = list.size();
  return make(Kind::word_list, std::move(name), std::move(meaning)).or_words(std::move(list)).items(1, count);
}

Field name_list(std::string name, std::string meaning) {
  constexpr std::size_t most = 100;
  return make(Kind::word_list, std::move(name), std::move(meaning)).items(1, most);
}

Field scalar(std::string name, std::string meaning) {
  return make(Kind::scalar, std::move(name), std::move(meaning));
}

Field quantity(std::string name, std::vector<std::string> units, std::string meaning) {
  Field field = make(Kind::quantity, std::move(name), std::move(meaning));
  field.units = std::move(units);
  return field;
}

std::string uncertainty_key(const std::string& name) { return name + "_uncertainty"; }

Field uncertainty_of(const std::string& name, std::vector<std::string> units) {
  return quantity(uncertainty_key(name), std::move(units),
                  "standard uncertainty of '" + name + "'; it may also be written after the value: 2 +- 1 %")
      .at_least(0);
}

Field quantities(std::string name, std::vector<std::string> units, std::string meaning) {
  Field field = quantity(std::move(name), std::move(units), std::move(meaning));
  field.kind = Kind::quantities;
  return field;
}

Field grid(std::string name, std::vector<std::string> units, std::string meaning) {
  Field field = quantity(std::move(name), std::move(units), std::move(meaning));
  field.kind = Kind::grid;
  return field;
}

Field section(std::string name, Section section, std::string meaning) {
  return choice(std::move(name), Choice{{}, {{{}, {}, std::move(section)}}}, std::move(meaning));
}

Field section_list(std::string name, Section section, std::string meaning) {
  Field field = scenarios::section(std::move(name), std::move(section), std::move(meaning));
  field.listed = field.only_listed = true;
  return field;
}

Field choice(std::string name, Choice choice, std::string meaning) {
  Field field = make(Kind::choice, std::move(name), std::move(meaning));
  field.choice = std::make_shared<const Choice>(std::move(choice));
  return field;
}

std::vector<Field> fields_of(const std::vector<friction::Parameter>& table) {
  std::vector<Field> fields;
  for (const friction::Parameter& parameter : table) {
    Field field = plain_field_of(parameter);
    field.range = parameter.allowed_range();
    field.is_required = parameter.required();
    field.instead_of = parameter.instead_of;
    if (!field.is_required) field.fallback_words = friction::describe_default(table, parameter);
    fields.push_back(std::move(field));
  }
  return fields;
}

Section grid_section(const Field& grid) {
  const auto end = [&](std::string name, std::string meaning) {
    Field field = quantity(std::move(name), grid.units, std::move(meaning)).required();
    field.range = grid.range;
    return field;
  };
  return {{end("from", "first value"), end("to", "last value"),
           integer("count", "number of values, both ends included")
               .required()
               .at_least(2)
               .at_most(static_cast<double>(grid.max_items)),
           words("spacing", {"linear", "log"}, "equal steps, or equal ratios").with_fallback("linear")}};
}

std::string describe_values(const Field& field, core::Coordinate coordinate) {
  const std::string range = field.min_items == field.max_items
                                ? std::to_string(field.min_items)
                                : std::to_string(field.min_items) + " to " + std::to_string(field.max_items);
  const auto list = [&](const std::string& what) { return "a list of " + range + " " + what; };
  std::string numbers;
  for (const std::string& unit : field.units)
    numbers += (numbers.empty() ? "" : ", or ") + core::describe_dimension(unit, coordinate);
  const std::string unit =
      field.units.size() == 1 ? core::unit_for(coordinate, field.units.front()) : std::string();
  const bool bounded = std::isfinite(field.range.low) || std::isfinite(field.range.high);
  const std::string bounds = bounded ? field.range.describe(unit) : "";
  const auto with_bounds = [&](const std::string& what) { return bounded ? what + ", " + bounds : what; };

  switch (field.kind) {
    case Kind::text:
      return "a text";
    case Kind::word:
      return core::joined(field.words);
    case Kind::boolean:
      return "true, false";
    case Kind::integer:
      return with_bounds("a whole number");
    case Kind::quantity:
      return (field.words.empty() ? "" : core::joined(field.words) + ", or ") + with_bounds(numbers);
    case Kind::quantities:
      return list("quantities, each " + with_bounds(numbers));
    case Kind::grid:
      return list("quantities, each " + with_bounds(numbers)) + "; or {from, to, count, spacing}";
    case Kind::integers:
      return list("whole numbers" + (bounded ? ", each " + bounds : ""));
    case Kind::word_list:
      return "a list of " + (field.words.empty() ? "names" : core::joined(field.words)) +
             "; or a text that separates them by commas";
    case Kind::scalar:
      return "a number, true, false or a text";
    case Kind::sweep:
      return "a map of 1 or 2 paths, such as system.friction.kinetic, and their values: a list, or {from, to, "
             "count, spacing}";
    case Kind::choice:
      break;
  }
  const std::string map = map_in_words(*field.choice);
  if (!field.short_for.empty())
    return "a " + field.short_for + ", a map with the key '" + field.short_for + "', or " + list("of them");
  if (field.only_listed) return list("maps");
  return field.listed ? map + ", or " + list("such maps") : map;
}

}  // namespace dualdamp::scenarios
