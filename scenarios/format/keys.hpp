#pragma once
/// The keys of scenario files: the values of each key, declared once.
///
/// A table of `Field`s describes a section of the file. The reader (reader.cpp), the JSON Schema (schema.cpp) and
/// the reference page (reference.cpp) all use these tables. The content of the tables (`scenario_format.cpp` and
/// the analyses) is stated nowhere else.
///
///     Section{{quantity("mass", {"kg"}, "sliding mass").required().above(0),
///              words("damper_to", {"ground", "base"}, "other end of the damper").with_fallback("ground")}}

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/coordinate.hpp"
#include "friction_models/parameters.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/format/result_field.hpp"

namespace dualdamp::scenarios {

enum class Kind {
  text,        ///< any text
  word,        ///< one of `words`
  boolean,     ///< true, false
  integer,     ///< a whole number
  quantity,    ///< a number with unit, or one of `words`
  quantities,  ///< a list of them
  grid,        ///< a list of them, or {from, to, count, spacing}
  integers,    ///< a list of whole numbers
  word_list,   ///< distinct `words`, or any names if there are none: a list, or a text with commas
  scalar,      ///< a number, true, false or a text
  choice,      ///< a map, or (when `listed`) a list of maps
  sweep,       ///< a map of paths of other keys and their values (swept_keys.hpp)
};

struct Choice;

struct Field {
  std::string name;
  Kind kind = Kind::text;
  std::string meaning;
  /// Units of the numbers, for a displacement (core/coordinate.hpp). If there are several, the excitation
  /// determines which one applies (an amplitude is in m or N).
  std::vector<std::string> units;
  friction::Range range;
  std::vector<std::string> words;
  bool is_required = false;
  /// The key that this one replaces, as a part of the other form of a section: this key is refused beside it, and
  /// required without it (when `is_required`). The replaced key is required if the section has no part of the other
  /// form.
  std::string instead_of = {};
  Json fallback;               ///< null: none. In the form the reader returns
  std::string fallback_words;  ///< the default in words, where it is not a value: "that of 'kinetic'"
  std::size_t min_items = 1;
  std::size_t max_items = 1;
  std::shared_ptr<const Choice> choice;
  bool listed = false;       ///< choice: a list of maps is accepted
  bool only_listed = false;  ///< choice: only a list is accepted
  /// choice: a text means a map with this key alone; empty: a text is refused.
  std::string short_for = {};
  /// quantity: its text may state an uncertainty, which goes to the key `uncertainty_key(name)`.
  bool takes_uncertainty = false;

  Field&& required() &&;
  Field&& with_fallback(Json value) &&;
  Field&& or_words(std::vector<std::string> list) &&;
  Field&& above(double low) &&;
  Field&& at_least(double low) &&;
  Field&& at_most(double high) &&;
  Field&& items(std::size_t least, std::size_t most) &&;
  Field&& with_uncertainty() &&;
};

/// Keys of which a section takes exactly one, or at most one.
struct Alternatives {
  std::vector<std::string> names;
  bool is_required = true;
};

struct Section {
  std::vector<Field> fields;
  std::vector<Alternatives> alternatives = {};

  [[nodiscard]] const Field* find(std::string_view name) const;
  /// Keys of the form without `name`.
  [[nodiscard]] std::vector<std::string> instead_of(std::string_view name) const;
};

struct Variant {
  std::string name;
  std::string summary;
  Section section;
  /// Of an excitation: the unit that applies to fields with several units in the rest of the file.
  std::string amplitude_unit = {};
  std::string equation = {};              ///< of a closed form
  std::vector<ResultField> results = {};  ///< what this choice adds to the result
  /// Of an analysis: a law of the system may lack required numbers, and its defaults are not filled in.
  bool seeks_laws = false;
};

/// A map whose key `key` (type, law, ...) selects the section; a plain map when `key` is empty.
struct Choice {
  std::string key;
  std::vector<Variant> variants;
  bool names_laws = false;  ///< the variants are the laws of the registry, or a part of one

  [[nodiscard]] const Variant* find(std::string_view name) const;
  [[nodiscard]] std::vector<std::string> names() const;
};

[[nodiscard]] Field text(std::string name, std::string meaning);
[[nodiscard]] Field words(std::string name, std::vector<std::string> list, std::string meaning);
[[nodiscard]] Field boolean(std::string name, std::string meaning);
[[nodiscard]] Field integer(std::string name, std::string meaning);
[[nodiscard]] Field integers(std::string name, std::string meaning);
[[nodiscard]] Field word_list(std::string name, std::vector<std::string> list, std::string meaning);
/// A list of any names.
[[nodiscard]] Field name_list(std::string name, std::string meaning);
[[nodiscard]] Field scalar(std::string name, std::string meaning);
[[nodiscard]] Field quantity(std::string name, std::vector<std::string> units, std::string meaning);
/// "mass_uncertainty"
[[nodiscard]] std::string uncertainty_key(const std::string& name);

/// The key for the uncertainty of a quantity.
[[nodiscard]] Field uncertainty_of(const std::string& name, std::vector<std::string> units);

[[nodiscard]] Field quantities(std::string name, std::vector<std::string> units, std::string meaning);
[[nodiscard]] Field grid(std::string name, std::vector<std::string> units, std::string meaning);
[[nodiscard]] Field section(std::string name, Section section, std::string meaning);
[[nodiscard]] Field section_list(std::string name, Section section, std::string meaning);
[[nodiscard]] Field choice(std::string name, Choice choice, std::string meaning);

/// The fields that read a law's parameters. `friction::complete` checks bounds between parameters and fills in
/// defaults.
[[nodiscard]] std::vector<Field> fields_of(const std::vector<friction::Parameter>& table);

/// The {from, to, count, spacing} form of a grid with these units and range.
[[nodiscard]] Section grid_section(const Field& grid);

/// "> 0 kg", "ground, base": the values a field takes, for messages and the reference page.
[[nodiscard]] std::string describe_values(const Field& field,
                                          core::Coordinate coordinate = core::Coordinate::displacement);

}  // namespace dualdamp::scenarios
