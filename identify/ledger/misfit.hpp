#pragma once
/// Does a joint model fit its record at all? The test of a relaxation compares one column with residuals that hold
/// the whole misfit: where the model misses everything, nothing stands out.
///
/// An F test compares what the model leaves with the noise that the record has without it: the rest beside smooth
/// curves over amplitude and frequency. A misfit matters if an error as long along the columns of zeta or F0 would
/// change one of them by the least change that matters: without noise the smallest error of a model is significant.
///
/// It has a share of the family level of the record, and the tests of the relaxations have the rest.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "identify/ledger/joint_model.hpp"
#include "identify/ledger/ledger.hpp"

namespace dualdamp::identify {

/// Share of the family level that the test of the misfit has.
inline constexpr double misfit_share = 0.1;

/// The misfit of a model with these relaxations taken; nothing if it is not significant or does not matter.
[[nodiscard]] std::optional<Misfit> misfit_of(const JointModel& model, const Taken& taken, double least_change);

/// Whether the relaxations taken leave a misfit that matters and is significant or more than three times the noise:
/// of few states such a misfit may have lost its significance with the freedom that they took.
[[nodiscard]] bool leaves_misfit(const JointModel& model, const Taken& taken, double least_change);

/// "the joint model misses these data by 12 times their noise (p = 1e-9)"
[[nodiscard]] std::string misfit_size(const Misfit& misfit);

/// Why the joint model, with all that is relaxed, does not determine friction, a sentence: histories need friction
/// that is negative by twice its interval, states fit negative friction that they do not determine, or the estimate
/// reaches above the largest friction with which the mass can move. What one method makes of such data, by energy
/// or forces, is then no better. Empty otherwise.
[[nodiscard]] std::string fault_of_joint(const Ledger& ledger);

}  // namespace dualdamp::identify
