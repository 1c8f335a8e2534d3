#pragma once
/// Starts of more searches, far from the end of another one along one parameter of a law.
///
/// The first swings of a decay show neither the force at rest nor the speed below which friction rises to it. A
/// search may take such a parameter to where it changes nothing, and no derivative leads back. Or it ends in a
/// false minimum: the sum of squares has a kink wherever the mass comes to rest one half swing earlier or later.
/// Both leave little more than noise, so that no test of the residuals tells them.
///
///   open     speeds, and levels above another one, that the readings leave open by more than 3 % where the search
///            ended
///   along    one of them has values over the range of its starts; a parameter above another one has distances of
///            0.05 to 1.6 times the other. At each value the other parameters are fitted in a few steps, from where
///            the search ended or from the place of the value before, whichever is better
///   starts   the two best of these places
///
/// Other parameters, such as the stiffness of a bristle, are left out, because each of them takes as long.
///
/// Errors: none; what cannot be predicted has an infinite sum of squares. Cost: nine short searches for each open
/// parameter.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "identify/experiments/starts.hpp"
#include "identify/fit/problem.hpp"
#include "identify/fit/search/steps.hpp"

namespace dualdamp::identify {

/// The end of a search. `jacobian`: of the weighted residuals.
struct SearchEnd {
  SearchPlace place;
  Eigen::MatrixXd jacobian;
};

/// Numbers of the open parameters of laws: speeds first, then those above another one. None for steady states:
/// `balanced_states.hpp` begins their searches.
[[nodiscard]] std::vector<std::size_t> open_parameters(const FitProblem& problem,
                                                       const std::vector<FitParameter>& parameters,
                                                       const SearchEnd& end);

/// Fits the parameters that `held` does not hold, from the best of these points.
using FitHeld = std::function<SearchPlace(const FitProblem& held, const std::vector<Eigen::VectorXd>& points)>;

/// Starts along parameter `number`, the best first.
[[nodiscard]] std::vector<SearchPlace> far_starts(const FitProblem& problem,
                                                  const std::vector<FitParameter>& parameters, std::size_t number,
                                                  const Eigen::VectorXd& from, const DataScale& scale,
                                                  const FitHeld& fit_held);

}  // namespace dualdamp::identify
