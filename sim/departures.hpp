#pragma once
/// Departures from Coulomb + viscous friction, each with one number for its size, so that the harm that different
/// laws do to an identification can be compared.
///
/// The truth is an oscillator with viscous damping c and Coulomb friction F0. A departure of severity s > 0 changes
/// it and tends to it as s -> 0. Severities are pure numbers, ratios to the reference motion: amplitude X and peak
/// speed V of the truth in the middle of the range of excitation.

#include <string_view>
#include <vector>

#include "sim/model.hpp"

namespace dualdamp::sim {

/// The motion that severities are measured by.
struct ReferenceMotion {
  double amplitude = 0.0;  ///< X [m]
  double frequency = 0.0;  ///< w [rad/s]
  double Y = 0.0;          ///< input amplitude [m]

  [[nodiscard]] double speed() const { return amplitude * frequency; }
};

/// Coulomb + viscous friction: what the methods assume, and are to find.
struct Truth {
  Model model;      ///< without friction laws
  double F0 = 0.0;  ///< N

  [[nodiscard]] double c() const { return model.oscillator.damping; }
};

struct Departure {
  std::string_view name;
  std::string_view severity;  ///< what s is, in words: "deflection of the contact F0/K over X"
  double largest;             ///< beyond it s has no meaning
  Model (*apply)(const Truth& truth, const ReferenceMotion& reference, double s);
};

/// Sorted by name.
[[nodiscard]] const std::vector<Departure>& departures();

/// nullptr when there is no such law.
[[nodiscard]] const Departure* find_departure(std::string_view name);

/// The truth itself: friction that is Coulomb + viscous.
[[nodiscard]] Model undisturbed(const Truth& truth);

}  // namespace dualdamp::sim
