#pragma once
/// The columns a data file may hold, and what their headings say: which column, in which unit.

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace dualdamp::identify {

/// A column a record may have.
struct KnownColumn {
  std::string_view name;
  std::string_view alias;
  std::string_view unit;  ///< SI, of a displacement (core/coordinate.hpp); empty for a label
  bool is_signal = false;
};

inline constexpr std::array<KnownColumn, 12> known_columns = {{{"t", "time", "s"},
                                                               {"Y", "", "m"},
                                                               {"x", "position", "m", true},
                                                               {"y", "", "m", true},
                                                               {"v", "velocity", "m/s", true},
                                                               {"a", "acceleration", "m/s^2", true},
                                                               {"force", "", "N", true},
                                                               {"omega", "frequency", "rad/s"},
                                                               {"phase", "", "rad"},
                                                               {"fundamental", "", "m"},
                                                               {"mean_square_speed", "", "m^2/s^2"},
                                                               {"sweep", "", ""}}};

/// nullptr when no column has this name or alias.
[[nodiscard]] const KnownColumn* known_column(std::string_view name);

/// What makes a record, for messages.
inline constexpr std::string_view allowed_columns =
    "Y and x (pairs), x alone or t and x (extremes), or t and any of x, y, v, a, force (histories)";

/// "x [mm]" or "x (mm)" taken apart.
struct Heading {
  std::string text;  ///< the whole of it
  std::string name;
  std::string unit;
  int column = 1;  ///< where it stands in its line
  bool well_formed = true;
};
[[nodiscard]] Heading parse_heading(std::string_view text, int column);

/// The column that a heading names; its unit where that stands behind the name without brackets, such as `x_mm`,
/// `x / mm`, `time, ms`, goes from the name to `heading.unit`. nullptr when it names none.
///
/// Y and y are two columns. Other names of one letter are known in the other case too where their unit fits, `X
/// [mm]`; longer names in any case. f and freq are frequencies or forces where their unit says so, `f_Hz`, `F [N]`.
[[nodiscard]] const KnownColumn* named_column(Heading& heading);

/// The warning of a column, variable or field that is none of the known ones; `is_of_ignored` knows it again.
[[nodiscard]] std::string ignored(std::string_view what, const std::string& name);

/// "a, b and c"
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

}  // namespace dualdamp::identify
