#pragma once
/// The estimate of the joint model, and its range: what departures of friction that no test sees may make of it.
///
/// The interval of an estimate holds if friction is as the model has it. Beside it, a term of friction with the
/// coefficient g moves zeta and F0 along a line. The record does not exclude coefficients up to the ends of the 95
/// % interval of g, on the side that the term can have. With the term free, each end of the interval of zeta lies
///
///   sqrt((t s)^2 + (dzeta/dg)^2 (g_end - g)^2)
///
/// from the estimate with the term at its best possible g; s: standard error of zeta at fixed g. The range holds
/// these intervals for every term of friction. Cost: that of a least-squares fit of the columns for each term.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/ledger/estimate/stated_shares.hpp"
#include "identify/ledger/joint_model.hpp"
#include "identify/ledger/ledger.hpp"
#include "identify/ledger/relaxation_tests.hpp"

namespace dualdamp::identify {

/// Names the tests whose departures are nearly seen in the entries of assumptions that are not violated.
void note_nearly_seen(const JointModel& model, const RelaxationTests& tests, Ledger& ledger);

/// The fit of the joint model with these relaxations free beside the base parameters, and with errors of uncertain
/// numbers as far as the model knows them (stated_errors.hpp).
[[nodiscard]] Estimate joint_estimate(const JointModel& model, const Taken& relaxed, const StatedShares& shares,
                                      std::string basis);

/// The estimate with the best explanation of each departure relaxed. If other relaxations explain a departure as
/// well, or a term of friction is nearly seen, the intervals are extended to cover the estimates with those. A mass
/// and a stiffness that explain a departure alike share it by their stated uncertainties; where these allow it, the
/// intervals need not cover either of them alone.
[[nodiscard]] Estimate relaxed_estimate(const JointModel& model, const RelaxationTests& tests,
                                        const StatedShares& shares = {});

/// The range of an estimate of the joint model. Nothing if it has no interval.
[[nodiscard]] std::optional<UnseenRange> unseen_friction(const JointModel& model, const RelaxationTests& tests,
                                                         const Estimate& estimate, const StatedShares& shares = {});

/// Does one term that is a law of its own explain all that departs? Several terms together may follow any other law
/// with a wrong zeta and F0.
[[nodiscard]] bool follows_law(const JointModel& model, const RelaxationTests& tests);

}  // namespace dualdamp::identify
