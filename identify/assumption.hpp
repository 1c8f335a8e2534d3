#pragma once
/// The assumptions that a damping ratio and a friction force rest on, in the order in which they are reported.

#include <array>
#include <cstddef>
#include <string_view>

namespace dualdamp::identify {

enum class Assumption {
  constants,              ///< mass, stiffness, frequency and geometry are as stated
  sensors,                ///< gain, delay, unit and range of each sensor
  spring,                 ///< linear
  one_mode,               ///< one degree of freedom
  drive,                  ///< harmonic and steady, for the methods that assume it
  stationarity,           ///< nothing drifts from sweep to sweep or within the record
  friction_velocity,      ///< friction over speed is a straight line
  friction_displacement,  ///< friction does not depend on position or on the distance since the last reversal
  symmetry,               ///< friction is the same in both directions
};

inline constexpr std::size_t assumption_count = 9;

/// Probability that any test of a record rejects if all assumptions hold.
inline constexpr double family_level = 0.05;

[[nodiscard]] constexpr std::array<Assumption, assumption_count> assumptions() {
  using enum Assumption;
  return {constants, sensors, spring, one_mode, drive, stationarity, friction_velocity, friction_displacement,
          symmetry};
}

/// Is it about the law of friction: over speed, or over displacement?
[[nodiscard]] constexpr bool is_of_law(Assumption assumption) {
  return assumption == Assumption::friction_velocity || assumption == Assumption::friction_displacement;
}

/// Is it about friction: its law, or its symmetry?
[[nodiscard]] constexpr bool is_of_friction(Assumption assumption) {
  return is_of_law(assumption) || assumption == Assumption::symmetry;
}

/// "constants", "one_mode", ...: names of the result.
[[nodiscard]] std::string_view name_of(Assumption assumption);
/// "the constants are as stated", ...
[[nodiscard]] std::string_view statement_of(Assumption assumption);

/// A set of assumptions, on which a method rests.
class AssumptionSet {
 public:
  constexpr AssumptionSet() = default;
  /// All but these.
  template <class... List>
  [[nodiscard]] static constexpr AssumptionSet all_but(List... list) {
    AssumptionSet set;
    set.bits_ = ((1U << assumption_count) - 1U) & ~(0U | ... | bit(list));
    return set;
  }

  [[nodiscard]] constexpr bool contains(Assumption assumption) const { return (bits_ & bit(assumption)) != 0; }

 private:
  static constexpr unsigned bit(Assumption assumption) { return 1U << static_cast<unsigned>(assumption); }
  unsigned bits_ = 0;
};

}  // namespace dualdamp::identify
