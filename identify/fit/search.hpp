#pragma once
/// Searches the parameters of a rig whose motions come closest to what was measured.
///
/// Least squares with weights from the noise of each signal, from several starts. The sum of squares of a long
/// motion has a false minimum for each number of its swings and of its sticks; so searches begin with the first
/// part of each motion and take in more and more of it. Where these do not end alike, others begin with all
/// readings. Where what is left is no noise, another search begins with models tied to the measured motion
/// (`tie.hpp`). The first steps are rough: a looser tolerance and fewer samples.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identify/fit/problem.hpp"

namespace dualdamp::identify {

struct SearchOptions {
  int points = 40;              ///< where the sum of squares is computed
  std::size_t most_starts = 3;  ///< the best of them, from which all readings are fitted
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

/// The least squares next to a place.
[[nodiscard]] std::optional<SearchResult> search_from(const FitProblem& problem, const Eigen::VectorXd& coordinates,
                                                      const SearchOptions& options);

}  // namespace dualdamp::identify
