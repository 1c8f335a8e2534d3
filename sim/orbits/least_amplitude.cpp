#include "sim/orbits/least_amplitude.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/constants.hpp"
#include "sim/engine/drive.hpp"

namespace dualdamp::sim {

using friction::Direction;

namespace {

/// Relative rounding of the impedance and of the force that is left.
constexpr double unresolved = 1e-13;

/// The largest force of a law without memory whose force is constant in each direction [N]; else infinite.
double largest_force(const friction::Law& law) {
  if (!law.is_affine() || law.has_memory()) return core::infinity;
  double largest = law.static_limit({}, {}) + std::abs(law.force({}, {}, Direction::none));
  for (const Direction direction : {Direction::forward, Direction::backward}) {
    const friction::Affine force = law.affine_force({}, {}, direction);
    if (force.position != 0.0 || force.velocity != 0.0 || force.rate != 0.0 || force.transient != 0.0)
      return core::infinity;
    largest = std::max(largest, std::abs(force.constant));
  }
  return largest;
}

}  // namespace

double least_amplitude(const Model& model) {
  const Oscillator& o = model.oscillator;
  if (!is_linear(o)) return 0.0;
  double friction = 0.0;
  for (const friction::Law& law : model.friction) friction += largest_force(law);
  const Drive drive(o, model.excitation);
  double least = 0.0;
  for (std::size_t j = 0; j < drive.frequencies().size(); ++j) {
    const double w = drive.frequencies()[j];
    const double inertia = o.mass * w * w;
    const double force = std::abs(drive.force_phasor(j));
    const double left = force - 8.0 / core::two_pi * friction;
    if (!(left > unresolved * force)) continue;
    const double impedance = std::abs(std::complex(o.stiffness - inertia, o.damping * w));
    if (impedance <= unresolved * (o.stiffness + inertia)) return core::infinity;
    least = std::max(least, left / impedance);
  }
  return least;
}

}  // namespace dualdamp::sim
