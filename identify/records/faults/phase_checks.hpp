#pragma once
/// Do x, Y and phase of x-Y pairs belong together?
///
///   k Y cos(phase) = (k - m w^2) x,   sin(phase) > 0
///
/// phase: lag of x behind y. Friction acts at right angles to the first equation; by the second the base puts
/// energy in. Where they fail, every simple cause is tried: the unit of the phase, a sign, columns exchanged. All
/// that fit are named.
///
/// Errors: none. Cost: linear.

#include <optional>
#include <string>
#include <vector>

#include "core/setting.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

struct Balance {
  int pairs = 0;
  int too_much = 0;          ///< pairs with |k - m w^2| x far above k Y
  int swapped_too_much = 0;  ///< the same with x and Y exchanged
  int negative_work = 0;
  int phases = 0;
  std::vector<double> cosines;  ///< errors of k Y cos(phase), over k Y
  std::vector<double> excess;   ///< |k - m w^2| x over k Y

  [[nodiscard]] bool takes_work() const { return 2 * negative_work > phases && phases > 0; }
};

[[nodiscard]] Balance balance_of(const std::vector<Pair>& pairs, const KnownConstants& constants);

/// Whether there are phases, and most of them fit x and Y.
[[nodiscard]] bool phases_fit(const std::vector<Pair>& pairs, const KnownConstants& constants);

/// How many times too large Y is for x and the phases. Nothing if they do not tell: that needs pairs on both sides
/// of the natural frequency, whose k Y cos(phase) is in proportion to (k - m w^2) x. On one side friction that
/// holds the mass for a part of the period makes up for any factor.
[[nodiscard]] std::optional<double> excess_of_Y(const std::vector<Pair>& pairs, const KnownConstants& constants);

struct PhaseFault {
  std::string message, allowed;
};

/// What is wrong with the phases of pairs under a driving force Y [N]: its work in a period, pi Y x sin(phase), is
/// negative in more pairs than it is positive, where it is clearly one of both. That needs no constant. With mass
/// and stiffness, Y cos(phase) = (k - m w^2) x tells which sign is wrong.
[[nodiscard]] std::optional<PhaseFault> force_phase_fault(const std::vector<Pair>& pairs,
                                                          const KnownConstants& constants,
                                                          const core::SettingWords& words);

/// What is wrong with the phases; nothing where they fit, or where only another mass or stiffness would make them
/// fit: the ledger tests for it. `from_histories`: they were computed, in radians.
[[nodiscard]] std::optional<PhaseFault> phase_fault(const std::vector<Pair>& pairs, const KnownConstants& constants,
                                                    bool from_histories, const core::SettingWords& words);

}  // namespace dualdamp::identify
