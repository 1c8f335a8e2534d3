#pragma once
/// The energy account of a history, window by window, for a regression on the energy balance.
///
///   input work = change of stored energy + c int v^2 dt + F0 int |dx|
///
/// It holds for any waveform, with or without sticks. Integrals use Hermite's rule on v and a. If v changes its
/// sign between two samples, the path includes the part to the turning point and back. Errors: O(dt^2) at turning
/// points, O(dt^4) elsewhere.

#include <vector>

#include "identify/record.hpp"
#include "identify/records/signals.hpp"

namespace dualdamp::identify {

struct WindowEnergy {
  double duration = 0.0;      ///< s
  double input = 0.0;         ///< int (k y + f) dx [J]
  double stored = 0.0;        ///< change of m v^2/2 + k x^2/2 [J]
  double path = 0.0;          ///< int |dx| [m]
  double range = 0.0;         ///< max x - min x [m]
  double square_speed = 0.0;  ///< int v^2 dt [m^2/s]
};

/// The energies of `windows` windows of equal length that cover the motion. Mass and stiffness must be known.
[[nodiscard]] std::vector<WindowEnergy> energy_of(const PreparedHistory& motion, const KnownConstants& constants,
                                                  int windows);

/// `prepared_history` with the derivatives of x, where v or a were not measured, by `sharp_difference`: with 25
/// samples in a period, those of two samples leave an error of 1 % in the work.
[[nodiscard]] PreparedHistory sharply_prepared(const History& history, double cutoff);

/// Standard deviation of the noise in v of a motion prepared so [m/s]: that of the noise of v or, where v was not
/// measured, of x. While the mass stands still, this noise alone adds sqrt(2/pi) of it to the path in a unit of
/// time.
[[nodiscard]] double speed_noise(const History& history, double cutoff);

}  // namespace dualdamp::identify
