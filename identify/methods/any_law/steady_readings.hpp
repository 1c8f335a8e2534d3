#pragma once
/// Steady states as readings: amplitudes, and phases if they were measured, computed by the engines in time.
///
/// If there are phases or several frequencies, the stiffness k (1 + d) and a cubic term k3 are free beside F0 and
/// c. They act as the stiffness k (1 + d + 3/4 (k3 X^2/k) (z/X)^2) of a state whose spring stretches by z. This
/// leaves out the third harmonic of the spring's force, an effect of second order: the prior of k3 is a tenth of
/// k/X^2.
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

/// States that are planned on the rig of another record, with stiffness and cubic stiffness free. `states`: with
/// about the expected amplitudes and, if phases are to be read, the expected phases. `deviations`: of the readings
/// [m, rad]. The readings themselves have no meaning.
[[nodiscard]] std::unique_ptr<const ReadingModel> planned_states(const ReadingModel& record,
                                                                 std::vector<Pair> states,
                                                                 const KnownConstants& constants,
                                                                 const std::array<double, 2>& deviations);

/// The states of another record with further ones, as one record: units and the motion that severities refer to are
/// those of `record`, and the search begins at its unknowns `start`.
[[nodiscard]] std::unique_ptr<const ReadingModel> continued_states(const ReadingModel& record,
                                                                   std::vector<Pair> states,
                                                                   const KnownConstants& constants,
                                                                   const KnownDeviations& known,
                                                                   const Eigen::VectorXd& start);

}  // namespace dualdamp::identify
