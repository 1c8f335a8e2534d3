#pragma once
/// Whether the zero of x differs from history to history. Where it does, none of them need be zero: the mean zero
/// is then as free as the others.
///
/// F test of all zeros less their mean, beside the other base parameters. Beside all relaxations it would miss
/// most: in two decays, several terms together are like two zeros. What another departure leaves adds to the noise.
/// Cost: N rows times the square of the columns.

#include <Eigen/Core>

#include "identify/ledger/histories/history_relaxations.hpp"
#include "identify/ledger/joint_model.hpp"
#include "identify/methods/histories/forward_fit.hpp"

namespace dualdamp::identify {

/// The zeros of all records [m], if they differ by more than chance (level 1 %); else empty. `model`: with nothing
/// relaxed, and the mean zero the last of the zeros that are always free; linear about `at`. `before`: zeros that
/// were subtracted from x [m]; empty: none.
[[nodiscard]] Eigen::VectorXd unlike_zeros(const JointModel& model, const ForwardLayout& layout, const Place& at,
                                           const Eigen::VectorXd& before = {});

}  // namespace dualdamp::identify
