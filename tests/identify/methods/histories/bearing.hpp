#pragma once
/// The paper's mass on its soft spring, near resonance, and small helpers for the tests of its identification.

#include <cmath>
#include <vector>

#include "identify/record.hpp"
#include "tests/identify/readers/refusals.hpp"

namespace dualdamp::identify::testing {

inline constexpr double mass = 1.042;        // kg
inline constexpr double stiffness = 1568.0;  // N/m
inline const double natural = std::sqrt(stiffness / mass);
inline const KnownConstants bearing{mass, stiffness, unknown};  ///< the frequency stands with each pair
inline const KnownConstants at_resonance{mass, stiffness, natural};

/// `count` equal steps, both ends included.
inline std::vector<double> spaced(double from, double to, int count) {
  std::vector<double> list;
  for (int i = 0; i < count; ++i) list.push_back(from + (to - from) * i / (count - 1));
  return list;
}

}  // namespace dualdamp::identify::testing
