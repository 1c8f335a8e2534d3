#pragma once
/// The header of a CSV file: the column and the unit of each field of a row.

#include <string>
#include <vector>

#include "identify/readers/column_factors.hpp"
#include "identify/readers/columns.hpp"
#include "identify/readers/formats/csv_layout.hpp"
#include "identify/readers/problems.hpp"
#include "identify/readers/record_reader.hpp"

namespace dualdamp::identify {

/// The use of one field of every row.
struct CsvField {
  const KnownColumn* known = nullptr;  ///< nullptr: ignored
  double factor = 1.0;
  bool may_be_missing = false;  ///< at the end of a row: a remark, or one separator too many
};

struct CsvHeader {
  std::vector<CsvField> fields;
  ColumnUnits units;
  std::vector<std::string> ignored;  ///< warnings about unknown columns
};

/// Faults are added to `problems`.
[[nodiscard]] CsvHeader read_csv_header(const Layout& layout, const ReadOptions& options, Problems& problems,
                                        std::vector<std::string>& warnings);

}  // namespace dualdamp::identify
