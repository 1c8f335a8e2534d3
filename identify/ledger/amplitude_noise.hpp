#pragma once
/// The noise of steady states without a model of friction.
///
/// The drive over the motion, Y e^(i phi)/x, is a smooth function of amplitude and frequency, whatever friction and
/// spring are: of a linear oscillator it is 1 - r^2 + 2 i zeta r, dry friction adds a part over x, a spring and
/// drag add powers of x. What curves of this kind leave, along the drive and across it, is the noise of the
/// amplitudes and of the phases. With few states it is known to a factor only.
///
/// Lengths in units of the largest output.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "identify/ledger/amplitude_terms.hpp"

namespace dualdamp::identify {

/// From this number on, measured amplitudes serve as abscissae of a smooth curve.
inline constexpr Eigen::Index many_states = 16;

/// Columns of a smooth curve over amplitude, and over frequency if there are several; fewer where few states would
/// have no noise left.
[[nodiscard]] Eigen::Index smooth_columns(bool several_frequencies, std::size_t states);

/// Standard deviations of the three channels.
struct Deviations {
  double x = 1.0;
  double Y = 0.0;
  double phase = 1.0;
};

/// The largest deviations that a fit may take for noise, several times that of the curves; infinite where the
/// states with phases are too few for them. All noise of the amplitudes may be in x or in Y.
[[nodiscard]] Deviations largest_deviations(const std::vector<SteadyPoint>& points);

/// The mean of Y over the mean of x.
[[nodiscard]] double mean_ratio(const std::vector<SteadyPoint>& points);

/// Deviations of the same proportions of x to Y that are not larger.
void limit(Deviations& deviations, const Deviations& largest);

}  // namespace dualdamp::identify
