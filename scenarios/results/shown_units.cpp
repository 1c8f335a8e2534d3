#include "scenarios/results/shown_units.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "core/diagnostics.hpp"
#include "core/units.hpp"

namespace dualdamp::scenarios {

namespace {

/// Prefix of the number of a requested unit; no path of a scenario begins with it.
constexpr std::string_view asked = "(asked)[";

void add(const std::string& unit, std::span<const char* const> kinds, bool is_asked, ShownUnits& units) {
  // Torque and work have one dimension.
  const std::string_view other = unit.find('J') == std::string::npos ? "J" : "N.m";
  for (const char* kind : kinds)
    if (const auto factor = core::unit_factor(unit, kind).value; factor && *factor > 0.0 && kind != other)
      units.emplace(kind, ShownUnit{unit, 1.0 / *factor, is_asked});
}

constexpr std::array all_kinds = {"m", "rad", "rad/s", "m/s", "s",     "N",     "N.m",  "J",
                                  "W", "kg",  "N/m",   "N/s", "N.s/m", "m/s^2", "N/m^3"};

constexpr const char* angular_velocity = "angular velocity";

void add_angular_velocity(const std::string& unit, bool is_asked, ShownUnits& units) {
  const auto factor = core::unit_factor(unit, "m/s", core::Coordinate::angle).value;
  if (factor && *factor > 0.0) units.emplace(angular_velocity, ShownUnit{unit, 1.0 / *factor, is_asked});
}

/// Hz and rpm are of frequencies, deg/s is of velocities, and rad/s is of both.
void add_asked(const std::string& unit, ShownUnits& units) {
  add(unit, all_kinds, true, units);
  if (unit == "rad/s" || !core::unit_factor(unit, "rad/s").value) add_angular_velocity(unit, true, units);
}

}  // namespace

std::string ask_for_units(std::string_view list, std::map<std::string, std::string>& written) {
  std::size_t number = 0;
  ShownUnits taken;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    std::string unit(list.substr(begin, end - begin));
    std::erase(unit, ' ');
    ShownUnits known;
    if (!unit.empty()) add_asked(unit, known);
    if (known.empty())
      return "'" + unit + "' is no unit of a result; such as mm, um, Hz, rpm, ms, mm/s, deg, kN, N/mm";
    for (const auto& [kind, shown] : known)
      if (const auto before = taken.find(kind); before != taken.end())
        return "'" + before->second.unit + "' and '" + unit + "' are two units of one quantity: state one of them";
    taken.merge(known);
    written[std::string(asked) + std::to_string(number++) + "]"] = unit;
    begin = end + 1;
  }
  return {};
}

std::string kind_of(const std::string& unit, std::string_view name) {
  std::string_view last = name.substr(name.find_last_of('.') + 1);
  last = last.substr(0, last.find('['));  // velocity[1]: that of the second record
  const bool is_velocity = last == "v" || last == "max_speed" || last.ends_with("velocity");
  return unit == "rad/s" && is_velocity ? angular_velocity : unit;
}

bool is_asked_for(std::string_view path) { return path.starts_with(asked); }

namespace {

/// A velocity in rpm says nothing about the unit of frequencies.
void add_stated(std::string_view path, const std::string& unit, ShownUnits& units) {
  constexpr std::array kinds = {"m", "rad", "rad/s", "m/s", "s", "N", "N.m"};
  constexpr std::array velocity = {"m/s"};
  constexpr std::array of_friction = {"N", "N.m"};  // its lengths are those of asperities and bristles
  if (path == "data.v" || path.find("velocity") != std::string_view::npos) {
    add(unit, velocity, false, units);
    add_angular_velocity(unit, false, units);
  } else if (path.starts_with("system.friction")) {
    add(unit, of_friction, false, units);
  } else {
    add(unit, kinds, false, units);
  }
}

}  // namespace

ShownUnits shown_units(const std::map<std::string, std::string>& written) {
  constexpr std::array first = {"data.x",
                                "data.y",
                                "data.Y",
                                "data.v",
                                "data.force",
                                "data.omega",
                                "data.t",
                                "analysis.amplitudes",
                                "analysis.frequencies",
                                "analysis.duration",
                                "analysis.measurement.amplitudes",
                                "excitation.amplitude",
                                "analysis.measurement.frequencies",
                                "excitation.frequency",
                                "initial.position",
                                "initial.velocity",
                                "system.friction.kinetic"};
  ShownUnits units;
  for (const auto& [path, unit] : written)
    if (is_asked_for(path)) add_asked(unit, units);
  for (const std::string quantity : first)
    for (const std::string& path : {quantity, quantity + ".from"})
      if (const auto unit = written.find(path); unit != written.end()) add_stated(path, unit->second, units);
  for (const auto& [path, unit] : written)
    for (const std::string_view section : {"excitation.", "initial.", "system.friction"})
      if (path.starts_with(section)) add_stated(path, unit, units);
  return units;
}

std::vector<std::string> unused_units(const std::map<std::string, std::string>& written,
                                      const std::set<std::string>& kinds) {
  std::vector<std::string> unused;
  for (const auto& [path, unit] : written) {
    if (!is_asked_for(path)) continue;
    ShownUnits possible;
    add_asked(unit, possible);
    if (std::ranges::none_of(possible, [&](const auto& entry) { return kinds.contains(entry.first); }))
      unused.push_back(unit);
  }
  return unused;
}

namespace {

/// Whether a quantity of the kind of one of these requested units is written in some unit.
bool are_stated(const std::vector<std::string>& requested, const std::map<std::string, std::string>& written) {
  const auto kinds_of_unit = [](const std::string& unit) {
    ShownUnits kinds;
    add_asked(unit, kinds);
    return kinds;
  };
  ShownUnits wanted;
  for (const std::string& unit : requested) wanted.merge(kinds_of_unit(unit));
  return std::ranges::any_of(written, [&](const auto& entry) {
    return !is_asked_for(entry.first) && std::ranges::any_of(kinds_of_unit(entry.second), [&](const auto& kind) {
      return wanted.contains(kind.first);
    });
  });
}

}  // namespace

std::string warning_of_units(const std::vector<std::string>& unused,
                             const std::map<std::string, std::string>& written,
                             const std::vector<std::string>& there) {
  if (unused.empty()) return {};
  return "no quantity of the result is in a unit that was asked for: " + core::joined(unused) +
         (are_stated(unused, written)
              ? "; what the data or the scenario states in such units is not repeated in the result"
              : "") +
         (there.empty() ? "; its numbers have no units" : "; its quantities are in " + core::joined(there));
}

bool is_legible(double largest, const ShownUnit& unit) {
  constexpr double least = 1e-3;
  constexpr double most = 1e6;
  const double number = largest * unit.factor;
  return unit.is_asked || largest == 0.0 || (number >= least && number < most);
}

std::optional<ShownUnit> shown_unit(const ShownUnits& units, const std::string& kind, double largest) {
  const auto found = units.find(kind);
  if (found == units.end() || !is_legible(largest, found->second)) return std::nullopt;
  return found->second;
}

}  // namespace dualdamp::scenarios
