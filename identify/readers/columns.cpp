#include "identify/readers/columns.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "core/diagnostics.hpp"
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

/// A unit of a signal before it is scaled.
bool is_signal_unit(const std::string& unit) {
  return unit == "%" || unit == "count" || unit == "counts" || core::unit_factor(unit, "V").value.has_value();
}

/// Whether all of them may be remarks: square brackets and units of signals are none.
bool are_notes(const std::vector<Bracket>& brackets) {
  return std::ranges::none_of(
      brackets, [](const Bracket& bracket) { return bracket.opening == '[' || is_signal_unit(bracket.content); });
}

/// Where no bracket holds a unit of the column: what the message about its unit is to name, or the unit of a signal
/// that is scaled. `<b>` and `{fett}` are the marks of a text.
std::string other_unit_in(const std::vector<Bracket>& brackets) {
  const auto last = [&](auto fits) {
    const auto found = std::find_if(brackets.rbegin(), brackets.rend(), fits);
    return found == brackets.rend() ? std::string() : without_in(found->content);
  };
  std::string unit = last([](const Bracket& bracket) { return bracket.opening == '['; });
  if (unit.empty()) unit = last([](const Bracket& bracket) { return is_signal_unit(bracket.content); });
  if (unit.empty()) unit = last([](const Bracket& bracket) { return bracket.opening == '('; });
  return unit;
}

/// Moves a unit of `known` from the end of the name to `heading.unit`. True if there is one.
bool split_name(Heading& heading, const KnownColumn& known) {
  const std::string name = heading.name;
  for (std::size_t end = name.find_first_of(marks, 1); end < name.size(); end = name.find_first_of(marks, end + 1))
    if (std::string unit = unit_behind(name, name.substr(0, end), known); !unit.empty()) {
      heading.name.resize(end);
      heading.unit = std::move(unit);
      heading.brackets.clear();
      return true;
    }
  return false;
}

/// Whether a bracket, or the text behind the brackets, holds a unit of the column.
bool states_unit_of(const Heading& heading, const KnownColumn& known) {
  Heading copy = heading;
  choose_unit(copy, known);
  return is_unit_of(copy.unit, known);
}

