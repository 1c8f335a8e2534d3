#pragma once
/// Units in which people are shown results: those in which the user wrote quantities of the same kind, so that Hz
/// stays Hz and mm stays mm. Tables and JSON stay SI.

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace dualdamp::scenarios {

struct ShownUnit {
  std::string unit;
  double factor = 1.0;    ///< numbers in SI times this are in the unit
  bool is_asked = false;  ///< by name, for whatever size
};

using ShownUnits = std::map<std::string, ShownUnit, std::less<>>;  ///< by SI unit

/// `written`: `Scenario::written_units`. What was measured tells first, then what is varied, the excitation, then
/// the initial state.
[[nodiscard]] ShownUnits shown_units(const std::map<std::string, std::string>& written);

/// Notes units that the user asks results to be shown in, with commas ("mm, Hz, kN"), among the written ones, which
/// they go before. Why not, where one is no unit of results; empty: all are.
[[nodiscard]] std::string ask_for_units(std::string_view list, std::map<std::string, std::string>& written);

/// Whether an entry of the written units is one that was asked for.
[[nodiscard]] bool is_asked_for(std::string_view path);

/// Whether numbers up to `largest` [SI] can be read in a unit: 3 um would not in metres. What is never more than
/// zero can.
[[nodiscard]] bool is_legible(double largest, const ShownUnit& unit);

/// The unit for numbers up to `largest` whose SI unit is `unit`; nothing: SI.
[[nodiscard]] std::optional<ShownUnit> shown_unit(const ShownUnits& units, const std::string& unit, double largest);

}  // namespace dualdamp::scenarios
