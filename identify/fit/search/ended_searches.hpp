#pragma once
/// Searches that are continued to their end, and the best of them.
///
/// Where the noise of a signal is not stated, the weights of its readings follow from the residuals, and the search
/// continues with these. Ends of searches elsewhere that fit the readings as well as the best one, but for chance,
/// are its rivals: the sum of squares has several minima, and the noise decides which of them is the lowest.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identify/fit/problem.hpp"
#include "identify/fit/search/search.hpp"
#include "identify/fit/search/weighted_search.hpp"
#include "identify/statistics/least_squares.hpp"

namespace dualdamp::identify {

/// Keeps the one with less squares. One without a motion does not count.
void take_better(LeastSquaresFit found, const WeightedSearch& search, const FitProblem& problem,
                 std::optional<LeastSquaresFit>& best);

/// Whether two searches came to the same minimum: by their sums of squares, and by the change of the readings
/// between them. `alike`: part of the sum of squares.
[[nodiscard]] bool is_same_place(const LeastSquaresFit& a, const LeastSquaresFit& b, double alike = 0.01);

/// Whether a sum of squares is less than another one by more than chance between places of one valley.
[[nodiscard]] bool is_clearly_less(double squares, double than, const FitProblem& problem);

/// Whether several signals weigh each other by deviations of which nothing is known before the fit.
[[nodiscard]] bool guesses_weights(const FitProblem& problem);

/// -2 ln of the likelihood at the end of a search, whose deviations follow from its residuals; but for a constant.
[[nodiscard]] double deviance_of(const SearchResult& found, const FitProblem& problem, SearchOptions options);

/// Scans the parameters that act in steps, from the end of another search.
[[nodiscard]] LeastSquaresFit scan(LeastSquaresFit from, const WeightedSearch& search, const FitProblem& problem);

class EndedSearches {
 public:
  /// The problem and the options must outlive this.
  EndedSearches(const FitProblem& problem, const SearchOptions& options,
                std::optional<SearchResult> best = std::nullopt);

  [[nodiscard]] const std::optional<SearchResult>& best() const { return best_; }
  [[nodiscard]] bool is_cut_short() const { return problem_.is_exhausted() || (best_ && best_->is_cut_short); }
  /// Whether nothing is left to find.
  [[nodiscard]] bool is_at_end() const { return is_cut_short() || (best_ && !holds_motion(*best_, problem_)); }

  /// The best search, with its rivals.
  [[nodiscard]] std::optional<SearchResult> result();

  /// Ends another search. Returns whether it is the best one.
  bool take(const std::optional<LeastSquaresFit>& found);

  /// Ends a search from `from` that begins with these deviations of the signals.
  void take_weighed(const LeastSquaresFit& from, const std::vector<double>& deviations);

  /// Ends those of these searches of a rough problem that may be rivals of the best one: no higher than chance
  /// explains, and higher ground lies between.
  void take_rivals(std::vector<LeastSquaresFit> ends, const WeightedSearch& search, const FitProblem& problem);

  /// Sum of squares of the best search, with the weights of all comparisons.
  [[nodiscard]] double least() const { return alike_.squares(best_->coordinates); }
  void set_settled(bool is_settled) { best_->is_settled = is_settled; }

 private:
  [[nodiscard]] std::optional<SearchResult> end(const LeastSquaresFit& found, const SearchOptions& options) const;
  /// Whether it is more likely than the best one.
  [[nodiscard]] bool is_better(const SearchResult& result) const;
  /// Makes it the best one or a rival.
  bool compare(SearchResult result);

  const FitProblem& problem_;
  const SearchOptions& options_;
  bool several_weights_;
  bool guesses_weights_;
  WeightedSearch alike_;  ///< compares ended searches with the same weights
  std::optional<SearchResult> best_;
  std::vector<LeastSquaresFit> ended_;  ///< before their weights were found
  std::vector<Eigen::VectorXd> others_;
};

/// The search from `coordinates` to its end. Nothing if the rig has no such motion there.
[[nodiscard]] std::optional<SearchResult> ended_search(const FitProblem& problem, LeastSquaresFit from,
                                                       const SearchOptions& options);

}  // namespace dualdamp::identify
