#pragma once
/// Converts the record of a pendulum to that of an oscillator with a linear spring, which every method can read.
///
/// The linear spring has the torque G x in place of G sin x, with G = m g l (sim/oscillator.hpp).
///
/// * An extreme A becomes xi(A) = ((k - G) A + G Si(A))/k, Si the sine integral. Over half a swing, dry friction
///   takes 2 F0 A of the energy V, so xi = int V'(a)/(k a) da falls by 2 F0/k, as with a linear spring. A viscous
///   damper takes nearly the same share of the energy as with a linear spring. For a release at 90 deg, the error
///   of zeta is up to 0.7 % and that of F0 up to 1.1 % (docs/rotation.md).
/// * A half swing that lasts T(A)/2 becomes one that lasts T(0)/2.
/// * In a history, the difference G (x - sin x) is added to the measured force on the mass.
///
/// An offset of the extremes is that of the sensor: the middle of the swings is the position in which the pendulum
/// hangs. Holds for swings below 180 deg. Cost: linear, about 1 us an extreme.

#include <string>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// `stiffness`: k; `gravity_stiffness`: G, a part of k [N.m/rad]. `warnings` says what was converted.
void linearise_pendulum(Record& record, double stiffness, double gravity_stiffness,
                        std::vector<std::string>& warnings);

}  // namespace dualdamp::identify
