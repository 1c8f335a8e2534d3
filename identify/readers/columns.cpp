#include "identify/readers/columns.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "core/units.hpp"
#include "identify/readers/record_reader.hpp"
#include "identify/readers/text.hpp"

namespace dualdamp::identify {

namespace {

/// Characters between a name and a unit without brackets.
constexpr std::string_view marks = " _/,:-.";

bool is_alike(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b,
                            [](unsigned char c, unsigned char d) { return std::tolower(c) == std::tolower(d); });
}

bool is_name(std::string_view text, std::string_view name) {
  return !name.empty() && (text == name || (name.size() > 1 && is_alike(text, name)));
}

const KnownColumn* column_in_any_case(std::string_view text) {
  const auto found = std::ranges::find_if(known_columns, [text](const KnownColumn& known) {
    return is_name(text, known.name) || is_name(text, known.alias);
  });
  return found == known_columns.end() ? nullptr : &*found;
}

bool is_unit_of(const std::string& unit, const KnownColumn& known) {
  return !unit.empty() && !known.unit.empty() &&
         (core::unit_factor(unit, known.unit).value || core::coordinate_told_by(unit, known.unit));
}

/// Names whose column depends on the unit: f [Hz], F [N].
struct ShortName {
  std::string_view text;
  std::string_view column;
};
constexpr std::array<ShortName, 5> short_names = {
    {{"f", "omega"}, {"F", "omega"}, {"freq", "omega"}, {"f", "force"}, {"F", "force"}}};

/// All names of columns with a unit.
std::vector<std::string_view> names_of(const KnownColumn& known) {
  std::vector<std::string_view> names = {known.name, known.alias};
  for (const ShortName& other : short_names)
    if (other.column == known.name) names.push_back(other.text);
  return names;
}

/// "mm" of "in mm"
std::string without_in(std::string_view unit) {
  unit = trimmed(unit);
  constexpr std::string_view in = "in ";
  if (unit.size() > in.size() && unit.starts_with(in)) unit.remove_prefix(in.size());
  return std::string(trimmed(unit));
}

/// The unit in a text that begins with a name and separating characters; empty if there is none.
std::string unit_behind(std::string_view text, std::string_view name, const KnownColumn& known) {
  if (name.empty() || text.size() <= name.size() + 1 || !is_name(text.substr(0, name.size()), name)) return {};
  const std::string_view rest = text.substr(name.size());
  const std::size_t begin = rest.find_first_not_of(marks);
  if (begin == 0 || begin == std::string_view::npos) return {};
  std::string unit = without_in(rest.substr(begin));
  return is_unit_of(unit, known) ? unit : std::string();
}

/// Words before or after the name of a column that holds the uncertainty of its readings: u_x, u(x), x_err.
constexpr std::array<std::string_view, 16> words_of_uncertainty = {
    "u",  "uc",  "unc",   "uncert", "uncertainty", "err", "error", "errors",
    "sd", "std", "stdev", "stddev", "sigma",       "se",  "sem",   "\u03c3"};

const KnownColumn* column_of_uncertainty(std::string_view heading) {
  const auto is_mark = [](char c) { return std::string_view(" _/,:-.([{<)]}>").find(c) != std::string_view::npos; };
  std::vector<std::string_view> parts;
  while (!heading.empty() && parts.size() < 2) {
    const auto* const end = std::ranges::find_if(heading, is_mark);
    const std::string_view part(heading.begin(), end);
    if (!part.empty() && part != "of" && part != "in") parts.push_back(part);
    heading = {end == heading.end() ? end : end + 1, heading.end()};
  }
  if (parts.size() < 2) return nullptr;
  const auto is_word = [](std::string_view part) {
    return std::ranges::any_of(words_of_uncertainty,
                               [part](std::string_view word) { return is_alike(part, word); });
  };
  for (const auto& [word, name] : {std::pair{parts[0], parts[1]}, {parts[1], parts[0]}})
    if (const KnownColumn* known = column_in_any_case(name); is_word(word) && known != nullptr) return known;
  return nullptr;
}

}  // namespace

