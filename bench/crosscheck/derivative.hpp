#pragma once
/// Compares the monodromy matrix with central differences of the period map.

#include <string>

#include "bench/crosscheck/finding.hpp"
#include "sim/orbits/period_map.hpp"

namespace dualdamp::crosscheck {

/// At `state`, the start of a forcing period. `omega`: natural frequency [rad/s], the ratio of the sizes of
/// velocities and lengths.
[[nodiscard]] Finding compare_derivative(const std::string& name, const sim::Model& model, const sim::State& state,
                                         double omega);

}  // namespace dualdamp::crosscheck
