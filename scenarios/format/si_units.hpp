#pragma once
/// The SI units of the numbers of a scenario, as its keys declare them.

#include <map>
#include <string>

#include "scenarios/format/json.hpp"
#include "scenarios/format/keys.hpp"

namespace dualdamp::scenarios {

/// By path, such as `system.friction.kinetic`: the SI unit of each quantity in a scenario as the reader returns it.
/// "1" for a ratio. Frequencies are left out, because their values contain the unit. Parts that do not belong to
/// this format are ignored.
[[nodiscard]] std::map<std::string, std::string> si_units(const Json& scenario, const Section& format);

}  // namespace dualdamp::scenarios
