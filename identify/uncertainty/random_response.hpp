#pragma once
/// Records of a mass with known friction under a random drive like that of a measured record, for the intervals of
/// methods that read a random response (parametric_bootstrap.hpp).
///
///   m x'' + c x' + F0 sgn x' + k (x - y) = f
///
/// Where y or force was recorded the drive is made of it: stretches of five natural periods from random places and
/// with random signs, that fade into one another so that power and spectrum stay. Else the mass is kicked by a
/// white acceleration of intensity D [m^2/s^3], in steps of a fiftieth of a radian, and the record has no drive.
///
/// At most 2,000 natural periods long, for what such a method estimates scatters as one over the root of the
/// length. Noise of x and v: what their fourth differences show. Cost: 0.4 us a sample, 50 ns a step under white
/// acceleration.

#include <cstdint>

#include "identify/models/force_parameters.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

struct RandomResponse {
  const History& measured;
  ForceParameters law;  ///< k > 0, c >= 0, F0 >= 0
  double intensity = 0.0;

  /// Samples of a synthetic record over those of the measured record.
  [[nodiscard]] double share() const;
  [[nodiscard]] Record record(int number) const;
};

}  // namespace dualdamp::identify
