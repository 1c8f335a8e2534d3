#include "core/coordinate.hpp"

#include <cctype>

#include "core/units.hpp"

namespace dualdamp::core {

namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// The unit of rotation in place of one of the three that change.
std::string_view rotational(std::string_view name) {
  if (name == "kg") return "kg.m^2";
  if (name == "N") return "N.m";
  return name == "m" ? "rad" : name;
}

/// "kg.m^2", "3" as "kg^3.m^6": a power of a product of at most two powers.
std::string raised(std::string_view product, std::string_view power) {
  if (power.empty()) return std::string(product);
  const int exponent = std::stoi(std::string(power));
  const std::size_t dot = product.find('.');
  std::string result = std::string(product.substr(0, dot)) + "^" + std::string(power);
  if (dot == std::string_view::npos) return result;
  const int second = product.ends_with("^2") ? 2 : 1;
  return result + ".m^" + std::to_string(second * exponent);
}

/// A radian, or a product of a force or a mass with a length.
bool is_of_rotation(std::string_view unit) {
  if (unit.find("rad") != std::string_view::npos) return true;
  const bool begins_so = unit.find('N') != std::string_view::npos || unit.find("kg") != std::string_view::npos;
  const std::size_t lever = unit.find(".m");
  return begins_so && lever != std::string_view::npos && (lever + 2 == unit.size() || !is_letter(unit[lever + 2]));
}

}  // namespace

std::string_view name_of(Coordinate coordinate) {
  return coordinate == Coordinate::angle ? "angle" : "displacement";
}

std::string unit_for(Coordinate coordinate, std::string_view unit) {
  if (coordinate == Coordinate::displacement || is_of_rotation(unit)) return std::string(unit);
  std::string result;
  char sign = '.';  // between the factor and those before it
  for (std::size_t at = 0; at < unit.size();) {
    if (!is_letter(unit[at])) {
      sign = unit[at];
      result += unit[at++];
      continue;
    }
    std::size_t end = at;
    while (end < unit.size() && is_letter(unit[end])) ++end;
    const std::string_view name = unit.substr(at, end - at);
    std::size_t after = end;
    if (after < unit.size() && unit[after] == '^')
      for (++after; after < unit.size() && std::isdigit(static_cast<unsigned char>(unit[after])) != 0;) ++after;
    const std::string_view power = after > end ? unit.substr(end + 1, after - end - 1) : std::string_view();
    std::string factor = raised(rotational(name), power);
    // After a '/' both parts of N.m are in the denominator.
    if (const std::size_t dot = factor.find('.'); sign == '/' && dot != std::string::npos) factor[dot] = '/';
    result += factor;
    at = after;
  }
  return result;
}

std::optional<Coordinate> coordinate_told_by(std::string_view unit, std::string_view dimension) {
  if (unit.empty()) return std::nullopt;
  const bool displacement = unit_factor(unit, dimension, Coordinate::displacement).value.has_value();
  const bool angle = unit_factor(unit, dimension, Coordinate::angle).value.has_value();
  if (displacement == angle) return std::nullopt;
  return angle ? Coordinate::angle : Coordinate::displacement;
}

}  // namespace dualdamp::core
