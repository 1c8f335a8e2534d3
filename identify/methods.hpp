#pragma once
/// The list of identification methods: explicit, sorted by name, one line a method.

#include <string_view>
#include <vector>

#include "identify/method.hpp"

namespace dualdamp::identify {

[[nodiscard]] const std::vector<MethodEntry>& methods();

/// nullptr when there is no such method.
[[nodiscard]] const MethodEntry* find_method(std::string_view name);

/// The options of all methods, by name, each once.
[[nodiscard]] const std::vector<const Option*>& options();

}  // namespace dualdamp::identify
