#pragma once
/// A sampled velocity between two samples, as a parabola.

#include <cstddef>
#include <vector>

namespace dualdamp::identify {

/// v + slope s + curve s^2 at the time s after the first of the two samples.
struct VelocityParabola {
  double v = 0.0, slope = 0.0, curve = 0.0;
  /// The way since the first sample.
  [[nodiscard]] double path(double s) const { return s * (v + s * (slope / 2.0 + s * curve / 3.0)); }
};

/// The velocity between samples i - 1 and i of `v`; `rate`: of the samples.
[[nodiscard]] VelocityParabola velocity_before(const std::vector<double>& v, double rate, std::size_t i);

}  // namespace dualdamp::identify
