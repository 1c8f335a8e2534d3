#pragma once
/// Guards drawn at random over every kind of basis that a mode of the engine can have, with planted near-double
/// roots, tangencies, tangencies of higher order, known zeros at the start, crossings near them and events at the
/// horizon.

#include <array>
#include <complex>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/exponential_sum.hpp"
#include "tests/support/random.hpp"

namespace dualdamp::test {

/// The oscillator's own motion.
enum class OwnMotion {
  underdamped,
  overdamped,
  near_critical,       ///< exponents 1e-16 to 1e-2 apart, real or conjugate, on a chain
  undamped_resonance,  ///< a harmonic 1e-16 to 1e-2 beside the own frequency: secular terms
  negative_stiffness,
  negative_damping,
  free_mass,  ///< no stiffness, with or without damping: constants and ramps drive powers of time
  count,
};
[[nodiscard]] std::string_view name(OwnMotion kind);

struct GuardCase {
  struct Element {
    std::complex<double> exponent;
    int parent = oracle::ExponentialSum::no_parent;
    bool unused = false;  ///< in no guard; may leave the range of double precision before the horizon
  };
  struct Row {
    std::vector<std::complex<double>> coefficients;
    int zeros = 0;  ///< known, at the start
  };

  OwnMotion kind = OwnMotion::underdamped;
  double rate = 1.0;  ///< rad/s, the scale of the oscillator; 2 pi/rate is called its period
  std::vector<Element> elements;
  std::vector<Row> guards;
  double horizon = 0.0;
};

[[nodiscard]] GuardCase random_guards(Random& random);
/// The guard as a sum of the oracle.
[[nodiscard]] oracle::ExponentialSum reference(const GuardCase& c, const GuardCase::Row& guard);
/// All its numbers as text, to reproduce it.
[[nodiscard]] std::string describe(const GuardCase& c);

}  // namespace dualdamp::test
