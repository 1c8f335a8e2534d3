#pragma once
/// What the readers of data files hand on: columns of numbers under known names.

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.hpp"
#include "identify/readers/columns.hpp"
#include "identify/readers/problems.hpp"
#include "identify/readers/record_reader.hpp"

namespace dualdamp::identify {

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
  ColumnUnits units;
  std::vector<LabelRun> sweeps;            ///< empty: no labels
  std::vector<std::size_t> restarts = {};  ///< rows before which the header stood again
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

}  // namespace dualdamp::identify
