#pragma once
/// Results of methods that estimate forces: (m, c, k, F0), and from them zeta = c/(2 sqrt(m k)) and x_f = F0/k.
/// Without a spring (k = 0, a machine on a rail) zeta and x_f do not exist and are NaN.

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "identify/estimate.hpp"

namespace dualdamp::identify {

struct ForceParameters {
  double m = 0.0;   ///< kg
  double c = 0.0;   ///< N.s/m
  double k = 0.0;   ///< N/m
  double F0 = 0.0;  ///< N

  [[nodiscard]] double natural_frequency() const { return std::sqrt(k / m); }  ///< rad/s
};

[[nodiscard]] ParameterSet parameters(const ForceParameters& force);

/// Sets value, standard errors, intervals value - bias +- half_width std, covariance and correlation of (zeta, F0)
/// from the covariance of (m, c, k, F0), in which rows of known constants are zero.
void set_estimate(Estimate& estimate, const ForceParameters& force, const Eigen::Matrix4d& covariance,
                  double half_width, const ForceParameters& bias = {});

/// A further parameter with its interval.
[[nodiscard]] FurtherParameter further(std::string name, std::string unit, double value, double variance,
                                       double half_width);

/// Diagnostics of c and F0 by their signs, as `judge_signs` does for zeta and x_f. `scale_c`, `scale_F0`: the
/// scales of the two.
void judge_force_signs(Estimate& estimate, double scale_c, double scale_F0, std::vector<std::string>& faults);

}  // namespace dualdamp::identify
