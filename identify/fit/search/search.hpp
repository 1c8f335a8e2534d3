#pragma once
/// Searches for the parameters of a rig whose motions come closest to the measured ones.
///
/// Least squares with weights from the noise of each signal, from several starts. The sum of squares of a long
/// motion has a false minimum for each number of its swings and of its sticks.
/// * Two searches therefore begin with the first part of each motion, 10 % and 35 %, and extend it step by step.
/// * If these two do not end at the same sum of squares, more searches begin with all readings.
/// * If the residuals are not noise, the first parts are fitted once more from the best result.
/// * If they are still not noise, a search begins with models tied to the measured motion (`tie.hpp`).
/// * More searches begin far from the end, along parameters that are open there (`far_starts.hpp`), until none of
///   them finds anything better.
/// * Where the weights of several signals can only be guessed, and the residuals are not noise, searches begin in
///   which one signal after the other decides. The most likely end is the best.
/// Steady states are also searched for from the best harmonic balance (`harmonic_balance.hpp`).
/// The first steps have a looser tolerance and fewer samples.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identify/experiments/starts.hpp"
#include "identify/fit/parallel_elements.hpp"
#include "identify/fit/problem.hpp"

namespace dualdamp::identify {

struct SearchOptions {
  int points = 40;              ///< number of starts at which the sum of squares is computed
  std::size_t most_starts = 3;  ///< how many of the best starts are fitted with all readings
  bool robust = false;
  DataScale scale = {};  ///< of the data, for the spread of the starts
  /// Of each signal, at which the search begins: those of an earlier search. Empty: from the data.
  std::vector<double> deviations = {};
  std::vector<ParallelElements> elements = {};  ///< of laws
};

struct SearchResult {
  Eigen::VectorXd coordinates;
  Eigen::VectorXd weights;         ///< of each row of the problem: 1/deviation, smaller for outliers
  Eigen::VectorXd unbounded;       ///< the same without the bound of outliers
  std::vector<double> deviations;  ///< of each signal
  bool is_cut_short = false;       ///< the limit of the work was reached; this is the best until then
  bool is_settled = true;          ///< the last searches from far starts (`far_starts.hpp`) found nothing better
  std::vector<Eigen::VectorXd> rivals =
      {};  ///< coordinates elsewhere that fit nearly as well (`ended_searches.hpp`)
};

/// All of these searches but those from far starts. `sizes`: of each parameter, as in the problem. Nothing if the
/// rig has no such motion at any start.
[[nodiscard]] std::optional<SearchResult> search_parameters(const FitProblem& problem,
                                                            const std::vector<FitParameter>& parameters,
                                                            const std::vector<double>& sizes,
                                                            const SearchOptions& options);

/// Searches from far starts (`far_starts.hpp`), with at most twice the work that the problem has spent; `found` if
/// none of them is better.
[[nodiscard]] SearchResult search_far_from(SearchResult found, const FitProblem& problem,
                                           const std::vector<FitParameter>& parameters,
                                           const SearchOptions& options);

/// The local minimum near `coordinates`. Nothing if the rig has no such motion there.
[[nodiscard]] std::optional<SearchResult> search_from(const FitProblem& problem, const Eigen::VectorXd& coordinates,
                                                      const SearchOptions& options);

/// The best local minimum near any of these points. Nothing if the rig has no such motion there.
[[nodiscard]] std::optional<SearchResult> search_near(const FitProblem& problem,
                                                      const std::vector<Eigen::VectorXd>& points,
                                                      const SearchOptions& options);

/// Whether the residuals of any signal are more than noise; of a single record, if its number is given.
[[nodiscard]] bool holds_motion(const SearchResult& found, const FitProblem& problem,
                                std::optional<std::size_t> record = {});

}  // namespace dualdamp::identify
