#pragma once
/// The main chart of a result directory, in the units the user wrote where a quantity of the scenario tells one.

#include <optional>

#include "cli/report/chart.hpp"
#include "cli/report/stored_run.hpp"
#include "core/diagnostics.hpp"

namespace dualdamp::cli {

/// `units_of`: the run whose written units are taken, this one or one that it is compared with; other numbers are
/// SI. Nothing where the result has no chart.
[[nodiscard]] std::optional<Chart> main_chart(const StoredRun& run, const StoredRun& units_of);

/// Why a result has no chart: its analysis has none, or the table that is drawn is not beside it.
[[nodiscard]] core::Diagnostic without_chart(const StoredRun& run);

/// Numbers in SI get a prefix that makes them pleasant to read: 0.004 m is 4 mm.
void make_readable(Chart& chart);

/// The readable chart of a directory. Errors: `core::InputError` when there is no result, or it has no chart.
/// `units`: those that somebody asks for, with commas.
[[nodiscard]] Chart main_chart(const std::string& directory, const std::string& units = {});

/// The file, or the scenario's title.
[[nodiscard]] std::string title_of(const StoredRun& run);

}  // namespace dualdamp::cli
