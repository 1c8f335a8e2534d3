#pragma once
/// Tables as one MATLAB file (level 5, which Octave and scipy.io.loadmat read too).
///
/// Each table is a struct of its columns: numbers are a column vector, NaN where there is none; texts are a cell
/// array. `units` holds the units in structs of the same fields, `provenance` the provenance as JSON. Names are
/// made valid in MATLAB: `fit.x` becomes `fit_x`.

#include <iosfwd>
#include <string>
#include <vector>

#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

/// The bytes with which such a file begins.
inline constexpr const char* mat_heading = "MATLAB 5.0 MAT-file, written by dualdamp";

/// Writes the file. Errors: `OutputError` if a column does not fit: it may have 2 GB.
void write_mat(std::ostream& out, const std::vector<Table>& tables, const std::string& provenance);

}  // namespace dualdamp::scenarios
