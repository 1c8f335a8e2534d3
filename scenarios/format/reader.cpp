#include "scenarios/format/reader.hpp"

#include <algorithm>
#include <cmath>

#include "core/diagnostics.hpp"
#include "core/nearest.hpp"
#include "core/numbers.hpp"
#include "core/uncertain_quantity.hpp"
#include "core/units.hpp"
#include "friction_models/registry.hpp"
#include "scenarios/format/law_values.hpp"
#include "scenarios/format/values.hpp"

namespace dualdamp::scenarios {

namespace {

/// Enough of a value to recognise it.
std::string shown(const Node& node) {
  switch (node.kind) {
    case Node::Kind::null:
      return "nothing";
    case Node::Kind::sequence:
      return "a list";
    case Node::Kind::map:
      return "a map";
    case Node::Kind::scalar:
      break;
  }
  return shortened(node.text);
}

bool is_number_like(std::string_view text) {
  return !text.empty() && (std::string_view("+-.0123456789").find(text.front()) != std::string_view::npos);
}

class Reader {
 public:
  /// `source`: what the coordinate is; nothing: not known, a displacement if need be.
  Reader(const Document& document, const std::optional<CoordinateSource>& source, bool laws_are_sought)
      : document_(document), laws_are_sought_(laws_are_sought) {
    reading_.coordinate = source;
    if (source) coordinate_ = source->coordinate;
  }

  Json section(const Node& node, const Section& section, const std::string& path, const Choice* choice) {
    Json values = Json::object();
    refuse_unknown(node, section, path, choice);
    for (const Field& field : section.fields) {
      const std::string field_path = path.empty() ? field.name : path + "." + field.name;
      if (const Entry* entry = node.find(field.name)) {
        if (stands_beside_other_form(node, field, *entry, field_path)) continue;
        Json value = this->value(entry->value, field, field_path);
        if (!value.is_null()) values[field.name] = std::move(value);
        if (field.takes_uncertainty) uncertainty(node, *entry, field, field_path, values);
      } else if (field.is_required && !(laws_are_sought_ && choice != nullptr && choice->names_laws)) {
        complain_about_missing(node, section, field, field_path);
      } else if (!field.fallback.is_null()) {
        values[field.name] = field.fallback;
      }
    }
    for (const Alternatives& alternatives : section.alternatives) check(node, alternatives, path);
    return values;
  }

  Reading take() { return std::move(reading_); }

  [[nodiscard]] const ToldCoordinate& told() const { return told_; }

 private:
  void complain(Place place, std::string message, std::string allowed = {}, std::string found = {},
                std::string suggestion = {}) {
    reading_.complain(document_, place, std::move(message), std::move(allowed), std::move(found),
                      std::move(suggestion));
  }

  void refuse_unknown(const Node& node, const Section& section, const std::string& path, const Choice* choice) {
    std::vector<std::string> names;
    if (choice != nullptr && !choice->key.empty()) names.push_back(choice->key);
    for (const Field& field : section.fields) names.push_back(field.name);
    const std::string where = path.empty() ? "" : " in '" + path + "'" + kind_of(node, choice);
    for (const Entry& entry : node.entries)
      if (std::ranges::find(names, entry.key) == names.end())
        complain(entry.place, "unknown key '" + shortened(entry.key) + "'" + where,
                 names.empty() ? "no key" : core::joined(names), {}, core::nearest(entry.key, names));
  }

  /// " of type none": what the keys depend on.
  static std::string kind_of(const Node& node, const Choice* choice) {
    if (choice == nullptr || choice->key.empty()) return {};
    const Entry* entry = node.find(choice->key);
    return entry == nullptr ? "" : " with " + choice->key + " " + entry->value.text;
  }

  void check(const Node& node, const Alternatives& alternatives, const std::string& path) {
    std::vector<const Entry*> given;
    for (const std::string& name : alternatives.names)
      if (const Entry* entry = node.find(name)) given.push_back(entry);
    const std::string list = core::joined(alternatives.names);
    const std::string where = path.empty() ? "the scenario" : "'" + path + "'";
    if (given.empty() && alternatives.is_required) complain(node.head(), where + " needs one of " + list, list);
    for (std::size_t i = 1; i < given.size(); ++i)
      complain(given[i]->place, where + " takes only one of " + list, "one of " + list,
               "'" + given[0]->key + "' in line " + std::to_string(given[0]->place.line) + " as well");
  }

