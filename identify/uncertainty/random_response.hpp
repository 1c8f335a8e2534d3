#pragma once
/// Records of a mass with known friction under a random drive like that of a measured record, for the intervals of
/// methods that read a random response (parametric_bootstrap.hpp).
///
///   m x'' + c x' + F0 sgn x' + k (x - y) = f
///
/// If y or force was recorded, the drive is made of stretches of it, each half a natural period long, from random
/// places and with random signs. Neighbouring stretches fade into one another so that power and spectrum are kept.
/// Otherwise the mass is driven by a white acceleration of intensity D [m^2/s^3], in steps of a fiftieth of a
/// radian, and the record has no drive.
///
/// A record is at most 2,000 natural periods long: `share` tells how much shorter it is than the measured one. The
/// scatter of an estimate falls with the root of the length. Noise of x and v: from their fourth differences. Cost:
/// 0.4 us a sample, 50 ns a step under white acceleration.

#include "identify/models/force_parameters.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

struct RandomResponse {
  const History& measured;  ///< four samples or more in a natural period
  ForceParameters law;      ///< k > 0, c >= 0, F0 >= 0
  double intensity = 0.0;

  /// Length of a synthetic record over that of the measured record.
  [[nodiscard]] double share() const;
  [[nodiscard]] Record record(int number) const;
};

}  // namespace dualdamp::identify
