#pragma once
/// What the coordinate x of the oscillator is: a displacement, or an angle. The equations are the same; the
/// dimensions of their quantities are not:
///
///     displacement   kg      N    N/m      N.s/m      m/s    m/s^2    N/m^3      ...
///     angle          kg.m^2  N.m  N.m/rad  N.m.s/rad  rad/s  rad/s^2  N.m/rad^3  ...
///
/// Tables name every dimension by its unit for a displacement. Code that reads or prints a unit gets it from
/// `unit_for`.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace dualdamp::core {

enum class Coordinate : std::uint8_t { displacement, angle };

/// "displacement", "angle": the words of a scenario.
[[nodiscard]] std::string_view name_of(Coordinate coordinate);

/// The SI unit of a quantity whose unit is `unit` for a displacement: kg becomes kg.m^2, N becomes N.m and m
/// becomes rad, wherever they stand; s, J, W, numbers, phases (rad) and frequencies (rad/s) stay. A unit of
/// rotation stays, too.
[[nodiscard]] std::string unit_for(Coordinate coordinate, std::string_view unit);

/// The coordinate for which `unit` has the dimension named by `dimension`; nothing where `unit` fits both
/// coordinates or neither.
[[nodiscard]] std::optional<Coordinate> coordinate_told_by(std::string_view unit, std::string_view dimension);

}  // namespace dualdamp::core
