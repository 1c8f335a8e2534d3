#pragma once
/// The joint model of a free vibration that is known by its extremes, and by their times where they were measured.
///
///   X_(i+1) = R X_i - x_f (1 + R) - sum_j g_j h_j(X),   e_i = +-X_i + o,   t_(i+1) = t_i + pi/(wn s) (1 + ...)
///
/// h_j: loss of amplitude in one half swing by a force that is neither Coulomb nor viscous; X: mean amplitude of
/// the half swing. The loss is W/(2 k X) with the work W of the force along half a period of a sine. The fit is
/// that of free_decay, which also leaves out what comes after the stop. Source: feeny1996decrement,
/// liang1998decrement. With terms taken, the model is fitted again by the same recursion. Cost: some milliseconds
/// beside free_decay.

#include <string>
#include <variant>

#include "identify/ledger/joint_model.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// The model, or why there is none. `sigma_x`: stated deviation of an extreme [m], used unless the extremes
/// contradict it (stated_noise.hpp); 0: none.
[[nodiscard]] std::variant<JointModel, std::string> decay_model(const Record& record,
                                                                const KnownConstants& constants,
                                                                double sigma_x = 0.0);

}  // namespace dualdamp::identify
