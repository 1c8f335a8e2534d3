#include "identify/readers/data_table.hpp"

#include <algorithm>
#include <cmath>

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
  refuse_file(file,
              "element " + std::to_string(bad - column.values.begin() + 1) + " of " +
                  std::string(column.known->name) + " leaves the range of double precision in SI",
              "finite numbers, and a step or rate of samples that makes finite times");
}

/// A column without any number is a fault of the program that wrote it, not a record without phases.
void refuse_without_numbers(const DataTable& table) {
  for (const DataColumn& column : table.columns)
    if (column.known->may_lack &&
        std::ranges::all_of(column.values, [](double value) { return std::isnan(value); }))
      refuse_file(table.file, "element 1 of " + std::string(column.known->name) + " is not a finite number",
                  "a finite number in one row or more; NaN where it was not measured");
}

}  // namespace

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
        refuse_file(file, "the tests of the file do not hold the same signals: test '" + test.label + "'");
      auto& values = table.columns[static_cast<std::size_t>(whole - table.columns.data())].values;
      values.insert(values.end(), column.values.begin(), column.values.end());
    }
    if (!alike) refuse_file(file, "the tests of the file do not hold the same signals: test '" + test.label + "'");
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
