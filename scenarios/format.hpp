#pragma once
/// The scenario format: the tables of keys and what each analysis needs and returns. Contract: docs/user-guide.md.

#include <string>
#include <vector>

#include "scenarios/keys.hpp"

namespace dualdamp::scenarios {

inline constexpr std::string_view schema_name = "dualdamp/1";

/// What a file may ask for.
inline constexpr double max_points = 1e6;   ///< values of a list, points of a curve
inline constexpr double max_samples = 1e6;  ///< rows of a history
inline constexpr double max_cases = 1e7;    ///< of a stress test
inline constexpr double max_cycles = 1e5;   ///< forcing or natural periods of a history
inline constexpr double max_nodes = 1e7;    ///< random values of a noise

/// The keys of a scenario.
[[nodiscard]] const Section& scenario_format();

/// The variants of a choice of the format: analyses, excitations, laws.
[[nodiscard]] const Choice& analyses();
[[nodiscard]] const Choice& excitations();
[[nodiscard]] const Choice& friction_laws();

/// What an analysis needs from the other sections. One row for each kind of measurement of `identify`.
struct Needs {
  std::string analysis;
  std::string measurement;               ///< of identify: its type, or "data"; empty otherwise
  std::vector<std::string> excitations;  ///< types it works with; empty: it has no use for a system at all
  std::vector<std::string> drive;        ///< keys of a harmonic excitation that must be there
  bool whole_system = true;              ///< mass, stiffness above zero, and damping or damping_ratio must be there
  std::string reason;                    ///< why these excitations only, for messages
};

[[nodiscard]] const std::vector<Needs>& needs();

}  // namespace dualdamp::scenarios
