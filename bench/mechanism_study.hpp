#pragma once
/// Which mechanism explains that the estimates of zeta and F0 change as the upper data are left out.
///
/// Each mechanism (`identify/rigs/rigs.hpp`) is fitted to the estimates (`mechanism_fit.hpp`); is put at values
/// that a rig may well have, to see how much it does; and, fitted, is let go in a free decay, whose first and last
/// four extremes are read apart as Table 3 of the paper does. Results do not depend on the number of threads.

#include "bench/mechanisms.hpp"
#include "scenarios/results/answer.hpp"
#include "sim/model.hpp"

namespace dualdamp::bench {

/// No result where no levels give the estimates. `model`: the rig as it is believed to be.
[[nodiscard]] scenarios::Answer run_mechanism_study(const MechanismStudy& study, const sim::Model& model);

}  // namespace dualdamp::bench
