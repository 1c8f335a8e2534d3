#pragma once
/// The monodromy matrix against central differences of the period map.

#include <string>

#include "bench/crosscheck/finding.hpp"
#include "sim/orbits/period_map.hpp"

namespace dualdamp::crosscheck {

/// At `state`, the start of a forcing period. `omega`: natural frequency [rad/s], which makes a velocity of a
/// length.
[[nodiscard]] Finding compare_derivative(const std::string& name, const sim::Model& model, const sim::State& state,
                                         double omega);

}  // namespace dualdamp::crosscheck
