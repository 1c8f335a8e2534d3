#include "identify/readers/data_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dualdamp::identify {

const DataColumn* DataTable::find(std::string_view name) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [name](const DataColumn& c) { return c.known->name == name; });
  return found == columns.end() ? nullptr : &*found;
}

namespace {

/// Times computed from a step, and numbers converted to SI, may leave the range of double precision although the
/// numbers of the file do not.
void refuse_not_finite(const std::string& file, const DataColumn& column) {
  const auto bad = std::ranges::find_if_not(column.values, [&](double value) {
    return std::isfinite(value) || (column.known->may_lack && std::isnan(value));
  });
  if (bad == column.values.end()) return;
  core::refuse({.file = file},
               "element " + std::to_string(bad - column.values.begin() + 1) + " of " +
                   std::string(column.known->name) + " leaves the range of double precision in SI",
               "finite numbers, and a step or rate of samples that makes finite times");
}

/// A column without any number is a fault of the program that wrote it, not a record without phases.
void refuse_without_numbers(const DataTable& table) {
  for (const DataColumn& column : table.columns)
    if (column.known->may_lack &&
        std::ranges::all_of(column.values, [](double value) { return std::isnan(value); }))
      core::refuse({.file = table.file},
                   "element 1 of " + std::string(column.known->name) + " is not a finite number",
                   "a finite number in one row or more; NaN where it was not measured");
}

}  // namespace

void add_times(DataTable& table, double sample_rate) {
  std::vector<std::size_t> starts = table.restarts;
  for (const LabelRun& run : table.sweeps) starts.push_back(run.first_row);
  std::ranges::sort(starts);
  DataColumn times{known_column("t"), std::vector<double>(table.rows())};
  auto next = starts.begin();
  std::size_t start = 0;
  for (std::size_t row = 0; row < times.values.size(); ++row) {
    for (; next != starts.end() && *next == row; ++next) start = row;
    times.values[row] = static_cast<double>(row - start) / sample_rate;
  }
  table.columns.push_back(std::move(times));
}

void complain(const DataTable& table, const std::vector<std::size_t>& rows, std::string_view name,
              const std::string& message, const std::string& allowed, Problems& problems) {
  if (rows.empty()) return;
  const KnownColumn& column = *known_column(name);
  core::Diagnostic problem = table.show(rows.front(), column);
  problem.message = message;
  problem.allowed = allowed;
  std::vector<int> lines;
  for (std::size_t i = 1; i < std::min(rows.size(), 1 + Problems::most_lines); ++i)
    lines.push_back(table.show(rows[i], column).place.line);
  problems.add(std::move(problem), rows.size() - 1, std::move(lines));
}

void check_increasing(const DataTable& table, std::size_t first, std::size_t count, Problems& problems) {
  const std::vector<double>& t = table.find("t")->values;
  std::vector<std::size_t> equal;
  std::vector<std::size_t> back;
  for (std::size_t row = first + 1; row < first + count; ++row) {
    if (t[row] == t[row - 1]) equal.push_back(row);
    if (t[row] < t[row - 1]) back.push_back(row);
  }
  const std::string allowed = "a time after the row above";
  complain(table, equal, "t", std::string(no_increase_twice), allowed, problems);
  complain(table, back, "t", std::string(no_increase), allowed, problems);
}

DataTable join(const std::string& file, const std::vector<TestColumns>& tests) {
  DataTable table;
  table.file = file;
  for (const TestColumns& test : tests) {
    const std::size_t row = table.rows();
    if (tests.size() > 1 || !test.label.empty()) table.sweeps.push_back({test.label, row});
    if (table.columns.empty())
      for (const DataColumn& column : test.columns) table.columns.push_back({column.known, {}});
    bool alike = test.columns.size() == table.columns.size();
    for (const DataColumn& column : test.columns) {
      refuse_not_finite(file, column);
      const DataColumn* whole = table.find(column.known->name);
      alike = alike && whole != nullptr;
      if (!alike)
        core::refuse({.file = file},
                     "the tests of the file do not hold the same signals: test '" + test.label + "'");
      auto& values = table.columns[static_cast<std::size_t>(whole - table.columns.data())].values;
      values.insert(values.end(), column.values.begin(), column.values.end());
    }
    if (!alike)
      core::refuse({.file = file}, "the tests of the file do not hold the same signals: test '" + test.label + "'");
  }
  refuse_without_numbers(table);
  table.show = [file](std::size_t row, const KnownColumn& known) {
    core::Diagnostic result;
    result.place.file = file;
    result.found = "element " + std::to_string(row + 1) + " of " + std::string(known.name);
    return result;
  };
  return table;
}

}  // namespace dualdamp::identify
