#pragma once
/// What the readers of data files hand on: columns of numbers under known names, and what makes a record of them.

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// A column a record may have.
struct KnownColumn {
  std::string_view name;
  std::string_view alias;
  std::string_view unit;  ///< SI; empty for a label
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

/// Collects problems and ends the reading when there are too many to be read by anyone.
class Problems {
 public:
  void add(core::Diagnostic diagnostic);
  /// In the order of their places.
  void throw_if_any();

 private:
  std::vector<core::Diagnostic> diagnostics_;
};

[[noreturn]] void refuse_file(const std::string& file, std::string message, std::string allowed = {});

/// A unit of the caller's for a column, or nullptr.
[[nodiscard]] const std::string* find_unit(const std::map<std::string, std::string>& units,
                                           const KnownColumn& known);

/// The factor that the caller's unit for a column makes, or nothing without one; a fault goes to `problems`.
[[nodiscard]] std::optional<double> factor_of_caller(const std::map<std::string, std::string>& units,
                                                     const KnownColumn& known, const std::string& file,
                                                     Problems& problems);

/// Refuses names in the caller's `map` that are no known columns; `option` is what the caller knows it by.
void check_names(const std::map<std::string, std::string>& map, const std::string& option, const std::string& file,
                 Problems& problems);

struct DataColumn {
  const KnownColumn* known = nullptr;
  std::vector<double> values;  ///< SI; NaN where a problem was found
};

/// Rows from `first_row` to the next run bear the same label.
struct LabelRun {
  std::string label;
  std::size_t first_row = 0;
};

struct DataTable {
  std::string file;
  std::vector<DataColumn> columns;  ///< of equal length, each name at most once
  std::vector<LabelRun> sweeps;     ///< empty: no labels
  /// Times are rounded to a multiple of `time_quantum` [s] or to so many significant digits, whichever is coarser.
  double time_quantum = 0.0;
  int time_digits = 17;
  /// Place and text of a value, for messages; its row from 0.
  std::function<core::Diagnostic(std::size_t row, const KnownColumn& known)> show;

  [[nodiscard]] const DataColumn* find(std::string_view name) const;
  [[nodiscard]] std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
};

/// One test of a file that holds several: its columns are of equal length.
struct TestColumns {
  std::string label;
  std::vector<DataColumn> columns;
};

/// The tests below each other. Tests that do not hold the same columns are refused.
[[nodiscard]] DataTable join(const std::string& file, const std::vector<TestColumns>& tests);

/// Pairs where there is a column Y; a decay where there is nothing but extremes, which alternate; histories
/// otherwise. Every fault goes to `problems`; what is left out goes to `warnings`.
[[nodiscard]] Record record_of(DataTable table, Problems& problems, std::vector<std::string>& warnings);

}  // namespace dualdamp::identify
