#include "core/uncertain_quantity.hpp"

#include <array>
#include <cmath>

#include "core/numbers.hpp"
#include "core/units.hpp"

namespace dualdamp::core {

namespace {

constexpr std::array<std::string_view, 3> signs = {"\u00b1", "+/-", "+-"};

struct Halves {
  std::string_view value;
  std::string_view uncertainty;
};

std::optional<Halves> halves(std::string_view text) {
  for (const std::string_view sign : signs)
    if (const std::size_t at = text.find(sign); at != std::string_view::npos)
      return Halves{trimmed(text.substr(0, at)), trimmed(text.substr(at + sign.size()))};
  return std::nullopt;
}

/// "kg" of "1.042 kg"; empty when there is none.
std::string_view unit_of(std::string_view text) {
  const std::size_t length = read_number(text).length;
  return trimmed(text.substr(length));
}

UncertainQuantityText refused_pair(std::string fault) { return {{}, {}, std::move(fault), {}}; }

UncertainQuantityText without_uncertainty(const QuantityText& quantity) {
  return {quantity.value, {}, quantity.fault, quantity.suggestion};
}

/// "(1.042 ± 0.005) kg" as "1.042 ± 0.005 kg".
std::string without_parentheses(std::string_view text) {
  std::string plain(trimmed(text));
  if (!plain.starts_with('(')) return plain;
  const std::size_t end = plain.find(')');
  if (end == std::string::npos) return plain;
  return plain.substr(1, end - 1) + " " + plain.substr(end + 1);
}

}  // namespace

UncertainQuantityText parse_uncertain_quantity(std::string_view text, std::string_view si_unit,
                                               Coordinate coordinate) {
  const std::string plain = without_parentheses(text);
  const std::optional<Halves> both = halves(plain);
  if (!both) return without_uncertainty(parse_quantity(text, si_unit, coordinate));
  const std::string_view unit = unit_of(both->uncertainty);
  const bool is_relative = unit == "%";

  std::string value_text(both->value);
  if (unit_of(value_text).empty() && !is_relative && !unit.empty()) value_text += " " + std::string(unit);
  UncertainQuantityText result = without_uncertainty(parse_quantity(value_text, si_unit, coordinate));
  if (!result.value) return result;

  std::string uncertainty_text(both->uncertainty);
  if (unit.empty() && !uncertainty_text.empty()) uncertainty_text += " " + std::string(unit_of(value_text));
  const QuantityText uncertainty = parse_quantity(uncertainty_text, is_relative ? "1" : si_unit, coordinate);
  if (!uncertainty.value) return refused_pair("the uncertainty: " + uncertainty.fault);
  if (*uncertainty.value < 0.0) return refused_pair("the uncertainty is negative");
  result.uncertainty = is_relative ? *uncertainty.value * std::abs(*result.value) : *uncertainty.value;
  return result;
}

SplitQuantityText split_uncertainty(std::string_view text) {
  const std::string plain = without_parentheses(text);
  const std::optional<Halves> both = halves(plain);
  if (!both) return {std::string(text), {}, {}};
  SplitQuantityText result{std::string(both->value), {}, {}};
  const std::string_view unit = unit_of(both->uncertainty);
  if (unit_of(result.quantity).empty() && unit != "%" && !unit.empty()) result.quantity += " " + std::string(unit);
  const std::optional<double> value = read_number(result.quantity).value;
  const std::optional<double> uncertainty = read_number(both->uncertainty).value;
  if (!value || *value == 0.0) {
    result.fault = "there is no number other than zero before the uncertainty";
  } else if (!uncertainty || *uncertainty < 0.0) {
    result.fault = "the uncertainty is not a number that is at least zero";
  } else if (unit == "%") {
    result.relative = *uncertainty / 100.0;
  } else if (unit.empty() || unit == unit_of(result.quantity)) {
    result.relative = *uncertainty / std::abs(*value);
  } else {
    result.fault = "the uncertainty must be in percent or in the unit of the value";
  }
  return result;
}

}  // namespace dualdamp::core
