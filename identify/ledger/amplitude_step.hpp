#pragma once
/// The parameters of the joint model of steady states, and the steps of its fit.

#include <Eigen/Core>

#include "identify/ledger/amplitude_terms.hpp"
#include "identify/ledger/joint_model.hpp"

namespace dualdamp::identify {

/// Plain friction, and a coefficient for each relaxation.
struct SteadyParameters {
  PlainFriction friction;
  Eigen::VectorXd g;
};

/// One Gauss-Newton step, limited in length. `step`: of zeta, x_f and the coefficients taken.
void take_step(const Eigen::VectorXd& step, const Taken& taken, SteadyParameters& at);

/// Did a step change no parameter by a share that matters, and x_f by no length that does?
[[nodiscard]] bool is_settled(const SteadyParameters& before, const SteadyParameters& after);

}  // namespace dualdamp::identify
