#pragma once
/// Oscillators drawn at random with friction that is likely to slide, stick and break away. Each law is made twice:
/// for the engine and as plain friction.

#include <array>
#include <string>
#include <string_view>

#include "sim/model.hpp"
#include "tests/support/plain_friction.hpp"
#include "tests/support/random.hpp"

namespace dualdamp::test {

enum class LawKind {
  coulomb,
  contact,         ///< contact compliance, static = kinetic
  contact_static,  ///< static > kinetic
  contact_damped,
  iwan,
  reset_integrator,
  bristle,
};
[[nodiscard]] std::string_view name(LawKind kind);

struct Oscillation {
  sim::Model model;
  PlainFriction plain;

  /// All numbers of oscillator and drive as text, to reproduce them.
  [[nodiscard]] std::string describe() const;
};

/// Ranges of oscillators and laws.
struct Ranges {
  std::array<double, 2> frequency_ratio = {0.05, 5.0};
  std::array<double, 2> damping_ratio = {1e-3, 3.0};
  /// Stiffest contact, in stiffnesses of the oscillator.
  double stiffest = 1e4;
};

/// A moving mass under a harmonic base motion, with its springs unstretched; without friction so far.
[[nodiscard]] Oscillation random_oscillator(Random& random, const Ranges& ranges);
/// One more law in parallel; bristles once only.
void add_law(Oscillation& oscillation, LawKind kind, Random& random, const Ranges& ranges);
/// Call once after the last law.
void start(Oscillation& oscillation);

}  // namespace dualdamp::test
