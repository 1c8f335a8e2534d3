#pragma once
/// Columns of a MATLAB file (v4, v5 to v7, v7.3), by matio.
///
/// The file holds real numeric vectors with the names of the columns, or one struct with such fields. Each element
/// of a struct array is a test, labelled by its field `sweep` (text or number), else by its index. In place of the
/// times `t` there may be a scalar `dt` [s] or `fs` [Hz]. Numbers are in SI unless the name or the caller states a
/// unit.
///
/// matio and HDF5 can crash, hang or use all memory on a damaged file. They therefore run in a separate process
/// with limits of time and memory (identify/readers/isolated.hpp).
///
/// Errors: a damaged or truncated file; no vectors with known names; a vector that is empty, complex, text, a
/// matrix, not finite, or of another length than the others.

#include <string>
#include <vector>

#include "identify/readers/data_table.hpp"
#include "identify/readers/record_reader.hpp"

namespace dualdamp::identify {

[[nodiscard]] DataTable read_mat(const std::string& path, const ReadOptions& options, Problems& problems,
                                 std::vector<std::string>& warnings);

}  // namespace dualdamp::identify
