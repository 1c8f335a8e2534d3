#pragma once
/// Departures of a rig from an oscillator with Coulomb + viscous friction. Each is a real law, drive or spring of
/// this program, so that its effect on a test is computed from the motion.
///
/// One table serves two purposes.
///
/// * In the stress test one pure number, the severity s > 0, sets all parameters of a departure, so that the harm
///   of different laws to an identification can be compared. The departure tends to Coulomb + viscous friction as
///   s -> 0. Severities are ratios to the reference motion: amplitude X and peak
///   speed V of Coulomb + viscous friction in the middle of the range of excitation.
/// * In the study of mechanisms a departure is a *mechanism*, with parameters in SI units, so that it can be
///   compared with a laboratory. F0 and c are then what a test in the middle of the range would find: if a
///   mechanism changes the viscous force itself, c is the damper that gives the same force at the speed V.
///
/// A departure is one entry of a group: `contacts.cpp`, `sliding.cpp`, `films.cpp`, `drives.cpp` or
/// `laboratory.cpp`.

#include <span>
#include <string_view>
#include <vector>

#include "friction_models/parameters.hpp"
#include "identify/record.hpp"
#include "identify/records/sensors.hpp"
#include "sim/model.hpp"

namespace dualdamp::identify::departures {

/// The motion that parameters are relative to.
struct ReferenceMotion {
  double amplitude = 0.0;  ///< X [m]
  double frequency = 0.0;  ///< w [rad/s]
  double Y = 0.0;          ///< input amplitude [m]

  /// V [m/s]
  [[nodiscard]] double speed() const { return amplitude * frequency; }
};

/// The rig that a departure is added to.
struct RigBase {
  sim::Model model{};  ///< oscillator with its damper c, and its drive; without friction laws
  double F0 = 0.0;     ///< Coulomb friction [N]
  ReferenceMotion reference{};
  double warming_time = 0.0;       ///< time constant with which contact or film warms [s]
  double boundary_velocity = 0.0;  ///< over which friction falls from its value at rest as a film forms [m/s]
  /// Whether F0 and c are those that the reference motion has; else they are those of a cold rig at low speed.
  bool found_at_reference = false;

  [[nodiscard]] double c() const { return model.oscillator.damping; }
};

/// Kind of a departure. Scores are averaged within families first, so that a family counts once, however many
/// departures it has.
enum class Family {
  none,        ///< Coulomb + viscous friction, all as stated
  presliding,  ///< contacts that yield before they slip
  velocity,    ///< friction that depends on speed in another way
  position,    ///< friction that depends on the position
  memory,      ///< friction that depends on earlier motion: warmth, a lag
  spring,      ///< spring and structure that are not one linear spring
  sensors,     ///< wrong readings
  constants,   ///< mass or stiffness that are not as stated
  drive,       ///< a drive that is not as stated
  pairs,       ///< two of these together
};

/// "presliding"
[[nodiscard]] std::string_view name_of(Family family);

/// Constants that a laboratory states, its sensors, and changes of the rig while it measures.
struct Laboratory {
  identify::KnownConstants constants;
  identify::Sensors sensors;
  /// Growth of all friction from the first sweep of the record to the last, over that of the model.
  double friction_growth = 0.0;
};

struct DepartureParameter {
  std::string_view name;
  std::string_view unit;  ///< SI
  std::string_view meaning;
  friction::Range range;  ///< values that have a meaning
  /// Start and bounds of the fit of a mechanism, over `natural_scale`. With low > 0 the fit changes the parameter
  /// by ratios.
  double start = 1.0;
  double low = 0.0;
  double high = 0.0;
};

/// Values that a real rig may have.
struct PlausibleValues {
  std::string_view name;       ///< which of several; may be empty
  std::vector<double> values;  ///< SI, in the order of the parameters
  std::string_view because;    ///< where they come from
};

/// Name of the line that adds nothing: Coulomb + viscous friction.
inline constexpr std::string_view plain_name = "coulomb_viscous";

/// One line of the table: "base + values of the parameters -> model".
struct Departure {
  std::string_view name;
  std::string_view meaning;  ///< what happens in the rig, one line
  std::vector<DepartureParameter> parameters;
  /// `values`: SI, in the order of the parameters.
  sim::Model (*build)(const RigBase& base, std::span<const double> values);

