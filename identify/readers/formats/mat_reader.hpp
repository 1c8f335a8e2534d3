#pragma once
/// Columns of a MATLAB file (v4, v5 to v7, v7.3), by matio.
///
/// Real numeric vectors named like the columns, or one struct that holds them; each element of a struct array is a
/// test of its own, labelled by its field `sweep` (text or number), else by its index. Instead of the times `t`
/// there may be a scalar `dt` [s] or `fs` [Hz]. Numbers are SI unless the caller states units.
///
/// Neither matio nor HDF5 below it stands a damaged file: they crash, hang or ask for all memory. They read in a
/// process of its own, with limits of time and memory (identify/readers/isolated.hpp).
///
/// Errors: a damaged or truncated file, no vectors of known names, a vector that is empty, complex, text, a matrix,
/// of another length than the others, or not finite.

#include <string>
#include <vector>

#include "identify/readers/data_table.hpp"
#include "identify/readers/record_reader.hpp"

namespace dualdamp::identify {

[[nodiscard]] DataTable read_mat(const std::string& path, const ReadOptions& options, Problems& problems,
                                 std::vector<std::string>& warnings);

}  // namespace dualdamp::identify
