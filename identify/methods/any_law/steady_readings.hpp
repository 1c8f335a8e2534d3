#pragma once
/// Steady states as readings: amplitudes, and phases where they were measured, each by the engines in time.
///
/// Beside F0 and c the stiffness k (1 + d) and a cubic term k3 are free where phases or several frequencies tell of
/// them. They act as the stiffness k (1 + d + 3/4 (k3 X^2/k) (z/X)^2) of a state whose spring stretches by z, which
/// leaves out the third harmonic of the spring's force. A second-order effect: k3 keeps to a tenth of k/X^2.
///
/// Cost: four orbits a state for a derivative; 0.05 ms each under laws of the exact engine, 2 ms under others.

#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "identify/methods/any_law/reading_model.hpp"
#include "identify/options.hpp"

namespace dualdamp::identify {

/// The model, or why there is none: constants or frequencies are missing, or there are fewer than four states.
[[nodiscard]] std::variant<std::unique_ptr<const ReadingModel>, std::string> steady_readings(
    const Record& record, const KnownConstants& constants, const KnownDeviations& known);

/// States that are to be measured on the rig of another record, with stiffness and cubic stiffness free: `states`
/// with about the amplitudes and, where they are to be read, phases that are expected. `deviations` [m, rad] of the
/// readings. The readings themselves mean nothing.
[[nodiscard]] std::unique_ptr<const ReadingModel> planned_states(const ReadingModel& record,
                                                                 std::vector<Pair> states,
                                                                 const KnownConstants& constants,
                                                                 const std::array<double, 2>& deviations);

}  // namespace dualdamp::identify
