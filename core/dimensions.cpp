#include "core/dimensions.hpp"

#include <algorithm>
#include <string>

namespace dualdamp::core {

namespace {

const std::vector<Dimension>& dimensions() {
  static const std::vector<Dimension> table = {
      {"1", "a number", "0.2", {"1", "%"}},
      {"kg", "a mass", "5 kg", {"kg", "g", "mg", "t", "lb", "oz"}},
      {"m", "a length", "3 mm", {"m", "mm", "um", "µm", "nm", "cm", "km", "in", "ft"}},
      {"s", "a time", "20 s", {"s", "ms", "us", "µs", "min", "h"}},
      {"N", "a force", "2 N", {"N", "mN", "kN", "MN", "lbf", "ozf"}},
      {"N/m",
       "a stiffness",
       "1568 N/m",
       {"N/m", "kN/m", "MN/m", "N/mm", "kN/mm", "N/um", "N/µm", "N/cm", "lbf/in"}},
      {"N.s/m",
       "a damping coefficient",
       "4 N.s/m",
       {"N.s/m", "N*s/m", "N s/m", "kN.s/m", "mN.s/m", "N.s/mm", "N.s/cm", "kg/s", "lbf.s/in"}},
      {"m/s", "a velocity", "0.1 m/s", {"m/s", "mm/s", "um/s", "µm/s", "cm/s", "km/h", "in/s", "ft/s"}},
      {"m/s^2", "an acceleration", "9.81 m/s^2", {"m/s^2", "mm/s^2", "m/s2", "mm/s2", "g_n", "g"}},
      {"N/s", "a force rate", "0.5 N/s", {"N/s", "mN/s", "kN/s", "N/ms"}},
      {"N/m^3", "a cubic stiffness", "2000 N/m^3", {"N/m^3", "kN/m^3", "MN/m^3", "N/m3", "N/mm^3", "N/mm3"}},
      {"1/s", "a rate", "1 kHz", {"1/s", "Hz", "mHz", "kHz", "MHz", "1/ms", "1/min", "1/h"}},
      {"N.m",
       "a torque",
       "2 N.m",
       {"N.m", "N m", "N*m", "mN.m", "uN.m", "kN.m", "N.cm", "N.mm", "lbf.in", "lbf.ft"}},
      {"J", "an energy", "1 J", {"J", "mJ", "kJ", "N.m"}},
      {"W", "a power", "2 W", {"W", "mW", "kW"}},
      {"m^2.s", "a spectral density", "2 mm^2/Hz", {"m^2.s", "mm^2.s", "m^2/Hz", "mm^2/Hz", "um^2/Hz"}},
      {"N^2.s", "a spectral density", "2 N^2/Hz", {"N^2.s", "mN^2.s", "N^2/Hz", "mN^2/Hz"}},
      {"rad", "an angle", "90 deg", {"rad", "mrad", "deg"}},
      {"rad/s", "a frequency", "6.17 Hz", {"rad/s", "Hz", "mHz", "kHz", "rpm"}},
  };
  return table;
}

/// The dimensions where the coordinate is an angle. An angular velocity is not a frequency: it may be negative, and
/// without unit it is in rad/s.
const std::vector<Dimension>& dimensions_of_rotation() {
  static const std::vector<Dimension> table = {
      {"kg.m^2",
       "a moment of inertia",
       "0.3 kg.m^2",
       {"kg.m^2", "kg m^2", "kg*m^2", "kg.m2", "g.m^2", "kg.cm^2", "g.cm^2", "kg.mm^2", "g.mm^2", "lb.in^2"}},
      {"N.m/rad",
       "a torsional stiffness",
       "12 N.m/rad",
       {"N.m/rad", "N m/rad", "N*m/rad", "mN.m/rad", "kN.m/rad", "N.mm/rad", "N.m/deg", "mN.m/deg", "lbf.in/rad"}},
      {"N.m.s/rad",
       "a torsional damping coefficient",
       "0.04 N.m.s/rad",
       {"N.m.s/rad", "N m s/rad", "N*m*s/rad", "mN.m.s/rad", "kN.m.s/rad", "N.mm.s/rad", "N.m.s/deg",
        "lbf.in.s/rad"}},
      {"rad/s", "an angular velocity", "0.5 rad/s", {"rad/s", "mrad/s", "deg/s", "rpm"}},
      {"rad/s^2", "an angular acceleration", "3 rad/s^2", {"rad/s^2", "mrad/s^2", "deg/s^2", "rad/s2", "deg/s2"}},
      {"N.m/s", "a torque rate", "0.5 N.m/s", {"N.m/s", "mN.m/s", "kN.m/s"}},
      {"N.m/rad^3",
       "a cubic torsional stiffness",
       "20 N.m/rad^3",
       {"N.m/rad^3", "mN.m/rad^3", "kN.m/rad^3", "N.m/rad3", "N.m/deg^3"}},
      {"rad^2.s", "a spectral density", "2 rad^2/Hz", {"rad^2.s", "rad^2/Hz", "mrad^2/Hz", "deg^2/Hz"}},
      {"N^2.m^2.s", "a spectral density", "2 N^2.m^2/Hz", {"N^2.m^2.s", "N^2.m^2/Hz", "mN^2.m^2/Hz"}},
  };
  return table;
}

const Dimension* find_in(const std::vector<Dimension>& table, std::string_view si_unit) {
  const auto found = std::ranges::find(table, si_unit, &Dimension::si_unit);
  return found == table.end() ? nullptr : &*found;
}

}  // namespace

const Dimension* find_dimension(std::string_view si_unit, Coordinate coordinate) {
  const std::string unit = unit_for(coordinate, si_unit);
  const Dimension* changed = unit == si_unit ? nullptr : find_in(dimensions_of_rotation(), unit);
  return changed != nullptr ? changed : find_in(dimensions(), unit);
}

bool is_dimension(std::string_view si_unit) { return find_in(dimensions(), si_unit) != nullptr; }

}  // namespace dualdamp::core