  bool stands_beside_other_form(const Node& node, const Field& field, const Entry& entry, const std::string& path) {
    const Entry* other = field.instead_of.empty() ? nullptr : node.find(field.instead_of);
    if (other == nullptr) return false;
    complain(entry.place, "'" + path + "' stands beside '" + field.instead_of + "', which it replaces",
             "one of the two", "'" + other->key + "' in line " + std::to_string(other->place.line) + " as well");
    return true;
  }

  void complain_about_missing(const Node& node, const Section& section, const Field& field,
                              const std::string& path) {
    const auto any_given = [&](const std::vector<std::string>& names) {
      return std::ranges::any_of(names, [&](const std::string& name) { return node.find(name) != nullptr; });
    };
    std::string allowed = describe_values(field, coordinate_);
    if (!field.instead_of.empty()) {
      // If no key of either form is there, the first form is reported as missing, once.
      if (node.find(field.instead_of) != nullptr || !any_given(section.instead_of(field.instead_of))) return;
      return complain(node.head(), "'" + path + "' is missing: it is needed without '" + field.instead_of + "'",
                      std::move(allowed));
    }
    const std::vector<std::string> others = section.instead_of(field.name);
    if (any_given(others)) return;
    if (!others.empty()) allowed += "; or " + core::joined(others) + " instead";
    complain(node.head(), "'" + path + "' is missing", std::move(allowed));
  }

  /// null when the value is faulty; the fault is then reported.
  Json value(const Node& node, const Field& field, const std::string& path) {
    if (node.kind == Node::Kind::null) return nullptr;  // the tree has reported it
    reading_.places.emplace(path, node.place);
    switch (field.kind) {
      case Kind::choice:
        return map_or_list(node, field, path);
      case Kind::sweep:
        return nullptr;  // read before all others: swept_keys.hpp
      case Kind::grid:
        return node.kind == Node::Kind::map ? range_of_grid(node, field, path) : list(node, field, path);
      case Kind::quantities:
      case Kind::integers:
      case Kind::word_list:
        return list(field.kind == Kind::word_list ? list_of_names(node) : node, field, path);
      default:
        break;
    }
    if (node.kind != Node::Kind::scalar) return wrong_kind(node, field, path);
    switch (field.kind) {
      case Kind::text:
        return node.text;
      case Kind::word:
        return word(node, field, path);
      case Kind::boolean:
        return truth(node, field, path);
      case Kind::integer:
        return whole_number(node, field, path);
      case Kind::scalar:
        return free_scalar(node, path);
      default:
        return quantity(node, field, path);
    }
  }

  Json refused(const Node& node, std::string message, std::string allowed, std::string suggestion = {}) {
    complain(node.place, std::move(message), std::move(allowed), shown(node), std::move(suggestion));
    return nullptr;
  }

  Json wrong_kind(const Node& node, const Field& field, const std::string& path) {
    return refused(node, "'" + path + "' is of the wrong kind", describe_values(field, coordinate_));
  }

  Json word(const Node& node, const Field& field, const std::string& path) {
    if (field.words.empty() || std::ranges::find(field.words, node.text) != field.words.end()) return node.text;
    return refused(node, "'" + path + "' cannot be '" + shown(node) + "'", core::joined(field.words),
                   core::nearest(node.text, field.words));
  }

  Json truth(const Node& node, const Field& field, const std::string& path) {
    if (!node.quoted && node.text == "true") return true;
    if (!node.quoted && node.text == "false") return false;
    return wrong_kind(node, field, path);
  }

