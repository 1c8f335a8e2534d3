#pragma once
/// Makes a record (pairs, extremes or histories) from the columns of a data file.

#include <string>
#include <vector>

#include "identify/readers/data_table.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// Pairs, if there is a column Y; a decay, if all rows are extremes, which alternate; else histories, one for each
/// label, or for each part whose times begin anew. Faults are added to `problems`. `warnings` says what is left
/// out. `options`: `is_imposed` and `words`.
[[nodiscard]] Record record_of(DataTable table, const ReadOptions& options, Problems& problems,
                               std::vector<std::string>& warnings);

}  // namespace dualdamp::identify
