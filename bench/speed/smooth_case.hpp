#pragma once
/// The work under smooth laws: oscillator and drive of the standard case with another law, in steady state.
///
///   m x'' + c x' + k x + F(x', z) = k Y cos(w t),   z' = the law's rate
///
/// Every contender starts on the periodic orbit, which is symmetric: each turning point lies at the same distance X
/// from zero. The error of a contender is the largest departure from X over X.

#include <span>
#include <string>
#include <vector>

#include "bench/speed/standard_case.hpp"
#include "friction_models/parameters.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::bench::speed {

struct LawResponse {
  double force = 0.0;   ///< N
  double z_rate = 0.0;  ///< of the internal state; 0 without one
};

struct SmoothCase {
  std::string law;
  friction::ParameterValues values;
  /// The equations of the law for a general solver; sgn v is `direction`.
  LawResponse (*respond)(double v, double z, double direction) = nullptr;
  bool has_state = true;
  double z_scale = 1.0;  ///< size of z
  bool jumps = false;    ///< the force jumps at a reversal: a general solver has to stop there
  bool stiff = false;    ///< fixed-point iteration takes a hundred times as long as Newton's method

  sim::Model model{};
  sim::State start{};      ///< on the orbit, at t = 0
  double amplitude = 0.0;  ///< X [m], at the tightest tolerance
};

/// lugre with sigma0 = 1e5 N/m first, then other laws.
[[nodiscard]] std::vector<SmoothCase> smooth_cases();

/// Values of the first of them.
[[nodiscard]] friction::ParameterValues lugre_values();

/// The standard oscillator and drive under this law, which starts at rest.
[[nodiscard]] sim::Model model_under(const std::string& law, friction::ParameterValues values);

/// Largest difference between the distance of a turning point and X, over X; infinite without turning points.
[[nodiscard]] double amplitude_error(std::span<const double> turning_points, double amplitude);

}  // namespace dualdamp::bench::speed
