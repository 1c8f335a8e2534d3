#include "core/units.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>

#include "core/constants.hpp"
#include "core/dimensions.hpp"
#include "core/numbers.hpp"
#include "core/unit_conversion.hpp"
#include "core/utf8.hpp"

namespace dualdamp::core {

std::string_view trimmed(std::string_view text) {
  constexpr const char* blanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(blanks);
  return begin == std::string_view::npos ? std::string_view()
                                         : text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

namespace {

constexpr double pi = std::numbers::pi;

std::optional<Factor> angle_factor(std::string_view unit) {
  if (unit.empty() || unit == "rad" || unit == "radian" || unit == "radians") return Factor{};
  if (unit == "mrad") return Factor{1.0, 1000.0};
  if (unit == "deg" || unit == "degree" || unit == "degrees") return Factor{pi, 180.0};
  return std::nullopt;
}

std::optional<Factor> frequency_factor(std::string_view unit) {
  if (unit == "rad/s") return Factor{};
  if (unit == "Hz") return Factor{two_pi, 1.0};
  if (unit == "mHz") return Factor{two_pi, 1000.0};
  if (unit == "kHz") return Factor{2000.0 * pi, 1.0};
  if (unit == "rpm") return Factor{pi, 30.0};
  return std::nullopt;
}

/// ASCII spelling of the characters an engineer may type.
std::string to_ascii(std::string_view unit) {
  static constexpr std::array<std::array<std::string_view, 2>, 8> spellings = {{{"\u00b5", "u"},
                                                                                {"\u03bc", "u"},
                                                                                {"\u00b7", "."},
                                                                                {"\u22c5", "."},
                                                                                {"\u00b2", "^2"},
                                                                                {"\u00b3", "^3"},
                                                                                {"\u00b0", "deg"},
                                                                                {"**", "^"}}};
  std::string text(unit);
  for (const auto& [from, to] : spellings)
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  return text;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 80;  // some texts have a megabyte
  return "'" + shortened(text, longest) + "'";
}

QuantityText refused_quantity(std::string fault) { return {std::nullopt, std::move(fault), {}}; }

/// A usual unit that differs only in case or in what stands between its names (`Ns/m`), or by a further "/rad";
/// empty if there is none.
std::string similar_unit(std::string_view unit, std::string_view si_unit, Coordinate coordinate) {
  const auto letters = [](std::string_view text) {
    std::string result;
    for (const char c : text)
      if (std::string_view(".* ^").find(c) == std::string_view::npos)
        result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
  };
  for (const std::string_view candidate : usual_units(si_unit, coordinate))
    if (letters(candidate) == letters(unit) || candidate == std::string(unit) + "/rad")
      return std::string(candidate);
  return {};
}

/// In a unit of acceleration, g means standard gravity, not gram, as on the label of an accelerometer.
std::string with_gravity(std::string_view unit) {
  static constexpr std::array<std::array<std::string_view, 2>, 6> names = {{{"g", "gravity"},
                                                                            {"g_n", "gravity"},
                                                                            {"gn", "gravity"},
                                                                            {"mg", "milligravity"},
                                                                            {"mg_n", "milligravity"},
                                                                            {"ug", "microgravity"}}};
  const auto found = std::ranges::find(names, unit, [](const auto& name) { return name[0]; });
  return std::string(found == names.end() ? unit : (*found)[1]);
}

/// udunits2 does not know `deg`.
std::string with_degrees(std::string_view unit) {
  const auto is_letter = [&](std::size_t at) {
    return at < unit.size() && std::isalpha(static_cast<unsigned char>(unit[at])) != 0;
  };
  std::string result;
  for (std::size_t at = 0; at < unit.size();) {
    const bool stands_alone =
        unit.substr(at).starts_with("deg") && !is_letter(at + 3) && (at == 0 || !is_letter(at - 1));
    result += stands_alone ? "arc_degree" : std::string(1, unit[at]);
    at += stands_alone ? 3 : 1;
  }
  return result;
}

struct UnitAnswer {
  std::optional<Factor> factor;
  std::string fault;
};

UnitAnswer frequency_unit(std::string_view unit) {
  if (const std::optional<Factor> factor = frequency_factor(unit)) return {factor, {}};
  if (unit.empty()) return {std::nullopt, "a frequency needs its unit, because Hz and rad/s differ by 2 pi"};
  return {std::nullopt, quoted(unit) + " is not a unit of a frequency"};
}

UnitAnswer factor_of(std::string_view text, std::string_view dimension_name, Coordinate coordinate) {
  const std::string unit = to_ascii(trimmed(text));
  const std::string si_unit = unit_for(coordinate, dimension_name);
  if (dimension_name == "rad/s") return frequency_unit(unit);
  if (const auto angle = si_unit == "rad" ? angle_factor(unit) : std::nullopt) return {angle, {}};
  if (unit.empty() || unit == si_unit) return {Factor{}, {}};
  constexpr std::size_t max_length = 64;
  if (unit.size() > max_length || !is_product_of_units(unit))
    return {std::nullopt,
            quoted(trimmed(text)) +
                " is not a unit: a product of unit names with integer powers is needed, such as 'N.s/m'"};
  const Conversion answer = conversion(si_unit == "m/s^2" ? with_gravity(unit) : with_degrees(unit), si_unit);
  if (answer.factor) return {answer.factor, {}};
  if (!answer.known) return {std::nullopt, "the unit " + quoted(trimmed(text)) + " is not known"};
  const Dimension* dimension = find_dimension(dimension_name, coordinate);
  return {std::nullopt, quoted(trimmed(text)) + " is not a unit of " +
                            (dimension != nullptr ? std::string(dimension->noun) : quoted(si_unit))};
}

}  // namespace

QuantityText parse_quantity(std::string_view text, std::string_view si_unit, Coordinate coordinate) {
  const std::string body(trimmed(text));
  const NumberText number = read_number(body);
  if (!number.value) {
    if (number.length == 0) return refused_quantity("there is no number at the beginning of " + quoted(body));
    return refused_quantity("the number " + quoted(body.substr(0, number.length)) + " " + number.fault);
  }
  const std::string unit(trimmed(std::string_view(body).substr(number.length)));
  const UnitAnswer answer = factor_of(unit, si_unit, coordinate);
  if (!answer.factor) {
    QuantityText result = refused_quantity(answer.fault);
    const std::string similar = similar_unit(unit, si_unit, coordinate);
    if (!similar.empty()) result.suggestion = body.substr(0, number.length) + " " + similar;
    return result;
  }
  const double value = answer.factor->apply(*number.value);
  if (!std::isfinite(value) || (value == 0.0 && *number.value != 0.0))
    return refused_quantity(quoted(body) + " is outside the range of double precision");
  return {value, {}, {}};
}

bool is_si(std::string_view unit) {
  return is_dimension(unit) || (is_product_of_units(unit) && is_coherent(std::string(unit)));
}

QuantityText unit_factor(std::string_view unit, std::string_view si_unit, Coordinate coordinate) {
  // A column of frequencies without unit is as ambiguous as a bare frequency.
  const UnitAnswer answer = factor_of(unit, si_unit, coordinate);
  if (!answer.factor) return {std::nullopt, answer.fault, similar_unit(trimmed(unit), si_unit, coordinate)};
  return {answer.factor->apply(1.0), {}, {}};
}

std::string describe_dimension(std::string_view si_unit, Coordinate coordinate) {
  const Dimension* dimension = find_dimension(si_unit, coordinate);
  if (dimension == nullptr) return "a quantity in " + unit_for(coordinate, si_unit);
  return std::string(dimension->noun) + " such as " + quoted(dimension->example);
}

const std::vector<std::string_view>& usual_units(std::string_view si_unit, Coordinate coordinate) {
  static const std::vector<std::string_view> none;
  const Dimension* dimension = find_dimension(si_unit, coordinate);
  return dimension == nullptr ? none : dimension->units;
}

}  // namespace dualdamp::core
