#include "scenarios/results/shown_units.hpp"

#include <array>

#include "core/units.hpp"

namespace dualdamp::scenarios {

ShownUnits shown_units(const std::map<std::string, std::string>& written) {
  constexpr std::array kinds = {"m", "rad", "rad/s", "m/s", "s", "N", "N.m"};
  constexpr std::array quantities = {"analysis.amplitudes",  "analysis.frequencies",
                                     "analysis.duration",    "analysis.measurement.amplitudes",
                                     "excitation.amplitude", "analysis.measurement.frequencies",
                                     "excitation.frequency", "initial.position",
                                     "initial.velocity",     "system.friction.kinetic"};
  ShownUnits units;
  for (const std::string quantity : quantities)
    for (const std::string& path : {quantity, quantity + ".from"}) {
      const auto unit = written.find(path);
      if (unit == written.end()) continue;
      for (const char* kind : kinds)
        if (const auto factor = core::unit_factor(unit->second, kind).value; factor && *factor > 0.0)
          units.emplace(kind, ShownUnit{unit->second, 1.0 / *factor});
    }
  return units;
}

bool is_legible(double largest, const ShownUnit& unit) {
  constexpr double least = 1e-3;
  constexpr double most = 1e6;
  const double number = largest * unit.factor;
  return largest == 0.0 || (number >= least && number < most);
}

std::optional<ShownUnit> shown_unit(const ShownUnits& units, const std::string& unit, double largest) {
  const auto found = units.find(unit);
  if (found == units.end() || !is_legible(largest, found->second)) return std::nullopt;
  return found->second;
}

}  // namespace dualdamp::scenarios
