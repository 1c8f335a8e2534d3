#pragma once
/// Quantities as text: `1.042 kg`, `3 um`, `4 N.s/m`, `6.17 Hz`, `90 deg` to SI numbers.
///
/// The number is parsed here (core/numbers.hpp); udunits2 gets only the unit. A bare number means SI. A dimension
/// is named by its SI unit in udunits2 spelling: "kg", "N/m", "N.s/m", "1" (a plain number), "rad" (an angle),
/// "rad/s" (a frequency), ...
///
/// Angles and frequencies are dimensions of their own, because udunits2 takes a radian for the number 1:
/// * a frequency is written in Hz, mHz, kHz, rpm or rad/s, and Hz means 2 pi rad/s; a bare number and 1/s are
/// refused;
/// * a unit of angle is refused for every dimension but "rad", for which only such a unit, or none, is accepted.
/// Where the coordinate is an angle (core/coordinate.hpp), `dimension` still names the one for a displacement: "kg"
/// reads a moment of inertia, "m" an angle, "m/s" an angular velocity, for which a bare number is rad/s.
///
/// Units are products of powers with integer exponents; `m^0.5`, `m^1/2`, offsets (`degC`) and logarithms are
/// refused. The Greek letter mu, the degree sign, raised 2 and 3 and the middle dot may be typed.
///
/// Cost: udunits2's database is read once, at the first unit that is not in plain SI spelling. Safe to call from
/// several threads.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/coordinate.hpp"

namespace dualdamp::core {

struct QuantityText {
  std::optional<double> value;  ///< SI
  std::string fault;            ///< why there is no value, a sentence without final stop; empty when there is one
  std::string suggestion;       ///< a unit that was perhaps meant, with the number; may be empty
};

/// A quantity of the dimension of `si_unit`.
[[nodiscard]] QuantityText parse_quantity(std::string_view text, std::string_view si_unit,
                                          Coordinate coordinate = Coordinate::displacement);

/// The factor that converts a number in `unit` to `si_unit`: for the head of a data column. An empty unit is SI.
[[nodiscard]] QuantityText unit_factor(std::string_view unit, std::string_view si_unit,
                                       Coordinate coordinate = Coordinate::displacement);

/// `text` without the blanks, tabs and carriage returns at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// Whether the unit can name a dimension: an SI unit, or a product of SI units, with factor 1.
[[nodiscard]] bool is_si(std::string_view unit);

/// "a mass such as '5 kg'": what is accepted, for messages and documentation.
[[nodiscard]] std::string describe_dimension(std::string_view si_unit,
                                             Coordinate coordinate = Coordinate::displacement);

/// Usual spellings of units of this dimension, the SI unit first: for messages and for the pattern of an editor's
/// schema. udunits2 knows many more.
[[nodiscard]] const std::vector<std::string_view>& usual_units(std::string_view si_unit,
                                                               Coordinate coordinate = Coordinate::displacement);

}  // namespace dualdamp::core
