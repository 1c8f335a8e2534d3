#pragma once
/// The record of a pendulum as that of an oscillator with a linear spring, so that every method can read it.
///
/// The torque k x of the linear spring has a part G x in place of G sin x, G = m g l (sim/oscillator.hpp).
///
/// * An extreme A becomes xi(A) = ((k - G) A + G Si(A))/k, Si the sine integral. Over half a swing dry friction
/// takes 2 F0 A of the energy V, so that xi = int V'(a)/(k a) da falls by 2 F0/k, as with a linear spring. A
/// viscous damper takes nearly the share that it takes with a linear spring. In all zeta is off by up to 0.7 % and
/// F0 by up to 1.1 % for a release at 90 deg (docs/rotation.md).
/// * A half swing that lasts T(A)/2 becomes one of T(0)/2.
/// * In a history the difference G (x - sin x) joins the measured force on the mass.
///
/// Where extremes have an offset it is that of the sensor: the middle of the swings is where the pendulum hangs.
/// Holds for swings below 180 deg. Cost: linear, about 1 us an extreme.

#include <string>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

/// `stiffness` k and `gravity_stiffness` G, a part of it [N.m/rad]. Adds to `warnings` what was done.
void linearise_pendulum(Record& record, double stiffness, double gravity_stiffness,
                        std::vector<std::string>& warnings);

/// xi(A), and T(A)/T(0): of a spring of which gravity makes the share G/k.
[[nodiscard]] double linear_extreme(double angle, double share);
[[nodiscard]] double period_ratio(double angle, double share);

}  // namespace dualdamp::identify
