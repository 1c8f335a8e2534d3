#include "scenarios/format/values.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "core/units.hpp"

namespace dualdamp::scenarios {

namespace {

/// The decimal number that the user means: 0 to 0.6 in six steps gives 0.1, not 0.09999999999999999.
double plain(double value) {
  constexpr int digits = 14;
  return core::parse_number(core::format_number(value, digits)).value.value_or(value);
}

double in_si(double value, const std::string& unit) {
  return unit.empty() ? value : number(Json(core::format_number(value) + " " + unit));
}

/// `value` in SI in this unit, if it is exactly what a decimal number of few digits in this unit stands for.
std::optional<double> plain_in(const std::string& unit, double value) {
  const double decimal = plain(value / in_si(1.0, unit));
  return in_si(decimal, unit) == value ? std::optional(decimal) : std::nullopt;
}

/// A unit in which both frequencies are decimal numbers of few digits: there the values between them are those that
/// a list would state. Empty: there is none, or they are no frequencies.
std::string decimal_unit(const Json& from, const Json& to) {
  if (!from.is_string() || !to.is_string()) return {};
  for (const char* unit : {"rad/s", "Hz", "rpm", "kHz", "mHz"})
    if (plain_in(unit, number(from)) && plain_in(unit, number(to))) return unit;
  return {};
}

}  // namespace

const Json* find_value(const Json& json, std::string_view path) {
  const Json* value = &json;
  while (!path.empty()) {
    const bool is_index = path.front() == '[';
    if (is_index || path.front() == '.') path.remove_prefix(1);
    const std::size_t end = std::min(path.find_first_of(is_index ? "]" : ".["), path.size());
    const std::string key(path.substr(0, end));
    if (is_index) {
      const std::size_t index = std::stoul(key);
      if (!value->is_array() || index >= value->size()) return nullptr;
      value = &value->at(index);
    } else {
      if (!value->is_object() || !value->contains(key)) return nullptr;
      value = &value->at(key);
    }
    path.remove_prefix(std::min(end + (is_index ? 1 : 0), path.size()));
  }
  return value;
}

double number(const Json& value) {
  return value.is_string() ? core::parse_quantity(value.get<std::string>(), "rad/s").value.value()
                           : value.get<double>();
}

double number_or(const Json& section, const std::string& key, double fallback) {
  return section.contains(key) ? number(section.at(key)) : fallback;
}

std::string written_unit(std::string_view quantity) {
  quantity.remove_prefix(core::read_number(quantity).length);
  if (quantity.find('+') != std::string_view::npos || quantity.find("±") != std::string_view::npos) return {};
  const std::size_t begin = quantity.find_first_not_of(' ');
  if (begin == std::string_view::npos) return {};
  return std::string(quantity.substr(begin, quantity.find_last_not_of(' ') + 1 - begin));
}

void note_unit(const std::string& path, std::string_view quantity, std::map<std::string, std::string>& units) {
  const std::string unit = written_unit(quantity);
  if (!unit.empty()) units.emplace(path.ends_with(']') ? path.substr(0, path.rfind('[')) : path, unit);
}

std::vector<double> grid_values(const Json& grid) {
  std::vector<double> values;
  if (grid.is_array()) {
    for (const Json& value : grid) values.push_back(number(value));
    return values;
  }
  const std::string unit = decimal_unit(grid.at("from"), grid.at("to"));
  const auto end = [&](const char* key) {
    const double value = number(grid.at(key));
    return unit.empty() ? value : plain_in(unit, value).value_or(value);
  };
  const double from = end("from");
  const double to = end("to");
  const auto count = grid.at("count").get<std::size_t>();
  const bool is_log = grid.at("spacing") == "log";
  const bool is_plain = plain(from) == from && plain(to) == to;
  for (std::size_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    const double value = is_log ? from * std::pow(to / from, share) : from + share * (to - from);
    values.push_back(in_si(is_log || !is_plain ? value : plain(value), unit));
  }
  values.front() = number(grid.at("from"));
  values.back() = number(grid.at("to"));
  return values;
}

std::size_t grid_size(const Json& grid) {
  return grid.is_array() ? grid.size() : grid.at("count").get<std::size_t>();
}

double duration_of(const Json& section, double frequency) {
  const double period = core::two_pi / frequency;
  return section.contains("cycles") ? number(section.at("cycles")) * period : number(section.at("duration"));
}

}  // namespace dualdamp::scenarios
