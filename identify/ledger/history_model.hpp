#pragma once
/// The joint model of time histories: the simulated motion of forward_fit.hpp, with the readings of x and, where
/// they were measured, v and a.
///
/// Derivatives of the motion by every base parameter and relaxation come from the forward model
/// (sampled_oscillator.hpp). Noise of the drive, as large as the fourth differences of its samples show, lasts in
/// the motion: readings of x and v become innovations (innovations.hpp). Rows are averaged over as many samples as
/// leave 24 a natural period. What all relaxations together leave of a channel tells its deviation, and how far its
/// errors are still alike (autoregression.hpp): a departure must not be taken for noise. Readings of a within two
/// samples of a reversal are not used, for the acceleration jumps there.
///
/// Cost: a run of the forward model with some 20 derivatives, 2 us a sample.

#include <string>
#include <variant>

#include "identify/ledger/joint_model.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// The model, or why there is none.
[[nodiscard]] std::variant<JointModel, std::string> history_model(const Record& record,
                                                                  const KnownConstants& constants);

}  // namespace dualdamp::identify
