#pragma once
/// The main chart of a result directory, in the units that the user wrote in the scenario.

#include <cstddef>
#include <optional>
#include <set>
#include <string>

#include "cli/report/chart.hpp"
#include "cli/report/stored_run.hpp"
#include "core/diagnostics.hpp"

namespace dualdamp::cli {

/// `units_of`: the run whose written units are used, this one or the one that it is compared with. Other numbers
/// are in SI. Nothing if the result has no chart.
[[nodiscard]] std::optional<Chart> main_chart(const StoredRun& run, const StoredRun& units_of);

/// The table of a sweep whose rows are a curve for each point, and what of it is drawn.
struct SweptCurves {
  std::string table;
  std::string x;         ///< column
  std::string y;         ///< column
  bool is_by_x = false;  ///< a curve joins its points in the order of x, else in that of the rows
  std::set<std::size_t> points;
};
/// Nothing if the analysis that is swept draws no list of its result as a line.
[[nodiscard]] std::optional<SweptCurves> swept_curves(const StoredRun& run);

/// Why a result has no chart: its analysis has none, or the table with the data is missing.
[[nodiscard]] core::Diagnostic without_chart(const StoredRun& run);

/// Chooses prefixes for numbers in SI: 0.004 m becomes 4 mm.
void make_readable(Chart& chart);

/// The chart of a directory, with prefixes chosen. `units`: stated units, separated by commas. Errors:
/// `core::InputError` if there is no result, or no chart.
[[nodiscard]] Chart main_chart(const std::string& directory, const std::string& units);

/// The title of the scenario, or the name of the result directory.
[[nodiscard]] std::string title_of(const StoredRun& run);

}  // namespace dualdamp::cli
