#pragma once
/// The columns that a data file may hold, and how a heading states the column and its unit.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/setting.hpp"
#include "identify/readers/brackets.hpp"

namespace dualdamp::identify {

/// A column that a record may have.
struct KnownColumn {
  std::string_view name;
  std::string_view alias;
  std::string_view unit;  ///< SI, for x in metres (core/coordinate.hpp); empty for a label
  bool is_signal = false;
  bool may_lack = false;  ///< a row may have no value: NaN in the table
};

inline constexpr std::array<KnownColumn, 12> known_columns = {{{"t", "time", "s"},
                                                               {"Y", "", "m"},
                                                               {"x", "position", "m", true},
                                                               {"y", "", "m", true},
                                                               {"v", "velocity", "m/s", true},
                                                               {"a", "acceleration", "m/s^2", true},
                                                               {"force", "", "N", true},
                                                               {"omega", "frequency", "rad/s"},
                                                               {"phase", "", "rad", false, true},
                                                               {"fundamental", "", "m"},
                                                               {"mean_square_speed", "", "m^2/s^2"},
                                                               {"sweep", "", ""}}};

/// nullptr if no column has this name or alias.
[[nodiscard]] const KnownColumn* known_column(std::string_view name);

/// For messages: the columns that make a record.
inline constexpr std::string_view allowed_columns =
    "Y and x (pairs), x alone or t and x (extremes), or t and any of x, y, v, a, force (histories)";

/// The parts of a heading such as "x [mm]", "x (mm)" or "Weg (Kanal 2) [mm]".
struct Heading {
  std::string text;  ///< the whole heading
  std::string name;  ///< what stands before its brackets
  std::string unit;
  int column = 1;  ///< position in its line, from 1
  bool well_formed = true;
  std::vector<Bracket> brackets = {};
  std::string behind = {};      ///< what stands behind its last bracket
  std::string other_unit = {};  ///< one that contradicts `unit`
};
/// `unit` is what the only bracket holds. `choose_unit` tells among several.
[[nodiscard]] Heading parse_heading(std::string_view text, int column);

/// Whether the column may have this unit.
[[nodiscard]] bool is_unit_of(const std::string& unit, const KnownColumn& known);

/// Of several brackets, the unit of the column: square brackets go before others, and among those of one kind the
/// last one that holds a unit of the column's dimension. A bracket that holds no unit is part of the name. A unit
/// may also follow the brackets: `Weg (Kanal 2) in mm`.
void choose_unit(Heading& heading, const KnownColumn& known);

/// Whether the caller may mean this heading: by its text, by its name, or by its text without one of its brackets.
[[nodiscard]] bool is_called(const Heading& heading, std::string_view called);

/// The column that a heading names; nullptr if it names none. A unit that follows the name without brackets, such
/// as `x_mm`, `x / mm`, `time, ms`, is moved from the name to `heading.unit`.
///
/// Y and y are two columns. Other names of one letter may be in the other case if their unit fits, `X [mm]`; longer
/// names may be in any case. f and freq are frequencies or forces if their unit says so: `f_Hz`, `F [N]`.
[[nodiscard]] const KnownColumn* named_column(Heading& heading);

/// Moves a unit of `known` from the end of a name of the caller's choice to `heading.unit`: `Weg in mm`, `Weg/mm`,
/// `Weg_mm`. The name of `Weg_[mm]` becomes `Weg`.
void split_unit(Heading& heading, const KnownColumn& known);

/// Whether the name is that of an output, `x_out`: beside it, `x_in` is an input.
[[nodiscard]] bool is_output(std::string_view name);

/// The warning about an unknown column, variable or field. If it seems to hold the uncertainty of each reading, the
/// warning tells how one for all readings is stated.
[[nodiscard]] std::string ignored(std::string_view what, const std::string& name, const core::SettingWords& words);

/// The warnings about unknown columns, variables or fields: one for each, or one for all if there are more than
/// three. `what`: "column".
[[nodiscard]] std::vector<std::string> all_ignored(std::string_view what, const std::vector<std::string>& names,
                                                   const core::SettingWords& words);

}  // namespace dualdamp::identify
