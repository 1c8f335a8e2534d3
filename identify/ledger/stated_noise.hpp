#pragma once
/// Deviations that are stated for the readings of a joint model, instead of what the residuals tell.
///
/// The rows then have unit variance, known, and the tests are those of normal deviates and chi-square. What smooth
/// curves leave of the residuals is noise whatever the law of friction is: where it contradicts the statement, this
/// is told. Noise that is clearly larger than stated is used as the readings show it; stated noise that is larger
/// than the readings show is used as stated.

#include <string>

#include "identify/ledger/joint_model.hpp"
#include "identify/options.hpp"
#include "identify/statistics/scatter.hpp"

namespace dualdamp::identify {

/// If either deviation is positive both are stated, and the other reading is exact.
[[nodiscard]] bool is_stated(const KnownDeviations& known);

/// `scatter_beside_stated` for the deviation of readings over the stated one; as stated without a degree of
/// freedom.
[[nodiscard]] ScatterBesideStated readings_scatter(double ratio, double freedom);

/// Notes in the model that its readings (the word for a message) contradict the statement; nothing if they do not.
void note_contradiction(ScatterBesideStated scatter, double ratio, const std::string& readings, JointModel& model);

/// What is known of the noise of steady states: of `amplitudes` rows, and of the rows of `phases` that follow them.
void set_noise(Eigen::Index amplitudes, Eigen::Index phases, Eigen::Index smooth_columns, JointModel& model);

}  // namespace dualdamp::identify
