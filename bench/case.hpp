#pragma once
/// One motion of a stress test, measured: its records, and the estimates of the methods.

#include <cstddef>
#include <functional>
#include <string>

#include "bench/consequence.hpp"
#include "bench/departure_names.hpp"
#include "bench/grid.hpp"
#include "identify/record.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::bench {

/// A case as a laboratory has it, with what only the stress test knows of it.
struct MeasuredCase {
  std::size_t number = 0;
  const identify::Record& record;
  std::size_t responses = 0;  ///< number of responses to a random drive, at the end of its histories: 0 or 1
  const identify::KnownConstants& constants;
  const SensorSet& sensors;
  const Consequence& consequence;
  const UnmeasuredAmplitudes& unmeasured;
  const std::string& reason;  ///< why a part of it could not be measured; empty if all of it was
};

/// Computes motion `number` once and measures those of its cases that are `wanted`.
void measure_motion(const Grid& grid, const sim::SteadyStateOptions& options, std::size_t number,
                    const std::function<bool(std::size_t)>& wanted,
                    const std::function<void(const MeasuredCase&)>& take);

/// A finished case: its line without line end.
using TakeLine = std::function<void(const std::string& line)>;

/// Measures the motion, runs all methods and passes the finished cases on as lines of `cases.jsonl`. A case that
/// cannot be measured is a line with a reason.
void run_motion(const Grid& grid, const sim::SteadyStateOptions& options, std::size_t number,
                const std::function<bool(std::size_t)>& wanted, const TakeLine& take);

}  // namespace dualdamp::bench
