#pragma once
/// The linear joint model with the errors of uncertain numbers free, each bound by its stated deviation.
///
///   min over d, g, e of |r - B d - C g - E e|^2/s^2 + sum over i of (e_i/u_i)^2
///
/// B, C: columns of the base parameters and of the relaxations taken; e: relative errors of the mass, the stiffness
/// and the gains, u: their stated deviations; E: their columns; s: deviation of the rows. The solution is the most
/// probable one for independent normal errors, and its covariance holds what the record tells of the errors and
/// what it does not. Under a measured force a motion tells only the ratios m : k : force : c : F0. A number moved
/// by itself leaves the record, and a fit takes it back; all of them moved together change nothing but c and F0.
///
/// A number that was taken as a departure, with an error beyond what is allowed (allowed_error), is free. One
/// without an uncertainty is exact beside those that have one, as far as their errors explain the record as well.

#include <Eigen/Core>
#include <optional>

#include "identify/ledger/estimate/stated_shares.hpp"
#include "identify/ledger/joint_model.hpp"

namespace dualdamp::identify {

/// A model with relaxations free, solved by least squares.
struct Solution {
  Taken free;                    ///< relaxations behind the base parameters, in the order of their columns
  Eigen::MatrixXd covariance;    ///< of the parameters, for rows of unit variance
  Eigen::VectorXd step;          ///< from the parameters of the model
  double variance = 1.0;         ///< of the rows
  double freedom = 0.0;          ///< degrees of freedom that the parameters leave
  double squares_of_rows = 0.0;  ///< that are left
  double squares = 0.0;          ///< of the rows, and of the errors over their deviations
};

/// Nothing where a column is a combination of the others, or no degree of freedom is left.
[[nodiscard]] std::optional<Solution> solved(const JointModel& model, const Taken& taken,
                                             const StatedShares& shares);

/// Does an estimate of the model know the stated uncertainties?
[[nodiscard]] bool knows_stated_errors(const JointModel& model);

}  // namespace dualdamp::identify
