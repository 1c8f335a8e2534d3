#pragma once
/// `mechanisms`: which mechanism explains that the estimates of zeta and F0 change as the upper x-Y data are left
/// out.
///
/// The run: mechanisms/study.hpp.

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/departure_names.hpp"
#include "scenarios/analysis.hpp"

namespace dualdamp::bench {

/// The estimate from the straight line through the lower part of the data.
struct PartEstimate {
  double share = 1.0;  ///< of the levels, the lowest ones
  double zeta = 0.0;
  double F0 = 0.0;  ///< N
  double zeta_std = 0.0;
  double F0_std = 0.0;  ///< N
};

/// Plausible values of a mechanism.
struct PlausibleRig {
  const Departure* mechanism = nullptr;
  std::string name;            ///< which of several; may be empty
  std::vector<double> values;  ///< SI, in the order of the mechanism's parameters
  std::string because;
};

/// A free decay of the same mass and friction on another spring, read twice: from the first four of its five
/// extremes and from the last four.
struct MeasuredDecay {
  struct Segment {
    double zeta = 0.0;
    double x_f = 0.0;  ///< m
  };
  double stiffness = 0.0;     ///< N/m
  double displacement = 0.0;  ///< initial displacement of a release from rest [m]
  Segment high, low;
};

struct MechanismStudy {
  RigFriction friction;                 ///< that the laboratory believes the rig to have
  std::vector<PartEstimate> estimates;  ///< largest share first
  std::size_t levels = 0;
  std::vector<double> amplitudes;  ///< input levels [m]; empty: equally spaced at unknown places
  std::vector<const Departure*> mechanisms;
  std::vector<PlausibleRig> plausible;
  std::optional<MeasuredDecay> decay;
};

/// The number of levels in a share of them.
[[nodiscard]] inline std::size_t part_of(std::size_t levels, double share) {
  return static_cast<std::size_t>(std::lround(static_cast<double>(levels) * share));
}

[[nodiscard]] const scenarios::Analysis& mechanisms_analysis();

}  // namespace dualdamp::bench
