#pragma once
/// The tables of a result as one MATLAB file (level 5, which Octave and scipy.io.loadmat read too).
///
/// Each table is a struct of its columns: numbers are a column vector, NaN where there is none; texts are a cell
/// array. `units` holds the SI units in structs of the same fields, `provenance` the provenance as JSON. Names are
/// made valid in MATLAB: `fit.x` becomes `fit_x`.

#include "cli/report/stored_run.hpp"
#include "scenarios/results/files.hpp"

namespace dualdamp::cli {

/// The writer of the file. Errors when it writes: `core::InputError` if a table was changed after the run;
/// `scenarios::OutputError` if the result does not fit into such a file, of which a column holds less than 2 GB.
[[nodiscard]] scenarios::Writer mat_writer(const StoredRun& run);

/// The bytes with which such a file begins.
inline constexpr const char* mat_heading = "MATLAB 5.0 MAT-file, written by dualdamp";

}  // namespace dualdamp::cli
