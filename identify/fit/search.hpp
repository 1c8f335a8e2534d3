#pragma once
/// Searches the parameters of a rig whose motions come closest to what was measured.
///
/// Least squares with weights from the noise of each signal, from several starts. The sum of squares of a long
/// motion has a false minimum for each number of its swings; so where a search ends with more than noise, the
/// beginning of each motion is fitted first, then more and more of it.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identify/fit/problem.hpp"

namespace dualdamp::identify {

struct SearchOptions {
  int starts = 40;  ///< points where the sum of squares is computed; the search begins at the best of them
  bool robust = false;
};

struct SearchResult {
  Eigen::VectorXd coordinates;
  Eigen::VectorXd weights;  ///< of each row of the problem; one over its deviation, less for outliers
};

/// `sizes`: of each parameter, as in the problem. Nothing: the rig has no such motion from any start.
[[nodiscard]] std::optional<SearchResult> search_parameters(const FitProblem& problem,
                                                            const std::vector<FitParameter>& parameters,
                                                            const std::vector<double>& sizes,
                                                            const SearchOptions& options);

}  // namespace dualdamp::identify
