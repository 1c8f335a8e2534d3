#pragma once
/// Numbers that most tests measure by.

#include <limits>
#include <numbers>

namespace dualdamp::test {

using std::numbers::pi;
inline constexpr double epsilon = std::numeric_limits<double>::epsilon();

}  // namespace dualdamp::test
