#pragma once
/// What the coordinate x of the oscillator is: a displacement, or an angle. The equations are the same; the
/// dimensions of their quantities are not:
///
///     displacement   kg      N    N/m      N.s/m      m/s    m/s^2    N/m^3      ...
///     angle          kg.m^2  N.m  N.m/rad  N.m.s/rad  rad/s  rad/s^2  N.m/rad^3  ...
///
/// Tables name every dimension by its unit for a displacement. Whatever reads or shows a unit asks `unit_for`.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dualdamp::core {

enum class Coordinate : std::uint8_t { displacement, angle };

/// "displacement", "angle": the words of a scenario.
[[nodiscard]] std::string_view name_of(Coordinate coordinate);

/// The SI unit of a quantity whose unit is `unit` for a displacement: kg becomes kg.m^2, N becomes N.m and m
/// becomes rad, wherever they stand; s, J, W, numbers, phases (rad) and frequencies (rad/s) stay. So does a unit of
/// rotation.
[[nodiscard]] std::string unit_for(Coordinate coordinate, std::string_view unit);

/// What the coordinate must be for `unit` to be one of this dimension; nothing where it tells nothing: it may be
/// either, or neither.
[[nodiscard]] std::optional<Coordinate> coordinate_told_by(std::string_view unit, std::string_view dimension);

}  // namespace dualdamp::core
