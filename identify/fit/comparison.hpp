#pragma once
/// Laws compared by their fits to the same data: AICc with the number of samples that count as independent
/// (burnham2002).
///
///   AICc = n D + 2 K + 2 K (K + 1)/(n - K - 1)
///
/// D is the deviance per sample (`Fit::deviance`), K the number of parameters and of deviations.

#include <string>
#include <vector>

#include "identify/fit/fit.hpp"

namespace dualdamp::identify {

/// Sets AICc of each fit. All are fits of the same data. The number of independent samples is that of the fit with
/// the least deviance. `robust`: of fits with Huber's weights, Huber's sum takes the place of the sum of squares,
/// in units of one deviation for all fits: the least one, with the degrees of freedom of its fit. If no noise is
/// stated, the growth of Huber's sum from that fit enters the likelihood as a growth of the sum of squares would:
/// the weights of normal readings are about those of plain fits. A parameter counts 2 E(psi^2)/E(psi') in place of
/// 2, which is the mean gain of the sum by a parameter that the data do not need (ronchetti1985).
void compare_fits(std::vector<Fit>& fits, bool robust = false);

/// Warning that the weights of the laws rest on few degrees of freedom and on no stated noise; empty: they do not.
/// Each fit then has a deviation of its own, from its few residuals: chance may make that of a wrong law so small
/// that it takes all the weight.
[[nodiscard]] std::string warning_of_weights(const std::vector<Fit>& fits);

}  // namespace dualdamp::identify
