#pragma once
/// Units in which people are shown results: those in which the user wrote quantities of the same kind, so that Hz
/// stays Hz and mm stays mm. Tables and JSON stay SI.

#include <map>
#include <optional>
#include <string>

namespace dualdamp::scenarios {

struct ShownUnit {
  std::string unit;
  double factor = 1.0;  ///< numbers in SI times this are in the unit
};

using ShownUnits = std::map<std::string, ShownUnit, std::less<>>;  ///< by SI unit

/// `written`: `Scenario::written_units`. What is varied tells first, then the excitation, then the initial state.
[[nodiscard]] ShownUnits shown_units(const std::map<std::string, std::string>& written);

/// Whether numbers up to `largest` [SI] can be read in a unit: 3 um would not in metres. What is never more than
/// zero can.
[[nodiscard]] bool is_legible(double largest, const ShownUnit& unit);

/// The unit for numbers up to `largest` whose SI unit is `unit`; nothing: SI.
[[nodiscard]] std::optional<ShownUnit> shown_unit(const ShownUnits& units, const std::string& unit, double largest);

}  // namespace dualdamp::scenarios
