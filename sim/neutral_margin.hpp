#pragma once

namespace dualdamp::sim {

/// An orbit with a Floquet multiplier this close to the unit circle attracts too slowly for any test in a
/// laboratory. Such orbits also appear at the end of a continuum, a double root that Newton's method finds to half
/// the digits.
inline constexpr double neutral_margin = 1e-6;

}  // namespace dualdamp::sim
