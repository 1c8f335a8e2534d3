#pragma once
/// Mechanisms: what a rig may have beside Coulomb and viscous friction, with parameters that an experiment could
/// find. Each of them is a real law or drive of this program, so that what it does to a test is computed and not
/// described.
///
/// A rig has a Coulomb force F0 and a damping c. Where a mechanism changes the viscous force itself, c is what the
/// damper would be that gives the same force at the reference speed V; then c means the same in all mechanisms:
/// what a test in the middle of the range would find.
///
/// `departures.hpp` measures the size of a departure by one number, to compare methods; here parameters have their
/// own units, to compare with a laboratory.

#include <span>
#include <string_view>
#include <vector>

#include "friction_models/parameters.hpp"
#include "sim/departures.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

/// What is known of a rig, and the motion in the middle of its tests.
struct Rig {
  Oscillator oscillator;      ///< its damping is not used
  ReferenceMotion reference;  ///< its frequency is the one that the laboratory sets
  /// In which contact or film warms [s]. A minute is long against a free decay, which stays cold; steady states
  /// depend on it by the ratio of a period to it, and are found the sooner the shorter it is.
  double warming_time = 60.0;
};

/// Friction of a rig beside its mechanism.
struct RigFriction {
  double F0 = 0.0;  ///< N, > 0
  double c = 0.0;   ///< N.s/m
};

/// The size that a quantity of this unit has in the reference motion: X for m, wX for m/s, k for N/m, k/X^2 for
/// N/m^3, kY/(wX)^2 for N.s^2/m^2, the drive's power kY wX/2 for W, 1/w for s, 1 for 1. Errors: `std::logic_error`
/// for another unit.
[[nodiscard]] double natural_scale(const Rig& rig, std::string_view unit);

struct MechanismParameter {
  std::string_view name;
  std::string_view unit;  ///< SI
  std::string_view meaning;
  friction::Range range;  ///< what has a meaning at all
  /// Where a search begins and what it keeps to, over `natural_scale`. A search with low > 0 goes by ratios.
  double start = 1.0;
  double low = 0.0;
  double high = 0.0;
};

/// Values that a real rig may well have.
struct PlausibleValues {
  std::string_view name;       ///< which of several; may be empty
  std::vector<double> values;  ///< SI, in the order of the parameters
  std::string_view because;    ///< where they come from
};

struct Mechanism {
  std::string_view name;
  std::string_view meaning;  ///< what happens in the rig, one line
  std::vector<MechanismParameter> parameters;
  std::vector<PlausibleValues> plausible;
  /// It lies in drive or spring: a free decay on another spring does not have it.
  bool forced_only = false;
  /// The test at input amplitude Y [m] as the laboratory reads it. `parameters` in SI, each in its range.
  Model (*build)(const Rig& rig, const RigFriction& friction, std::span<const double> parameters, double Y);
};

/// Sorted by name.
[[nodiscard]] const std::vector<Mechanism>& mechanisms();

/// nullptr when there is no such mechanism.
[[nodiscard]] const Mechanism* find_mechanism(std::string_view name);

/// A release from rest at x = displacement [m], on a spring of this stiffness [N/m], without drive.
[[nodiscard]] Model released(const Mechanism& mechanism, const Rig& rig, const RigFriction& friction,
                             std::span<const double> parameters, double stiffness, double displacement);

}  // namespace dualdamp::sim
