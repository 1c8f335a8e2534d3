#pragma once
/// Ways to integrate a work under a smooth law.

#include <functional>
#include <string>
#include <vector>

#include "bench/speed/smooth_case.hpp"

namespace dualdamp::bench::speed {

struct SmoothContender {
  std::string setting;
  /// From the start of the orbit over some forcing periods; appends the turning points [m].
  std::function<void(int periods, std::vector<double>& turning_points)> integrate;
};

/// The smooth engine with its defaults at this tolerance. It has chosen between explicit and implicit steps before
/// the measurement.
[[nodiscard]] SmoothContender smooth_engine(const SmoothCase& work, double tolerance);

/// CVODE at this tolerance (relative; absolute: of the size of each state) in every setting that can do the work:
/// Adams with fixed-point iteration, for laws that are not stiff, Adams and BDF with dense Newton; starting anew
/// after each reversal, up to which sgn v is frozen, or, for laws without a jump there, going on through it.
/// Jacobians are CVODE's differences. Empty where SUNDIALS is not installed. Integration throws where CVODE fails.
[[nodiscard]] std::vector<SmoothContender> cvode_smooth(const SmoothCase& work, double tolerance);

}  // namespace dualdamp::bench::speed