  Json whole_number(const Node& node, const Field& field, const std::string& path) {
    const Json number = plain_number(node, path, describe_values(field, coordinate_));
    if (number.is_null()) return nullptr;
    const double value = number.get<double>();
    const double largest = std::max(2e9, std::isfinite(field.range.high) ? field.range.high : 0.0);
    if (value != std::floor(value)) return wrong_kind(node, field, path);
    if (!in_range(node, field, path, value, "")) return nullptr;
    if (std::abs(value) <= largest) return static_cast<long>(value);
    return refused(node, "'" + path + "' is out of range", "-2e9 to 2e9");
  }

  Json plain_number(const Node& node, const std::string& path, const std::string& allowed) {
    const core::NumberText number = core::parse_number(node.text);
    if (number.value && !node.quoted) return *number.value;
    complain(node.place,
             node.quoted ? "'" + path + "' is a quoted text, not a number"
                         : "'" + path + "': the number '" + shown(node) + "' " + number.fault,
             allowed, shown(node));
    return nullptr;
  }

  /// A number, true, false or a text; the tree does not distinguish them.
  Json free_scalar(const Node& node, const std::string& path) {
    if (node.quoted) return node.text;
    if (node.text == "true") return true;
    if (node.text == "false") return false;
    return is_number_like(node.text) ? plain_number(node, path, "a number in SI, without unit") : Json(node.text);
  }

  [[nodiscard]] std::string unit_of(const Field& field) const {
    const bool open = std::ranges::find(field.units, amplitude_unit_) == field.units.end();
    return open ? field.units.front() : amplitude_unit_;
  }

  static Json in_json(double value, const std::string& unit) {
    return unit == "rad/s" ? Json(core::format_number(value) + " rad/s") : Json(value);
  }

  Json quantity(const Node& node, const Field& field, const std::string& path) {
    if (std::ranges::find(field.words, node.text) != field.words.end()) return node.text;
    const std::string unit = unit_of(field);
    Field chosen = field;
    chosen.units = {unit};
    std::string allowed = describe_values(chosen, coordinate_);
    if (node.quoted && core::parse_number(node.text).value)
      return refused(node, "'" + path + "' is a quoted number", "the number without quotes, or with its unit");
    const core::UncertainQuantityText text = core::parse_uncertain_quantity(node.text, unit, coordinate_);
    if (told_.fits_other_only(document_, node, path, unit, coordinate_) && reading_.coordinate)
      allowed += "; " + reading_.coordinate->reason();
    if (text.uncertainty && !field.takes_uncertainty)
      return refused(node, "'" + path + "' takes no uncertainty", allowed);
    if (!text.value) {
      const bool is_word = !field.words.empty() && !is_number_like(node.text);
      complain(node.place, "'" + path + "': " + text.fault, allowed, shown(node),
               is_word ? core::nearest(node.text, field.words) : text.suggestion);
      return nullptr;
    }
    if (!in_range(node, field, path, *text.value, core::unit_for(coordinate_, unit))) return nullptr;
    note_unit(path, node.text, reading_.written_units);
    return in_json(*text.value, unit);
  }

  /// An uncertainty in the text of a quantity is stored under its own key.
  void uncertainty(const Node& section, const Entry& entry, const Field& field, const std::string& path,
                   Json& values) {
    if (entry.value.kind != Node::Kind::scalar) return;
    const std::string unit = unit_of(field);
    const core::UncertainQuantityText text = core::parse_uncertain_quantity(entry.value.text, unit, coordinate_);
    if (!text.uncertainty) return;
    const std::string key = uncertainty_key(field.name);
    if (const Entry* other = section.find(key))
      return complain(other->place, "the uncertainty of '" + path + "' is stated twice", "one of the two",
                      shown(entry.value) + " in line " + std::to_string(entry.place.line) + " as well");
    reading_.places.emplace(path.substr(0, path.size() - field.name.size()) + key, entry.value.place);
    values[key] = in_json(*text.uncertainty, unit);
  }

  bool in_range(const Node& node, const Field& field, const std::string& path, double value,
                const std::string& unit) {
    if (field.range.contains(value)) return true;
    complain(node.place, "'" + path + "' is out of range", field.range.describe(unit), shown(node));
    return false;
  }

