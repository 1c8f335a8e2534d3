#pragma once
/// Measured data: the keys that name a file, and the record in it.

#include <vector>

#include "scenarios/format/checked_file.hpp"

namespace dualdamp::scenarios {

/// `data`, and what the file does not say of itself: `units`, `columns`, `scale`, `decimal`, `no_header`.
[[nodiscard]] std::vector<Field> data_fields();

/// Reads the record of `analysis.data`, if it is there, into `file.data`.
void read_data(CheckedFile& file);

}  // namespace dualdamp::scenarios
