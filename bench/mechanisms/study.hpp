#pragma once
/// Which mechanism explains that the estimates of zeta and F0 change as the upper data are left out.
///
/// Each mechanism (`identify/departures/departures.hpp`) is fitted to the estimates (`fit.hpp`). Its
/// effect is computed at plausible values. The fitted rig is released in a free decay, whose first four and last
/// four extremes are evaluated separately, as in Table 3 of the paper. Results do not depend on the number of
/// threads.

#include "bench/mechanisms.hpp"
#include "scenarios/results/answer.hpp"
#include "sim/model.hpp"

namespace dualdamp::bench {

/// No result where no levels reproduce the estimates. `model`: the rig as the laboratory believes it to be.
[[nodiscard]] scenarios::Answer run_mechanism_study(const MechanismStudy& study, const sim::Model& model);

}  // namespace dualdamp::bench
