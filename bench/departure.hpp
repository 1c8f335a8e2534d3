#pragma once
/// The departure of a case of the stress test: none, one of the table, or two of them at the same severity.

#include <string>

#include "bench/departure_names.hpp"

namespace dualdamp::bench {

struct CaseDeparture {
  const Departure* first = nullptr;   ///< nullptr: friction is Coulomb + viscous and all is as assumed
  const Departure* beside = nullptr;  ///< a second one, for which `leaves_friction_alone`; or nullptr

  [[nodiscard]] bool is_truth() const { return first == nullptr; }
  /// "lugre", "lugre + base_gain", "coulomb_viscous"
  [[nodiscard]] std::string name() const;
  [[nodiscard]] Family family() const;
  /// What its severity measures, in words.
  [[nodiscard]] std::string meaning_of_severity() const;
  /// The largest severity that has a meaning.
  [[nodiscard]] double largest_severity() const;
  /// Whether there is still one true zeta, one true F0.
  [[nodiscard]] bool has_zeta() const;
  [[nodiscard]] bool has_F0() const;
  /// Whether only records of several sweeps show it.
  [[nodiscard]] bool needs_sweeps() const;

  /// The truth with the departure of severity s.
  [[nodiscard]] sim::Model model(const Truth& truth, const ReferenceMotion& reference, double s) const;
  /// Changes what the laboratory believes or reads.
  void mislead(Laboratory& laboratory, const ReferenceMotion& reference, double s) const;

  friend bool operator==(const CaseDeparture&, const CaseDeparture&) = default;
};

/// Whether the friction of the truth stays, as the last law: the departure is in spring, sensors, constants or
/// drive.
[[nodiscard]] bool leaves_friction_alone(const Departure& departure);

}  // namespace dualdamp::bench
