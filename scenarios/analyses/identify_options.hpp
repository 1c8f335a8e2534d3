#pragma once
/// The keys of `identify` that are options of single methods, and their values.

#include <vector>

#include "identify/method.hpp"
#include "scenarios/format/checked_file.hpp"

namespace dualdamp::scenarios {

[[nodiscard]] std::vector<Field> method_option_fields();

/// `pairs`: of the record; 0 where it has none.
void check_method_options(CheckedFile& file, std::size_t pairs);

/// What a checked section `analysis` says.
[[nodiscard]] identify::MethodOptions method_options(const Json& section);

}  // namespace dualdamp::scenarios
