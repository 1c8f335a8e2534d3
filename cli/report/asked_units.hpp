#pragma once
/// Tells of units that `--show-in` asks of stored results and that no quantity in them has.

#include <string>
#include <vector>

namespace dualdamp::cli {

/// A line with the warning; empty if each unit is that of a quantity of one of the results, or none is asked for.
/// `units`: as the user wrote them. Errors: `core::InputError` as of `StoredRun`.
[[nodiscard]] std::string warning_of_asked_units(const std::vector<std::string>& directories,
                                                 const std::string& units);

}  // namespace dualdamp::cli
