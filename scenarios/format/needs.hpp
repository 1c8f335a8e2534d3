#pragma once
/// What an analysis needs from the other sections of a scenario.

#include <string>
#include <vector>

#include "scenarios/format/excitations.hpp"

namespace dualdamp::scenarios {

/// A key of another section of which the analysis makes nothing: a stated value would have no effect.
struct IdleKey {
  std::string section;
  std::string key;
  std::string reason;   ///< continues "'system.damping' has no effect: "
  std::string allowed;  ///< what may be stated instead; empty: the value does no harm, and a warning is enough
};

struct Needs {
  /// For an analysis of data: the source of the data, `data` or the type of the `measurement`. An analysis whose
  /// needs depend on the source has one row for each. Empty otherwise.
  std::string source;
  std::vector<std::string> excitations;  ///< types that are allowed; empty: the analysis uses no system
  std::vector<std::string> drive;        ///< keys of a harmonic excitation that must be there
  bool whole_system = true;              ///< mass, stiffness above zero, and damping or damping_ratio must be there
  std::string reason;                    ///< why these excitations only, for messages
  std::vector<IdleKey> idle = {};        ///< told or refused, unless they state their default
};

/// Needs of an analysis of steady states; `drive`: keys of the excitation that the analysis does not vary.
[[nodiscard]] inline std::vector<Needs> needs_of_steady_states(std::vector<std::string> drive) {
  return {{"", harmonic_excitations(), std::move(drive), true, "a steady state needs a harmonic excitation"}};
}

/// The keys of the state at t = 0, for an analysis that takes the motion from a record or from a model of its own.
[[nodiscard]] inline std::vector<IdleKey> idle_start(const std::string& reason) {
  std::vector<IdleKey> keys;
  for (const char* key : {"position", "velocity", "travel"}) keys.push_back({"initial", key, reason, ""});
  return keys;
}

/// Needs of an analysis of free vibrations.
[[nodiscard]] inline Needs needs_of_free_vibrations(std::string source) {
  return {std::move(source), {"none"}, {}, true, "a free vibration has no excitation"};
}

}  // namespace dualdamp::scenarios
