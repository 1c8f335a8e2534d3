#pragma once

#include <limits>

namespace dualdamp::core {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace dualdamp::core
