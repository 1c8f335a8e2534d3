#pragma once
/// The rows of measured and computed curves, as a fit and a prediction write them: PREFIX_RECORD_SIGNAL.csv.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/report/stored_run.hpp"

namespace dualdamp::cli {

/// Rows of a table, in the order in which a line joins them.
using Rows = std::vector<std::size_t>;

/// The main signal of the first record.
struct Overlay {
  StoredTable table;
  std::string signal;       ///< x, or else force, v, a
  std::string x;            ///< column of the abscissa: that of a loop is the displacement
  std::string computed;     ///< column beside `measured`
  std::vector<Rows> lines;  ///< of steady states one for each level, in the order of the abscissa
  std::size_t records = 0;  ///< of the fit or prediction
  bool is_dense = false;    ///< there are so many samples that the measured ones are a line
};

/// Nothing if the run has no such table.
[[nodiscard]] std::optional<Overlay> overlay_of(const StoredRun& run, std::string_view prefix);

/// The rows in the order of a column.
[[nodiscard]] Rows in_order_of(const StoredColumn& column, Rows rows);

}  // namespace dualdamp::cli
