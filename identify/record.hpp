#pragma once
/// Records: what a laboratory measures, whether it came from a file or from the simulator.
///
/// A method gets a record and the constants a laboratory would know (`KnownConstants`), never the system that
/// produced it.

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/coordinate.hpp"

namespace dualdamp::identify {

/// Value of a quantity that was not measured or is not known.
inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// c at which the motion stops oscillating [N.s/m].
[[nodiscard]] inline double critical_damping(double mass, double stiffness) {
  return 2.0 * std::sqrt(mass * stiffness);
}

/// Constants that a laboratory knows before the test, SI; `unknown` for the others. A method that needs a constant
/// that is not known gives no estimate, with the reason.
struct KnownConstants {
  double mass = unknown;       ///< m [kg], > 0
  double stiffness = unknown;  ///< k [N/m], > 0; 0 for a mass on a rail without spring
  double frequency = unknown;  ///< forcing frequency w [rad/s], > 0, for all data that do not state their own
  /// Only for the units in messages; the units in this file are those of a displacement (core/coordinate.hpp).
  core::Coordinate coordinate = core::Coordinate::displacement;

  [[nodiscard]] double natural_frequency() const { return std::sqrt(stiffness / mass); }  ///< rad/s
  [[nodiscard]] double critical_damping() const { return identify::critical_damping(mass, stiffness); }

  /// "N.m" for "N" where x is an angle.
  [[nodiscard]] std::string unit(std::string_view unit) const { return core::unit_for(coordinate, unit); }
};

/// One measured steady state: input and output amplitude, and what else was read.
struct Pair {
  double Y = 0.0;     ///< input amplitude [m]
  double x = 0.0;     ///< output amplitude, half of peak to trough [m]
  std::string sweep;  ///< label of the sweep it belongs to; may be empty
  /// Number of the pair in the record, from 1: what messages and exclusion lists name.
  int number = 0;
  double omega = unknown;              ///< forcing frequency [rad/s]; unknown: that of the constants
  double phase = unknown;              ///< lag of x's fundamental behind y [rad]
  double fundamental = unknown;        ///< amplitude of x's fundamental [m]
  double mean_square_speed = unknown;  ///< m^2/s^2
};

/// Forcing frequency of a pair [rad/s].
[[nodiscard]] inline double frequency_of(const Pair& pair, const KnownConstants& constants) {
  return std::isnan(pair.omega) ? constants.frequency : pair.omega;
}

/// Whether two frequencies, or ratios of frequencies, are equal. Generators hold theirs to 1e-6, and a frequency
/// from a record is not better than 1e-5.
[[nodiscard]] inline bool is_same_frequency(double a, double b) {
  constexpr double tolerance = 1e-4;
  return std::abs(a - b) <= tolerance * b;
}

/// Steady states at one or more amplitudes and frequencies.
struct PairRecord {
  std::vector<Pair> pairs;
};

/// Extremes of a free vibration: signed turning points in order of time, with an unknown common offset.
struct DecayRecord {
  std::vector<double> extremes;  ///< m
  std::vector<double> times;     ///< s, increasing, one for each extreme; empty when they were not measured
};

/// Signals of one test, sampled together at a constant rate. A signal that was not measured is empty; the others
/// are of equal length.
struct History {
  double start = 0.0;         ///< time of the first sample [s]
  double sample_rate = 0.0;   ///< Hz, > 0
  std::vector<double> y;      ///< base displacement [m]
  std::vector<double> x;      ///< displacement of the mass [m]
  std::vector<double> v;      ///< its velocity [m/s]
  std::vector<double> a;      ///< its acceleration [m/s^2]
  std::vector<double> force;  ///< force on the mass beside spring, damper and friction [N]
  std::string sweep;          ///< label; may be empty
  /// For messages: what gaps in the times have left out; why it gives no x-Y pair. Empty: nothing, or not asked.
  std::string gaps = {};
  std::string no_pair = {};
  /// Why the motion is not free although no drive was measured; empty: it may be free, or was not asked.
  std::string unknown_drive = {};
  /// Readings of x after those of a free motion, which are left out: of the mass at rest, noise alone.
  std::vector<double> at_rest = {};
  bool is_clipped = false;   ///< samples at the end of a sensor's range were found, and warned of
  int part_of = 0;           ///< number of the record of which it is one of several parts; 0: it is none
  bool begins_free = false;  ///< a measured blow has ended: nothing pushes the mass from the first sample on

  /// A drive was measured; a history without one is of a free vibration, or of a drive that the constants state.
  [[nodiscard]] bool has_drive() const { return !y.empty() || !force.empty(); }

  /// The drive at a sample: 0 for a part that was not measured.
  [[nodiscard]] double y_at(std::size_t sample) const { return y.empty() ? 0.0 : y[sample]; }
  [[nodiscard]] double force_at(std::size_t sample) const { return force.empty() ? 0.0 : force[sample]; }
};

/// All that was measured; kinds of data that were not measured are empty.
struct Record {
  std::optional<PairRecord> pairs;
  std::optional<DecayRecord> decay;
  std::vector<History> histories;  ///< one for each test: level, frequency, run
};

}  // namespace dualdamp::identify