/// The column that the text before the brackets names, or all of a heading without brackets.
const KnownColumn* column_named_by(Heading& heading) {
  if (const KnownColumn* known = known_column(heading.name)) return known;
  if (const KnownColumn* known = column_in_any_case(heading.name)) return known;
  if (heading.text == "X_Value") {  // LabVIEW's name of the time
    if (heading.unit.empty()) heading.unit = "s";
    return known_column("t");
  }
  if (heading.name.size() == 1 && heading.name != "y" && heading.name != "Y")  // X [mm], but not V without a unit
    for (const KnownColumn& known : known_columns)
      if (is_alike(heading.name, known.name) && states_unit_of(heading, known)) return &known;
  for (const ShortName& other : short_names)
    if (const KnownColumn* known = known_column(other.column);
        is_name(heading.name, other.text) && states_unit_of(heading, *known))
      return known;
  // `x_[mm]`, `x/(mm)`: a separating character before the brackets.
  const std::size_t end = heading.name.find_last_not_of(marks) + 1;
  if (!heading.brackets.empty() && end < heading.name.size())
    return column_in_any_case(std::string_view(heading.name).substr(0, end));
  if (!heading.well_formed || !are_notes(heading.brackets)) return nullptr;
  for (const KnownColumn& known : known_columns)
    for (const std::string_view name : names_of(known))
      if (std::string unit = unit_behind(heading.name, name, known); !unit.empty()) {
        heading.name = name;
        heading.unit = std::move(unit);
        heading.brackets.clear();
        return &known;
      }
  return nullptr;
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

bool is_unit_of(const std::string& unit, const KnownColumn& known) {
  return !unit.empty() && !known.unit.empty() &&
         (core::unit_factor(unit, known.unit).value || core::coordinate_told_by(unit, known.unit));
}

Heading parse_heading(std::string_view text, int column) {
  Heading heading{std::string(text), std::string(trimmed(text)), {}, column, true};
  Brackets brackets = brackets_of(text);
  heading.well_formed = brackets.are_closed;
  if (brackets.pairs.empty()) {
    // `x [mm`: the name is told from the unit, so that the message names the column
    const std::size_t open = text.find_first_of("[({<");
    if (open != std::string_view::npos) heading.name = trimmed(text.substr(0, open));
    return heading;
  }
  heading.brackets = std::move(brackets.pairs);
  heading.name = trimmed(text.substr(0, heading.brackets.front().begin));
  heading.behind = trimmed(text.substr(heading.brackets.back().end));
  if (heading.brackets.size() == 1) heading.unit = without_in(heading.brackets.front().content);
  heading.well_formed = heading.well_formed && heading.behind.empty();
  for (std::size_t i = 1; i < heading.brackets.size(); ++i) {
    const std::size_t from = heading.brackets[i - 1].end;
    const std::string_view between = text.substr(from, heading.brackets[i].begin - from);
    heading.well_formed = heading.well_formed && between.find_first_not_of(marks) == std::string_view::npos;
  }
  return heading;
}

void choose_unit(Heading& heading, const KnownColumn& known) {
  if (heading.brackets.empty()) return;
  std::string best;
  bool is_best_square = false;
  const auto weigh = [&](std::string unit, bool is_square) {
    if (!is_unit_of(unit, known)) return;
    const bool wins = best.empty() || is_square || !is_best_square;
    if (!best.empty() && core::unit_factor(unit, known.unit).value != core::unit_factor(best, known.unit).value)
      heading.other_unit = wins ? best : unit;
    if (!wins) return;
    best = std::move(unit);
    is_best_square = is_square;
  };
  for (const Bracket& bracket : heading.brackets) weigh(without_in(bracket.content), bracket.opening == '[');
  const std::size_t begin = heading.behind.find_first_not_of(marks);
  const std::string trailing = begin == std::string::npos ? "" : without_in(heading.behind.substr(begin));
  if (is_unit_of(trailing, known)) heading.well_formed = true;
  weigh(trailing, false);
  if (best.empty() && are_notes(heading.brackets) && split_name(heading, known)) return;
  if (best.empty()) best = other_unit_in(heading.brackets);
  heading.unit = std::move(best);
}

bool is_called(const Heading& heading, std::string_view called) {
  if (called == heading.text || called == heading.name) return true;
  return std::ranges::any_of(heading.brackets, [&](const Bracket& bracket) {
    const std::string before(trimmed(std::string_view(heading.text).substr(0, bracket.begin)));
    const std::string_view after = trimmed(std::string_view(heading.text).substr(bracket.end));
    return called == trimmed(before + (after.empty() ? "" : " ") + std::string(after));
  });
}

const KnownColumn* named_column(Heading& heading) {
  const KnownColumn* const known = column_named_by(heading);
  if (known != nullptr) choose_unit(heading, *known);
  return known;
}

void split_unit(Heading& heading, const KnownColumn& known) {
  if (heading.unit.empty() && heading.well_formed) split_name(heading, known);
  const std::size_t last = heading.unit.empty() ? std::string::npos : heading.name.find_last_not_of(marks);
  if (last != std::string::npos) heading.name.resize(last + 1);
}

bool is_output(std::string_view name) {
  constexpr std::string_view out = "out";
  const std::size_t mark = name.find_last_of(marks);
  return mark != std::string_view::npos && is_alike(name.substr(mark + 1), out);
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

std::vector<std::string> all_ignored(std::string_view what, const std::vector<std::string>& names,
                                     const core::SettingWords& words) {
  constexpr std::size_t most_warnings = 3;
  constexpr std::size_t most_names = 5;
  std::vector<std::string> warnings;
  std::vector<std::string> plain;
  for (const std::string& name : names)
    if (column_of_uncertainty(name) != nullptr || names.size() <= most_warnings)
      warnings.push_back(ignored(what, name, words));
    else
      plain.push_back("'" + name + "'");
  if (plain.empty()) return warnings;
  const std::size_t count = plain.size();
  if (count > most_names) plain.resize(most_names);
  const std::string more = count > most_names
                               ? core::joined(plain) + " and " + std::to_string(count - most_names) + " more"
                               : core::joined(plain, " and ");
  warnings.push_back(std::to_string(count) + " " + std::string(what) + (count == 1 ? " is" : "s are") +
                     " not known and " + (count == 1 ? "is" : "are") + " ignored: " + more);
  return warnings;
}

}  // namespace dualdamp::identify