  // For the stress test. Without `severity` it is a mechanism only.
  std::string_view severity{};  ///< what s is, in words: "deflection of the contact F0/K over X"
  double largest = 0.0;         ///< largest s that has a meaning
  /// The parameters at severity s.
  std::vector<double> (*values_at)(const RigBase& base, double s) = nullptr;

  // For the study of mechanisms. Without plausible values it is no mechanism.
  std::vector<PlausibleValues> plausible{};
  bool forced_only = false;  ///< it is in the drive or the spring: a free decay on another spring does not have it

  Family family = Family::none;
  /// Whether a rig with it has one F0 and one zeta. Only then are the estimates of it scored.
  bool has_F0 = true;
  bool has_zeta = true;
  /// It is seen only in records of several sweeps.
  bool needs_sweeps = false;
  /// Changes what the laboratory states or reads, or the rig while it measures; may be absent.
  void (*mislead)(Laboratory& laboratory, const ReferenceMotion& reference, double s) = nullptr;

  // For the library of laws of `any_law`, which has all other departures that do not mislead the laboratory.
  bool outside_library = false;  ///< it is left out, for the reason at its row
  std::string_view twin_of{};    ///< left out, because negative severities of this other law stand for it
  double largest_below = 0.0;    ///< size of the largest negative severity that has a meaning; 0: there is none
  /// It is another spring or frequency than stated, which may be off by this severity; 0: it is another law.
  double spring_limit = 0.0;
};

/// The whole table, sorted by name.
[[nodiscard]] const std::vector<Departure>& all_departures();

/// Those with a severity, and those that are mechanisms; sorted by name.
[[nodiscard]] const std::vector<Departure>& departures();
[[nodiscard]] const std::vector<Departure>& mechanisms();

/// nullptr if there is no such departure, or no such mechanism.
[[nodiscard]] const Departure* find_departure(std::string_view name);
[[nodiscard]] const Departure* find_mechanism(std::string_view name);

/// Coulomb + viscous friction, which the methods assume and are to find.
struct Truth {
  sim::Model model;  ///< with the damper c; without friction laws
  double F0 = 0.0;   ///< N
};

/// The truth without a departure.
[[nodiscard]] sim::Model undisturbed(const Truth& truth);

/// The truth with a departure of severity s.
[[nodiscard]] sim::Model departed(const Departure& departure, const Truth& truth, const ReferenceMotion& reference,
                                  double s);

/// A laboratory's rig, and the motion in the middle of its tests.
struct Apparatus {
  sim::Oscillator oscillator;  ///< its damping is not used
  ReferenceMotion reference;   ///< its frequency is the one that the laboratory sets
  /// Time constant with which contact or film warms [s]. A minute is long beside a free decay, which stays cold. A
  /// steady state depends only on the ratio of a period to it; the shorter it is, the sooner the state is found.
  double warming_time = 60.0;
};

/// Coulomb and viscous friction of a rig beside its mechanism.
struct RigFriction {
  double F0 = 0.0;  ///< N, > 0
  double c = 0.0;   ///< N.s/m
};

/// The rig driven at the laboratory's frequency with the input amplitude Y [m].
[[nodiscard]] sim::Model driven(const Departure& mechanism, const Apparatus& apparatus, const RigFriction& friction,
                                std::span<const double> values, double Y);

/// A release from rest at x = displacement [m], on a spring of this stiffness [N/m], without drive.
[[nodiscard]] sim::Model released(const Departure& mechanism, const Apparatus& apparatus,
                                  const RigFriction& friction, std::span<const double> values, double stiffness,
                                  double displacement);

/// The size that a quantity of this unit has in the reference motion: X for m, wX for m/s, k for N/m, k/X^2 for
/// N/m^3, kY/(wX)^2 for N.s^2/m^2, the drive's power kY wX/2 for W, 1/w for s, 1 for 1. Errors: `std::logic_error`
/// for another unit.
[[nodiscard]] double natural_scale(const Apparatus& apparatus, std::string_view unit);

}  // namespace dualdamp::identify::departures
