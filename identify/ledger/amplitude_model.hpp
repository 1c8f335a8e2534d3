#pragma once
/// The joint model of steady states: amplitudes of x and y, and phases where they were measured.
///
/// Errors of x, Y and the phase are independent and of constant deviation. The true amplitude of x is a nuisance of
/// each state, so that errors of x do not bias the fit (fuller1987). Residuals of Y and the phase are
///
///   obs - D(xi) - D'(xi) (x - xi),   V = S + sigma_x^2 D' D'^T,   xi = x + sigma_x^2 D'^T V^-1 (residual)
///
/// with D of amplitude_terms.hpp. The ratio of sigma_Y to sigma_x is that of the largest likelihood; the deviation
/// of the phase comes from its own residuals. Stated deviations of amplitudes are used as they are, unless the
/// states contradict them (stated_noise.hpp). States that stick at the fit are left out and named.
///
/// Cost: a millisecond for 24 states, linear.

#include <string>
#include <variant>

#include "identify/ledger/joint_model.hpp"
#include "identify/options.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// The model, or why there is none.
[[nodiscard]] std::variant<JointModel, std::string> amplitude_model(const Record& record,
                                                                    const KnownConstants& constants,
                                                                    const KnownDeviations& known = {});

}  // namespace dualdamp::identify