const KnownColumn* known_column(std::string_view name) {
  const auto found = std::ranges::find_if(known_columns, [name](const KnownColumn& known) {
    return name == known.name || (!known.alias.empty() && name == known.alias);
  });
  return found == known_columns.end() ? nullptr : &*found;
}

std::vector<std::string_view> column_names(bool numbers_only) {
  std::vector<std::string_view> names;
  for (const KnownColumn& known : known_columns)
    if (!numbers_only || !known.unit.empty()) names.push_back(known.name);
  return names;
}

Heading parse_heading(std::string_view text, int column) {
  Heading heading{std::string(text), std::string(trimmed(text)), {}, column, true};
  constexpr std::string_view opening = "[({<";
  constexpr std::string_view closing = "])}>";
  const std::size_t open = text.find_first_of(opening);
  if (open == std::string_view::npos) {
    heading.well_formed = text.find_first_of(closing) == std::string_view::npos;
    return heading;
  }
  const std::string_view rest = text.substr(open + 1);
  const std::size_t close = rest.find(closing[opening.find(text[open])]);
  heading.name = trimmed(text.substr(0, open));
  if (close != std::string_view::npos) heading.unit = without_in(rest.substr(0, close));
  heading.well_formed = close != std::string_view::npos && close + 1 == rest.size();
  return heading;
}

const KnownColumn* named_column(Heading& heading) {
  if (const KnownColumn* known = known_column(heading.name)) return known;
  if (const KnownColumn* known = column_in_any_case(heading.name)) return known;
  if (heading.text == "X_Value") {  // LabVIEW's name of the time
    heading.unit = "s";
    return known_column("t");
  }
  if (heading.name.size() == 1 && heading.name != "y" && heading.name != "Y")  // X [mm], but not V without a unit
    for (const KnownColumn& known : known_columns)
      if (is_alike(heading.name, known.name) && is_unit_of(heading.unit, known)) return &known;
  for (const ShortName& other : short_names)
    if (const KnownColumn* known = known_column(other.column);
        is_name(heading.name, other.text) && is_unit_of(heading.unit, *known))
      return known;
  if (!heading.unit.empty() || !heading.well_formed) {
    // `x_[mm]`, `x/(mm)`: a separating character before the brackets.
    const std::size_t end = heading.name.find_last_not_of(marks) + 1;
    return end < heading.name.size() ? column_in_any_case(std::string_view(heading.name).substr(0, end)) : nullptr;
  }
  for (const KnownColumn& known : known_columns)
    for (const std::string_view name : names_of(known))
      if (std::string unit = unit_behind(heading.name, name, known); !unit.empty()) {
        heading.name = name;
        heading.unit = std::move(unit);
        return &known;
      }
  return nullptr;
}

void split_unit(Heading& heading, const KnownColumn& known) {
  const std::string_view name = heading.name;
  if (heading.unit.empty() && heading.well_formed)
    for (std::size_t end = name.find_first_of(marks, 1); end < name.size() && heading.unit.empty();
         end = name.find_first_of(marks, end + 1))
      if (std::string unit = unit_behind(name, name.substr(0, end), known); !unit.empty())
        heading = {heading.text, std::string(name.substr(0, end)), std::move(unit), heading.column, true};
  const std::size_t last = heading.unit.empty() ? std::string::npos : heading.name.find_last_not_of(marks);
  if (last != std::string::npos) heading.name.resize(last + 1);
}

std::string ignored(std::string_view what, const std::string& name, const core::SettingWords& words) {
  std::string text = std::string(what) + " '" + name + "' is not known and is ignored";
  const KnownColumn* uncertain = column_of_uncertainty(name);
  if (uncertain == nullptr) return text;
  const std::string column(uncertain->name);
  const std::string advice = words(core::Setting::noise, column, "...");
  return text + "; if it holds the uncertainty of each " + column + ", " +
         (advice.empty() ? "readings are weighed by their scatter instead"
                         : "state one for all of them, such as its median: " + advice);
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return text;
}

}  // namespace dualdamp::identify
