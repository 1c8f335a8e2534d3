#pragma once
/// How a method ends: it refuses a record, or judges its own estimate and says whether it is usable, and why.

#include <string>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// Why constants cannot be used; empty if they can. Mass and stiffness must be positive and finite.
[[nodiscard]] std::string lacks_constants(const KnownConstants& constants);

/// Marks that there is no estimate: `outcome` becomes not_identifiable, with the reason.
void refuse(Estimate& estimate, std::string reason);

/// Diagnostic of one parameter that cannot be negative: it came out negative, or cannot be distinguished from zero.
/// A reason not to use the estimate is appended to `faults`, a lesser one to the estimate's warnings. `scale`: size
/// of the parameter that the data could show; a share of it is taken for rounding, 0: none. `interval`: of 95 %;
/// nullptr: there is none.
void judge_sign(double value, double scale, const Interval* interval, const std::string& name, Estimate& estimate,
                std::vector<std::string>& faults);

/// The diagnostics of zeta, whose scale is 1, and of the Coulomb friction, by x_f; `scale_x_f` in m.
void judge_signs(Estimate& estimate, double scale_x_f, std::vector<std::string>& faults);

/// Sets `sound`, `usable` and `reason`. The estimate is usable if there are neither `faults` nor findings; `basis`
/// is then the reason.
void conclude(Estimate& estimate, const std::vector<std::string>& faults, std::string basis);

}  // namespace dualdamp::identify
