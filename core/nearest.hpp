#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dualdamp::core {

/// The name among `names` that `word` probably means, because a few letters differ or one begins with the other;
/// empty when none is similar.
[[nodiscard]] std::string nearest(std::string_view word, const std::vector<std::string>& names);

}  // namespace dualdamp::core
