#pragma once
/// The version of the format, and limits of what a file may ask for.

#include <string_view>

namespace dualdamp::scenarios {

inline constexpr std::string_view schema_name = "dualdamp/1";  ///< the key `schema` of each scenario

inline constexpr double max_points = 1e6;   ///< values of a list, points of a curve
inline constexpr double max_swept = 1e4;    ///< points of a sweep, whose lists have max_points rows in all
inline constexpr double max_samples = 1e6;  ///< rows of a history
inline constexpr double max_periods = 1e6;  ///< forcing or natural periods of a history
inline constexpr double max_nodes = 1e7;    ///< pieces of a drive: random values of a noise, samples
inline constexpr double max_table = 1e4;    ///< values of a drive that the scenario itself lists

}  // namespace dualdamp::scenarios
