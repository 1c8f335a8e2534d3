#pragma once
/// The result of reading a data file: columns of numbers with known names.

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
  std::vector<double> values;  ///< SI; NaN for a value with a problem, or a phase that was not measured
};

/// Rows with the same label, from `first_row` to the next run.
struct LabelRun {
  std::string label;
  std::size_t first_row = 0;
};

struct DataTable {
  std::string file;
  std::vector<DataColumn> columns;  ///< of equal length, each name at most once
  ColumnUnits units;
  std::vector<std::string> ignored = {};   ///< warnings about unknown columns
  std::vector<LabelRun> sweeps;            ///< empty: no labels
  std::vector<std::size_t> restarts = {};  ///< rows that follow a repeated header
  /// Times are rounded to a multiple of `time_quantum` [s] or to `time_digits` digits, whichever is coarser.
  double time_quantum = 0.0;
  int time_digits = 17;
  /// Place and text of a value, for messages. Rows count from 0.
  std::function<core::Diagnostic(std::size_t row, const KnownColumn& known)> show;

  [[nodiscard]] const DataColumn* find(std::string_view name) const;
  [[nodiscard]] std::size_t rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
};

/// Gives a table without times those of samples at this rate [1/s]. They begin at zero, and again where a label or
/// a repeated header begins a test.
void add_times(DataTable& table, double sample_rate);

/// Complains of the times of `count` rows from `first` that are not after the row above: one problem for those that
/// are equal to it, one for those that are before it. The table has times.
void check_increasing(const DataTable& table, std::size_t first, std::size_t count, Problems& problems);

/// One problem of several rows, if there are any. Only some rows are shown, because `show` searches each from the
/// start of the file.
void complain(const DataTable& table, const std::vector<std::size_t>& rows, std::string_view name,
              const std::string& message, const std::string& allowed, Problems& problems);

/// One of several tests in a file. Its columns have equal lengths.
struct TestColumns {
  std::string label;
  std::vector<DataColumn> columns;
};

/// One table with the rows of all tests. Errors: `core::InputError` if the tests do not have the same columns.
[[nodiscard]] DataTable join(const std::string& file, const std::vector<TestColumns>& tests);

}  // namespace dualdamp::identify
