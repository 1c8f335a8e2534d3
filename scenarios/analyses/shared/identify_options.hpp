#pragma once
/// The keys of `identify` that are options of methods: the union of what the methods declare
/// (identify/options.hpp).

#include <string>
#include <vector>

#include "identify/methods.hpp"
#include "scenarios/format/checked_file.hpp"

namespace dualdamp::scenarios {

/// One field for each option.
[[nodiscard]] std::vector<Field> method_option_fields();

/// A given option that none of the chosen methods uses is a problem, unless it is a flag that is false. `pairs`:
/// number of pairs of the record; 0: none.
void check_method_options(CheckedFile& file, std::size_t pairs);

/// The options of a checked section `analysis`.
[[nodiscard]] identify::OptionValues method_options(const Json& section);

/// A warning for each option that some of the methods do not use.
[[nodiscard]] std::vector<std::string> unused_options(const identify::OptionValues& values,
                                                      const std::vector<const identify::MethodEntry*>& methods);

}  // namespace dualdamp::scenarios
