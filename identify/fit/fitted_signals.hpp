#pragma once
/// What the end of a fit says of each signal: size of the residuals, tests whether they are noise, degrees of
/// freedom.
///
/// Errors: numbers that do not exist are `unknown`. Cost: that of the tests (`residual_test.hpp`,
/// `serial_test.hpp`).

#include <Eigen/Core>

#include "identify/fit/fit.hpp"
#include "identify/fit/search/search.hpp"

namespace dualdamp::identify {

/// Sets `signals`, `noise_units` and `log_likelihood_count` of a fit. `misses`, `jacobian`: where the search ended.
void describe_signals(const FitProblem& problem, const SearchResult& found, const Eigen::VectorXd& misses,
                      const Eigen::MatrixXd& jacobian, bool robust, Fit& result);

}  // namespace dualdamp::identify
