#pragma once
/// The header of a CSV file: which field of every row is which column, and in which unit.

#include <string>
#include <vector>

#include "identify/readers/column_factors.hpp"
#include "identify/readers/columns.hpp"
#include "identify/readers/formats/csv_layout.hpp"
#include "identify/readers/problems.hpp"
#include "identify/readers/record_reader.hpp"

namespace dualdamp::identify {

/// What a field of every row is for.
struct CsvField {
  const KnownColumn* known = nullptr;  ///< nullptr: ignored
  double factor = 1.0;
  bool may_be_missing = false;  ///< at the end of a row: a remark, or a separator too many
};

struct CsvHeader {
  std::vector<CsvField> fields;
  ColumnUnits units;
};

/// Faults go to `problems`.
[[nodiscard]] CsvHeader read_csv_header(const Layout& layout, const ReadOptions& options, Problems& problems,
                                        std::vector<std::string>& warnings);

}  // namespace dualdamp::identify
