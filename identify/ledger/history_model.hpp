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
/// With relaxations taken, the model is fitted anew: the forces act on the simulated motion, readings have their
/// gain, delay and zero. A constant set free begins at a fit of its own. Of free vibrations the end, below 3 x_f,
/// is left out.
///
/// Cost: a run of the forward model with some 20 derivatives, 2 us a sample; ten times that for each explanation of
/// a departure that is tried.

#include <string>
#include <variant>

#include "identify/ledger/joint_model.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// The model, or why there is none.
[[nodiscard]] std::variant<JointModel, std::string> history_model(const Record& record,
                                                                  const KnownConstants& constants);

}  // namespace dualdamp::identify
