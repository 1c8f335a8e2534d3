#pragma once
/// A zero of x that is off acts as a constant force does, the part of Coulomb friction that differs between the
/// directions, and an AC coupling of x much as damping that differs. Sensors are off more often than friction is
/// uneven: of a sensor and a symmetry that explain a departure as well, the sensor comes first.

#include <cstddef>
#include <string>
#include <vector>

#include "identify/ledger/relaxation_tests.hpp"

namespace dualdamp::identify {

/// The candidate that a departure is charged to, where `best` leaves the least misfit.
[[nodiscard]] std::size_t sensor_before_symmetry(const JointModel& model, const std::vector<RelaxationTest>& list,
                                                 const std::vector<double>& misfits, std::size_t best);

/// Is candidate `i` a symmetry that explains less than the sensor that is charged?
[[nodiscard]] bool yields_to_sensor(const JointModel& model, const std::vector<RelaxationTest>& list,
                                    const std::vector<double>& misfits, std::size_t charged, std::size_t i);

/// "; half of the difference of F0 between the directions is 0.15 N, the same as a zero of x that is off by 8.1e-05
/// m": the size of a departure that acts as a constant force; empty for another one.
[[nodiscard]] std::string size_of_constant_force(const JointModel& model, const RelaxationTest& test);

}  // namespace dualdamp::identify
