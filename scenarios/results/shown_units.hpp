#pragma once
/// Units of printed results: those in which the user wrote quantities of the same kind, so that Hz stays Hz and mm
/// stays mm. Tables and JSON stay SI.

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace dualdamp::scenarios {

struct ShownUnit {
  std::string unit;
  double factor = 1.0;    ///< numbers in SI times this are in the unit
  bool is_asked = false;  ///< requested by name, for numbers of any size
};

using ShownUnits = std::map<std::string, ShownUnit, std::less<>>;  ///< by kind of quantity

/// The kind of a quantity: its SI unit, but "angular velocity" for that of an angle, whose SI unit is also that of
/// a frequency. `name`: of its column, or its path in the result.
[[nodiscard]] std::string kind_of(const std::string& unit, std::string_view name);

/// `written`: `Scenario::written_units`. Order of preference: units of measured data, of varied quantities, of the
/// amplitude and frequency of the excitation, of the initial state, of the kinetic friction; then of every other
/// key of the excitation and the initial state, and of the forces and velocities of the friction.
[[nodiscard]] ShownUnits shown_units(const std::map<std::string, std::string>& written);

/// Adds requested units for results, separated by commas ("mm, Hz, kN"), to the written ones, before which they
/// have preference. Returns why one cannot be the unit of a result; empty: all can.
[[nodiscard]] std::string ask_for_units(std::string_view list, std::map<std::string, std::string>& written);

/// The requested units that are of none of these kinds of quantities.
[[nodiscard]] std::vector<std::string> unused_units(const std::map<std::string, std::string>& written,
                                                    const std::set<std::string>& kinds);

/// Warning that no quantity of a result has these requested units; empty if there are none. `there`: the units that
/// its quantities have.
[[nodiscard]] std::string warning_of_units(const std::vector<std::string>& unused,
                                           const std::map<std::string, std::string>& written,
                                           const std::vector<std::string>& there);

/// Whether an entry of the written units is a requested one.
[[nodiscard]] bool is_asked_for(std::string_view path);

/// Whether numbers up to `largest` [SI] are readable in a unit: 3 um is not in metres. Numbers that are all zero
/// are.
[[nodiscard]] bool is_legible(double largest, const ShownUnit& unit);

/// The unit for numbers up to `largest` of this kind; nothing: SI.
[[nodiscard]] std::optional<ShownUnit> shown_unit(const ShownUnits& units, const std::string& kind, double largest);

}  // namespace dualdamp::scenarios