  Json list(const Node& node, const Field& field, const std::string& path) {
    if (node.kind != Node::Kind::sequence) return wrong_kind(node, field, path);
    if (!has_allowed_size(node, field, path)) return nullptr;
    Json values = Json::array();
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const std::string item_path = path + "[" + std::to_string(i) + "]";
      const Node& item = node.items[i];
      if (item.kind == Node::Kind::null) continue;
      reading_.places.emplace(item_path, item.place);
      Json value = list_item(item, field, item_path);
      if (field.kind == Kind::word_list && std::ranges::find(values, value) != values.end() && !value.is_null())
        complain(item.place, "'" + path + "' names '" + item.text + "' twice", "each once");
      values.push_back(std::move(value));
    }
    const bool complete = std::ranges::none_of(values, [](const Json& value) { return value.is_null(); });
    return complete ? values : Json(nullptr);
  }

  Json list_item(const Node& item, const Field& field, const std::string& path) {
    if (item.kind != Node::Kind::scalar) {
      complain(item.place, "'" + path + "' is of the wrong kind", describe_values(field, coordinate_), shown(item));
      return nullptr;
    }
    if (field.kind == Kind::word_list) return word(item, field, path);
    if (field.kind == Kind::integers) return whole_number(item, field, path);
    return quantity(item, field, path);
  }

  bool has_allowed_size(const Node& node, const Field& field, const std::string& path) {
    const std::size_t size = node.items.size();
    if (size >= field.min_items && size <= field.max_items) return true;
    const std::string most = field.max_items == field.min_items ? "" : " to " + std::to_string(field.max_items);
    complain(node.place, "'" + path + "' has the wrong number of items", std::to_string(field.min_items) + most,
             std::to_string(size));
    return false;
  }

  Json range_of_grid(const Node& node, const Field& field, const std::string& path) {
    const std::size_t before = reading_.problems.size();
    const Section grid = grid_section(field);
    Json values = section(node, grid, path, nullptr);
    // The tree has already refused a null.
    if (reading_.problems.size() != before || values.size() < grid.fields.size()) return nullptr;
    for (const char* end : {"from", "to"}) {
      const Json& value = values[end];
      if (values["spacing"] != "log" || !value.is_number() || value.get<double>() > 0.0) continue;
      complain(reading_.places.at(path + "." + end),
               "'" + path + "." + end + "' must be positive: equal ratios do not reach zero", "> 0",
               shown(node.find(end)->value));
      return nullptr;
    }
    return values;
  }

  Json map_or_list(const Node& node, const Field& field, const std::string& path) {
    if (node.kind == Node::Kind::map && !field.only_listed) return one_map(node, field, path);
    if (node.kind == Node::Kind::scalar && !field.short_for.empty())
      return one_map(map_of(field.short_for, node), field, path);
    if (node.kind != Node::Kind::sequence || !field.listed) return wrong_kind(node, field, path);
    if (!has_allowed_size(node, field, path)) return nullptr;
    Json values = Json::array();
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const Node& item = node.items[i];
      const std::string item_path = path + "[" + std::to_string(i) + "]";
      reading_.places.emplace(item_path, item.place);
      if (item.kind == Node::Kind::scalar && !field.short_for.empty()) {
        values.push_back(one_map(map_of(field.short_for, item), field, item_path));
        continue;
      }
      if (item.kind == Node::Kind::scalar || item.kind == Node::Kind::sequence)
        complain(item.place, "'" + item_path + "' is of the wrong kind", "a map", shown(item));
      // A faulty item keeps its place, so that the others keep their numbers.
      values.push_back(item.kind == Node::Kind::map ? one_map(item, field, item_path) : Json(nullptr));
    }
    return values;
  }

  Json one_map(const Node& node, const Field& field, const std::string& path) {
    const Choice& choice = *field.choice;
    if (choice.key.empty()) return section(node, choice.variants.front().section, path, &choice);

    const Variant* variant = chosen_variant(node, choice, path);
    if (variant == nullptr) return nullptr;
    if (!variant->amplitude_unit.empty()) amplitude_unit_ = variant->amplitude_unit;
    Json values = Json::object();
    values[choice.key] = variant->name;
    Json rest = section(node, variant->section, path, &choice);
    if (choice.names_laws) check_law(node, variant->name, path, rest);
    values.update(rest);
    return values;
  }

