#pragma once
/// A law under modifiers. Every force limit of the law, nominally L, becomes
///
///   max(0, max(0, 1 + drift t) max(0, 1 + ratio n(t)) L + position_slope |x|)     [N]
///
/// the factor first, the slope after. n(t) is an Ornstein-Uhlenbeck process of variance 1, held on cells of a tenth
/// of the correlation time T: n_0 = g_0, n_(i+1) = rho n_i + sqrt(1 - rho^2) g_(i+1) with rho = exp(-1/10) and g_i
/// the normal draw i of the seed. So its samples are exact, it is stationary from the start, and a cell has the
/// same value however often the path is walked.
///
/// The law inside sees `Instant::modification` and stays affine in every mode: between the changes below limits are
/// affine in t and x. The wrapper adds
///   times    the ends of cells; the end of a falling drift at t = -1/drift. Where limits rise by a step the law
///            first gets `Trigger::limit_change` at the old ones.
///   guards   x = 0, where the slope changes its sign; a limit that vanishes, or returns.
/// While no limit is left the law has no force; it begins anew, unstretched, where a limit returns.
///
/// Source: uhlenbeck1930 in `docs/refs.bib` for the process. Cost: a copy of what the law remembers at each call.

#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

/// `law` under the modifiers among `values`; itself when there is none, or none does anything. `limits`: the
/// nominal force limits of a law that supports `position_slope` [N].
[[nodiscard]] Law modified(const Law& law, const ParameterValues& values, std::vector<double> limits = {});

}  // namespace dualdamp::friction
