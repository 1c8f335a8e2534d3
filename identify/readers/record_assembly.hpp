#pragma once
/// From the columns of a data file to the record in it: pairs, extremes or histories.

#include <string>
#include <vector>

#include "identify/readers/data_table.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// Pairs where there is a column Y; a decay where there is nothing but extremes, which alternate; histories
/// otherwise, one for each label, or for each part whose times begin anew. Every fault goes to `problems`; what is
/// left out goes to `warnings`.
[[nodiscard]] Record record_of(DataTable table, Problems& problems, std::vector<std::string>& warnings);

}  // namespace dualdamp::identify
