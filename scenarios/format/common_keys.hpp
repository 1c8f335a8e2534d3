#pragma once
/// Keys that several sections of the format have.

#include "scenarios/format/keys.hpp"

namespace dualdamp::scenarios {

/// Items of a list of ranges, sensors, estimates and the like.
inline constexpr std::size_t max_sets = 100;

[[nodiscard]] Field amplitudes();
[[nodiscard]] Field frequencies();
/// Number of extremes of a free vibration.
[[nodiscard]] Field peaks();
/// Seed of random values.
[[nodiscard]] Field seed();
/// {from, to}: the range of a branch.
[[nodiscard]] Field range(std::string name, const std::vector<std::string>& units, std::string meaning);
/// One signal of a data file: file, column, unit and how to read them. `column`: its default name; `si`: its unit.
[[nodiscard]] std::vector<Field> signal_file(const std::string& column, const std::string& si);
/// The field, made optional.
[[nodiscard]] Field optional(Field field);

}  // namespace dualdamp::scenarios
