#pragma once
/// The key `methods`: which identification methods are to read a record.

#include <vector>

#include "identify/methods.hpp"
#include "identify/record.hpp"
#include "scenarios/format/checked_file.hpp"

namespace dualdamp::scenarios {

/// `all`: what the default stands for, "all that fit the data".
[[nodiscard]] Field methods_key(const std::string& all);

/// Whether methods that take seconds run where the file does not name methods.
enum class SlowMethods { run, only_where_named };

/// All methods that each of such records allows, or those of the file, which each must allow.
void resolve_methods(CheckedFile& file, const std::vector<identify::Record>& records, SlowMethods slow);

/// The methods of a list of names.
[[nodiscard]] std::vector<const identify::MethodEntry*> methods_of(const Json& names);

}  // namespace dualdamp::scenarios
