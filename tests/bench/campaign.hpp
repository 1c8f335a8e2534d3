#pragma once
/// A stress test from the text of its scenario, and what its motions are measured to be.

#include <string>
#include <vector>

#include "bench/analyses.hpp"
#include "bench/case.hpp"
#include "bench/grid.hpp"
#include "scenarios/scenario.hpp"

namespace dualdamp::bench::testing {

struct Campaign {
  explicit Campaign(const std::string& scenario)
      : asked(scenarios::parse_scenario(scenario, "test", {.analyses = analyses()})),
        grid(*stress_test_of(*asked.question)) {}

  /// Records of the cases of a motion.
  [[nodiscard]] std::vector<identify::Record> records(std::size_t motion) const {
    std::vector<identify::Record> list;
    measure_motion(
        grid, {}, motion, [](std::size_t) { return true; },
        [&](const MeasuredCase& measured) { list.push_back(measured.record); });
    return list;
  }
  [[nodiscard]] Consequence consequence(std::size_t motion) const {
    Consequence result;
    measure_motion(
        grid, {}, motion, [](std::size_t) { return true; },
        [&](const MeasuredCase& measured) { result = measured.consequence; });
    return result;
  }

  scenarios::Scenario asked;
  Grid grid;
};

}  // namespace dualdamp::bench::testing
