#pragma once
/// The energy account of a history, window by window: what a balance of energy regresses.
///
///   input work = change of stored energy + c int v^2 dt + F0 int |dx|
///
/// whatever the waveform, with rests or without. Integrals by Hermite's rule on v and a; a turn between two samples
/// adds the way to its top and back. Errors: O(dt^2) at turns, O(dt^4) elsewhere.

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

/// `windows` of equal length that cover the motion. Mass and stiffness must be known.
[[nodiscard]] std::vector<WindowEnergy> energy_of(const Motion& motion, const KnownConstants& constants,
                                                  int windows);

}  // namespace dualdamp::identify
