#pragma once
/// The chart of a motion, for analyses whose result is one.

#include "scenarios/analysis.hpp"

namespace dualdamp::scenarios {

/// Displacement of the mass, and of the base, over time. `table`: a `history_table`; `key`: what a scenario states
/// to get it.
[[nodiscard]] constexpr MainChart motion_chart(std::string_view table, std::string_view key = {}) {
  return {.table = table,
          .list = "",
          .x = "t",
          .y = "x",
          .x_label = "time t",
          .y_label = "displacement",
          .further = "y",
          .key = key};
}

}  // namespace dualdamp::scenarios
