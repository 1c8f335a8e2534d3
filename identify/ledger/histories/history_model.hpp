#pragma once
/// The joint model of time histories: the simulated motion of forward_fit.hpp, with the readings of x and, where
/// they were measured, v and a.
///
/// Derivatives of the motion by every base parameter and relaxation come from the forward model
/// (sampled_oscillator.hpp). Noise of the drive, estimated from the fourth differences of its samples, lasts in the
/// motion: readings of x and v are replaced by their innovations (innovations.hpp). Rows are averaged so that 24
/// rows a natural period are left. The deviation of a channel and the correlation of its errors are estimated from
/// what all relaxations together leave of it (autoregression.hpp): a departure must not be taken for noise.
/// Readings of a within two samples of a reversal are not used, because the acceleration jumps there.
///
/// With relaxations taken, the model is fitted again: the forces act on the simulated motion, readings have their
/// gain, delay and zero. If a constant is set free, the fit may begin at a separate one in which the constant is
/// unknown. Of free vibrations the end, below 3 x_f, is left out.
///
/// Cost: a run of the forward model with some 20 derivatives, 2 us a sample; ten times that for each explanation of
/// a departure that is tried.

#include <string>
#include <variant>

#include "identify/ledger/joint_model.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// The model, or why there is none. `sigma_x`: stated deviation of a sample of x [m], used unless the samples
/// scatter clearly more; 0: none. How long errors last is taken from the samples in any case. `missed` receives the
/// reason where every fit misses half of the motion or more.
[[nodiscard]] std::variant<JointModel, std::string> history_model(const Record& record,
                                                                  const KnownConstants& constants,
                                                                  double sigma_x = 0.0,
                                                                  std::string* missed = nullptr);

}  // namespace dualdamp::identify
