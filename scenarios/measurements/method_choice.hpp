#pragma once
/// The key `methods`: the identification methods that read a record.

#include <vector>

#include "identify/methods.hpp"
#include "identify/record.hpp"
#include "scenarios/format/checked_file.hpp"

namespace dualdamp::scenarios {

/// `all`: the default in words, such as "all that can read the data".
[[nodiscard]] Field methods_key(const std::string& all);

/// Whether methods that take seconds run if the file does not name methods.
enum class SlowMethods { run, only_where_named };

/// All methods that can read each of these records, or those of the file, which must be able to read each.
void resolve_methods(CheckedFile& file, const std::vector<identify::Record>& records, SlowMethods slow);

/// The methods of a list of names.
[[nodiscard]] std::vector<const identify::MethodEntry*> methods_of(const Json& names);

}  // namespace dualdamp::scenarios
