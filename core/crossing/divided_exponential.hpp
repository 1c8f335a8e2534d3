#pragma once
/// Divided differences of z -> exp(z s), exact to a few roundings however close the nodes are (opitz1964;
/// mccurdy1984).

#include <complex>
#include <span>

namespace dualdamp::core {

using Complex = std::complex<double>;

/// Nodes that one divided difference can have; a mode needs four: constant, ramp and the oscillator's own two.
inline constexpr std::size_t max_nodes = 6;

/// exp(z s), with the last digits of the modulus far down a decay.
[[nodiscard]] Complex exponential(Complex z, double s);

/// Over one to `max_nodes` nodes, equal ones allowed; s >= 0. Throws std::length_error for more.
[[nodiscard]] Complex divided_exponential(std::span<const Complex> nodes, double s);

}  // namespace dualdamp::core
