#pragma once
/// Divided differences of z -> exp(z s), exact to a few roundings however close the nodes are (opitz1964;
/// mccurdy1984).

#include <complex>
#include <span>

namespace dualdamp::core {

using Complex = std::complex<double>;

/// Largest number of nodes of one divided difference; a mode needs four: constant, ramp and the oscillator's two.
inline constexpr std::size_t max_nodes = 6;

/// exp(z s); the modulus keeps its last digits even if it has decayed far.
[[nodiscard]] Complex exponential(Complex z, double s);

/// The divided difference over one to `max_nodes` nodes, which may be equal; s >= 0. Throws std::length_error for
/// more nodes.
[[nodiscard]] Complex divided_exponential(std::span<const Complex> nodes, double s);

}  // namespace dualdamp::core
