#include "core/uncertain_quantity.hpp"

#include <array>
#include <cmath>

#include "core/numbers.hpp"
#include "core/units.hpp"

namespace dualdamp::core {

namespace {

constexpr std::array<std::string_view, 3> signs = {"\u00b1", "+/-", "+-"};

/// The two sides of the sign, each with its unit.
struct Sides {
  std::string value;
  std::string uncertainty;   ///< without the sign of percent
  bool is_relative = false;  ///< the uncertainty is in percent of the value
  std::string fault;
};

/// "1.042" and "kg" of "1.042 kg".
struct NumberAndUnit {
  std::string_view number;
  std::string_view unit;
};

NumberAndUnit taken_apart(std::string_view text) {
  const std::size_t length = read_number(text).length;
  return {trimmed(text.substr(0, length)), trimmed(text.substr(length))};
}

std::string with_unit(const NumberAndUnit& side, std::string_view unit) {
  if (side.number.empty()) return std::string(side.unit);
  return std::string(side.number) + (unit.empty() ? "" : " " + std::string(unit));
}

/// "1.042 ± 0.5 %" and "kg" of "(1.042 ± 0.5 %) kg". No unit without parentheses.
NumberAndUnit without_parentheses(std::string_view text) {
  const std::string_view plain = trimmed(text);
  const std::size_t end = plain.find(')');
  if (!plain.starts_with('(') || end == std::string_view::npos) return {plain, {}};
  return {trimmed(plain.substr(1, end - 1)), trimmed(plain.substr(end + 1))};
}

/// Nothing if the text has no sign. One unit may serve both sides: behind parentheses, or behind one of them. The
/// sign of percent is not part of it: in "1.042 ± 0.5 % kg" the value is in kg.
std::optional<Sides> sides(std::string_view text) {
  const NumberAndUnit pair = without_parentheses(text);
  for (const std::string_view sign : signs) {
    const std::size_t at = pair.number.find(sign);
    if (at == std::string_view::npos) continue;
    const NumberAndUnit value = taken_apart(trimmed(pair.number.substr(0, at)));
    NumberAndUnit uncertainty = taken_apart(trimmed(pair.number.substr(at + sign.size())));
    const bool is_relative = uncertainty.unit.starts_with('%');
    if (is_relative) uncertainty.unit = trimmed(uncertainty.unit.substr(1));
    const bool stated_twice = !value.unit.empty() && !uncertainty.unit.empty() && is_relative;
    if (stated_twice || (!pair.unit.empty() && !(value.unit.empty() && uncertainty.unit.empty())))
      return Sides{{}, {}, is_relative, "the unit is stated twice"};
    const std::string_view shared = pair.unit.empty() ? uncertainty.unit : pair.unit;
    const std::string_view value_unit = value.unit.empty() ? shared : value.unit;
    const std::string_view uncertainty_unit = uncertainty.unit.empty() ? value_unit : uncertainty.unit;
    return Sides{with_unit(value, value_unit),
                 with_unit(uncertainty, is_relative ? std::string_view() : uncertainty_unit),
                 is_relative,
                 {}};
  }
  return std::nullopt;
}

UncertainQuantityText refused_pair(std::string fault) { return {{}, {}, std::move(fault), {}}; }

UncertainQuantityText without_uncertainty(const QuantityText& quantity) {
  return {quantity.value, {}, quantity.fault, quantity.suggestion};
}

}  // namespace

UncertainQuantityText parse_uncertain_quantity(std::string_view text, std::string_view si_unit,
                                               Coordinate coordinate) {
  const std::optional<Sides> both = sides(text);
  if (!both) return without_uncertainty(parse_quantity(text, si_unit, coordinate));
  if (!both->fault.empty()) return refused_pair(both->fault);
  UncertainQuantityText result = without_uncertainty(parse_quantity(both->value, si_unit, coordinate));
  if (!result.value) return result;
  const std::string& uncertainty_text = both->is_relative ? both->uncertainty + " %" : both->uncertainty;
  const QuantityText uncertainty = parse_quantity(uncertainty_text, both->is_relative ? "1" : si_unit, coordinate);
  if (!uncertainty.value) return refused_pair("the uncertainty: " + uncertainty.fault);
  if (*uncertainty.value < 0.0) return refused_pair("the uncertainty is negative");
  result.uncertainty = both->is_relative ? *uncertainty.value * std::abs(*result.value) : *uncertainty.value;
  return result;
}

SplitQuantityText split_uncertainty(std::string_view text) {
  const std::optional<Sides> both = sides(text);
  if (!both) return {std::string(text), {}, {}};
  SplitQuantityText result{both->value, {}, both->fault};
  if (!result.fault.empty()) return result;
  const NumberAndUnit value_text = taken_apart(both->value);
  const NumberAndUnit uncertainty_text = taken_apart(both->uncertainty);
  const std::optional<double> value = read_number(value_text.number).value;
  const std::optional<double> uncertainty = read_number(uncertainty_text.number).value;
  if (!value || *value == 0.0) {
    result.fault = "there is no number other than zero before the uncertainty";
  } else if (!uncertainty || *uncertainty < 0.0) {
    result.fault = "the uncertainty is not a number that is at least zero";
  } else if (both->is_relative) {
    result.relative = *uncertainty / 100.0;
  } else if (uncertainty_text.unit == value_text.unit) {
    result.relative = *uncertainty / std::abs(*value);
  } else {
    result.fault = "the uncertainty must be in percent or in the unit of the value";
  }
  return result;
}

}  // namespace dualdamp::core