  const Variant* chosen_variant(const Node& node, const Choice& choice, const std::string& path) {
    const Entry* entry = node.find(choice.key);
    if (entry == nullptr) {
      complain(node.head(), "'" + path + "." + choice.key + "' is missing", core::joined(choice.names()));
      return nullptr;
    }
    if (entry->value.kind == Node::Kind::null) return nullptr;
    reading_.places.emplace(path + "." + choice.key, entry->value.place);
    const Variant* variant = choice.find(entry->value.text);
    if (variant == nullptr || entry->value.kind != Node::Kind::scalar) {
      const std::string mark = entry->value.kind == Node::Kind::scalar ? "'" : "";
      complain(
          entry->value.place, "'" + path + "." + choice.key + "' cannot be " + mark + shown(entry->value) + mark,
          core::joined(choice.names()) +
              (choice.names_laws ? "; or the law of a plugin, " + document_.words()(core::Setting::plugin) : ""),
          shown(entry->value), core::nearest(entry->value.text, choice.names()));
      return nullptr;
    }
    return variant;
  }

  /// Checks by the registry: defaults that follow another parameter, bounds between parameters.
  void check_law(const Node& node, const std::string& name, const std::string& path, Json& section) {
    const friction::LawEntry& law = *friction::find_law(name);
    friction::ParameterValues values = law_values(law.parameters, section, coordinate_);
    for (friction::ParameterFault& fault : friction::complete(law, values)) {
      if (fault.is_missing) continue;  // already reported
      const auto place = reading_.places.find(path + "." + fault.name);
      complain(place == reading_.places.end() ? node.head() : place->second,
               "'" + path + "." + fault.name + "' is not possible: " + fault.message, std::move(fault.allowed),
               std::move(fault.found));
    }
    if (!laws_are_sought_) section = law_json(law.parameters, values);
  }

  const Document& document_;
  bool laws_are_sought_;
  std::string amplitude_unit_ = "m";
  core::Coordinate coordinate_ = core::Coordinate::displacement;
  ToldCoordinate told_;
  Reading reading_;
};

/// Whether the analysis of the file seeks numbers of laws.
bool seeks_laws(const Document& document, const Section& format) {
  const Entry* section = document.root().find("analysis");
  const Entry* type = section == nullptr ? nullptr : section->value.find("type");
  const Field* field = format.find("analysis");
  const Variant* analysis =
      type == nullptr || field == nullptr || !field->choice ? nullptr : field->choice->find(type->value.text);
  return analysis != nullptr && analysis->seeks_laws;
}

}  // namespace

void Reading::complain(const Document& document, Place place, std::string message, std::string allowed,
                       std::string found, std::string suggestion) {
  if (problems.size() >= max_reported) return;
  problems.push_back(
      {document.locate(place), std::move(message), std::move(allowed), std::move(found), std::move(suggestion)});
}

Reading read(const Document& document, const Section& format) {
  const bool laws_are_sought = seeks_laws(document, format);
  const auto reading_of = [](Reader& reader, Json values) {
    Reading reading = reader.take();
    reading.values = std::move(values);
    return reading;
  };
  const std::optional<CoordinateSource> stated = stated_coordinate(document);
  Reader first(document, stated, laws_are_sought);
  Json values = first.section(document.root(), format, "", nullptr);
  const std::optional<CoordinateSource> told = first.told().first();
  if (stated || !told || (told->coordinate == core::Coordinate::displacement && !first.told().is_mixed())) {
    Reading reading = reading_of(first, std::move(values));
    if (!stated) reading.coordinate = told;
    return reading;
  }
  // The units have determined the coordinate; now all quantities are read in it.
  Reader second(document, told, laws_are_sought);
  values = second.section(document.root(), format, "", nullptr);
  return reading_of(second, std::move(values));
}

}  // namespace dualdamp::scenarios
