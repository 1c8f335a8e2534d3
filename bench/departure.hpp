#pragma once
/// What is not as assumed in a case of the stress test: nothing, one rig of the table, or two at the same severity.

#include <string>

#include "bench/rigs.hpp"

namespace dualdamp::bench {

/// Name of the truth in the place of a departure.
inline constexpr const char* truth_name = "coulomb_viscous";

struct Departure {
  const Rig* law = nullptr;     ///< nullptr: friction is Coulomb + viscous and all is as assumed
  const Rig* beside = nullptr;  ///< a second one, which leaves friction alone (`leaves_friction_alone`); or nullptr

  [[nodiscard]] bool is_truth() const { return law == nullptr; }
  /// "lugre", "lugre + base_gain", "coulomb_viscous"
  [[nodiscard]] std::string name() const;
  [[nodiscard]] Family family() const;
  /// What its severity is, in words.
  [[nodiscard]] std::string severity() const;
  /// Beyond it a severity has no meaning.
  [[nodiscard]] double largest() const;
  /// Whether one zeta, one F0 is still there to be found.
  [[nodiscard]] bool has_zeta() const;
  [[nodiscard]] bool has_F0() const;
  /// It shows in records of several sweeps alone.
  [[nodiscard]] bool needs_sweeps() const;

  /// The truth with the departure of severity s.
  [[nodiscard]] sim::Model model(const Truth& truth, const ReferenceMotion& reference, double s) const;
  /// Changes what the laboratory believes or reads.
  void mislead(Laboratory& laboratory, const ReferenceMotion& reference, double s) const;

  friend bool operator==(const Departure&, const Departure&) = default;
};

/// Whether a rig has the Coulomb friction of the truth, as the last of its laws: its departure lies in spring,
/// sensors, constants or drive.
[[nodiscard]] bool leaves_friction_alone(const Rig& rig);

}  // namespace dualdamp::bench
