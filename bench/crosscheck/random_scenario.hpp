#pragma once
/// Draws scenarios over the whole allowed range: oscillator, drive, friction laws alone and mixed, modifiers.
///
/// Seven cases of ten lie in the usual range, three over all of it (`wide`):
///
///   quantity                           usual range    whole range
///   damping ratio                      1e-3 to 2      1e-6 to 1e4; one case of sixteen 0, one negative
///   frequency ratio                    0.05 to 20     1e-3 to 1e3
///   friction over force of the drive   1e-2 to 1.5    1e-6 to 1e3
///   static over kinetic friction       1 to 2.5       1 to 5
///
/// The scenario is a valid file (JSON is YAML): `dualdamp run` can read it.

#include <cstdint>
#include <string>
#include <string_view>

#include "bench/crosscheck/draws.hpp"
#include "scenarios/format/json.hpp"

namespace dualdamp::crosscheck {

using scenarios::Json;

/// Scales of the drawn values of laws, SI.
struct Sizes {
  double mass = 1.0;
  double stiffness = 1.0;
  double natural = 1.0;  ///< natural frequency [rad/s]
  double force = 1.0;    ///< of the drive
  bool wide = false;

  [[nodiscard]] double length() const { return force / stiffness; }
  [[nodiscard]] double speed() const { return natural * length(); }
};

/// Case `index` of a campaign. Seeds from 70 on also draw attached masses, from 10,000 on the late laws.
[[nodiscard]] Json random_scenario(std::uint64_t seed, std::uint32_t index);
/// The scenario that these bytes give; any bytes give one.
[[nodiscard]] Json random_scenario(std::string_view bytes);

/// One to four laws in parallel.
[[nodiscard]] Json random_friction(Draws& draws, const Sizes& sizes);

/// Adds an oscillator attached to the mass, in one case of ten.
void attach_mass(Draws& draws, const Sizes& sizes, Json& friction);

/// In three cases of ten one of the laws that the list of `random_friction` lacks, alone or beside the others; and
/// loads that vary with position or with a harmonic drive.
void add_late_laws(Draws& draws, const Sizes& sizes, bool is_harmonic, Json& friction);

/// The same scenario as a file that people can read.
[[nodiscard]] std::string yaml(const Json& scenario);

}  // namespace dualdamp::crosscheck
