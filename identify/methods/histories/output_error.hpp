#pragma once
/// Output-error identification: the friction with which a simulated motion comes closest to the measured one.
///
///   min over c, F0, x(0), v(0), and m or k where unknown, of  sum_i [x_i - x(t_i; parameters)]^2
///
/// x(t) is the motion under the measured base motion and force (`identify/models/sampled_oscillator.hpp`), through
/// reversals and sticks, with exact derivatives; Levenberg-Marquardt. Nothing is differentiated, so noise in x does
/// not bias the fit; noise of y and force moves the simulated mass. Several histories have common parameters, but
/// separate initial states.
///
/// Checked: a term v|v|; residuals that are correlated from sample to sample, unlike noise: then the law, the
/// constants or the drive are wrong. Uncertainty: from the parametric bootstrap
/// (`identify/uncertainty/parametric_bootstrap.hpp`), each record by one step of Gauss and Newton; correlated
/// residuals widen the intervals. Holds for a linear spring and equal static and kinetic friction. For exact data
/// the error is about 1e-11, if y changes little within a sample interval. Source: ljung1999, leine2004. Errors:
/// `outcome`. Cost: 70 simulations; 0.3 s for 10,000 samples.

#include "identify/method.hpp"

namespace dualdamp::identify {

[[nodiscard]] Estimate output_error(const Record& record, const KnownConstants& constants,
                                    const RegressionOptions& options = {});

extern const MethodEntry output_error_method;

}  // namespace dualdamp::identify
