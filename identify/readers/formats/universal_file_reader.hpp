#pragma once
/// Columns of a universal file: data sets 58 (and 58b, IEEE floating point) with time responses.
///
/// Function types 1 (time response) and 0 (general) over time are read; others are left out with a warning. The
/// first of these that applies decides which signal a data set holds:
/// * the caller names, for a column, the data set's response entity name, ordinate axis label, first line of its
///   ID, or number among the data sets read, from 1;
/// * a response entity name, ordinate axis label or first ID line is the name of a column;
/// * the type of the ordinate: 8 displacement (x), 11 velocity (v), 12 acceleration (a), 9 and 13 force.
/// Two data sets for one signal with the same samples are two tests only if all signals of the file appear again.
/// Units: the caller's, else the ordinate's units label, else the factors of data set 164, else SI.
///
/// Source: uff58.
/// Errors: no time response, complex numbers, a data set that ends early, a number that cannot be read, a data set
/// whose signal is not decided, samples that differ within a test.

#include <string>
#include <string_view>
#include <vector>

#include "identify/readers/data_table.hpp"
#include "identify/readers/record_reader.hpp"

namespace dualdamp::identify {

/// Whether the text begins with the mark and the number of a data set.
[[nodiscard]] bool is_universal_file(std::string_view text);

[[nodiscard]] DataTable parse_universal_file(std::string_view text, const ReadOptions& options, Problems& problems,
                                             std::vector<std::string>& warnings);

}  // namespace dualdamp::identify
