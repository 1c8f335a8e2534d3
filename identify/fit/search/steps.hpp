#pragma once
/// Parameters on which the readings depend in steps, and searches for them.
///
/// The force of a loop under `free_play` is on or off at each sample: over the play it is a staircase, whose
/// derivative is zero or a jump of a single sample. Such a parameter is found without a law's name: over a part of
/// its range the readings change, by more than rounding, but nowhere there by a change of 1e-9 of it.
///
///   scan     all of its range in steps of 15 %, with the other parameters fitted at each; places with the same
///            readings count once
///   zoom     around the three best, then around the best, with a quarter of the distance in each round
///   middle   of the step on which the search ends: all values of the step have the same readings
///
/// Errors: none; what cannot be predicted has an infinite sum of squares. Cost: some hundred motions of a loop, and
/// as many fits of the other parameters.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "identify/fit/problem.hpp"

namespace dualdamp::identify {

/// Which parameters act in steps. `q`: coordinates at which the others have an effect. None, unless all records are
/// loops: a motion that is simulated changes smoothly.
[[nodiscard]] std::vector<bool> stepped_parameters(const FitProblem& problem, const Eigen::VectorXd& q);

/// A place of a search.
struct SearchPlace {
  Eigen::VectorXd q;
  double squares = 0.0;
};

/// Fits the parameters that do not act in steps, from `q`.
using FitOthers = std::function<SearchPlace(const Eigen::VectorXd& q)>;

/// The best place that scans of all stepped parameters find, one after the other; `from`, if none is better.
[[nodiscard]] SearchPlace scan_steps(const FitProblem& problem, const SearchPlace& from,
                                     const FitOthers& fit_others);

}  // namespace dualdamp::identify
