#include "identify/fit/search/ended_searches.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "identify/fit/search/steps.hpp"

namespace dualdamp::identify {

namespace {

/// In variances of a reading: twice the growth within which a 95 % interval lies, for residuals that are
/// correlated.
constexpr double most_excess = 8.0;

bool has_several_weights(const FitProblem& problem, const SearchOptions& options) {
  return options.robust || problem.readings().signals().size() > 1;
}

/// Of a reading, by the least sum of squares.
double variance_of(double least, const FitProblem& problem) {
  return least / std::max(1.0, problem.readings().count());
}

}  // namespace

void take_better(LeastSquaresFit found, const WeightedSearch& search, const FitProblem& problem,
                 std::optional<LeastSquaresFit>& best) {
  found.sum_of_squares = search.squares(found);
  if (!std::isfinite(found.sum_of_squares) || found.jacobian.rows() != problem.readings().size()) return;
  if (!best || found.sum_of_squares < best->sum_of_squares) best = std::move(found);
}

bool is_same_place(const LeastSquaresFit& a, const LeastSquaresFit& b, double alike) {
  const double between = (b.jacobian * (a.parameters - b.parameters)).squaredNorm();
  return std::abs(a.sum_of_squares / b.sum_of_squares - 1.0) < alike && between < alike * b.sum_of_squares;
}

bool is_clearly_less(double squares, double than, const FitProblem& problem) {
  constexpr double enough = 4.0;  // variances
  return squares < than - enough * variance_of(than, problem);
}

bool guesses_weights(const FitProblem& problem) {
  const FitReadings& readings = problem.readings();
  return readings.signals().size() > 1 && std::ranges::any_of(readings.signals(), [&](const SignalRows& rows) {
           return !(readings.signal(rows).noise > 0.0);
         });
}

double deviance_of(const SearchResult& found, const FitProblem& problem, SearchOptions options) {
  options.deviations = found.deviations;
  double sum = WeightedSearch(problem, options).squares(found.coordinates);
  for (std::size_t s = 0; s < found.deviations.size(); ++s)
    sum += 2.0 * problem.readings().count(problem.readings().signals()[s]) * std::log(found.deviations[s]);
  return sum;
}

LeastSquaresFit scan(LeastSquaresFit from, const WeightedSearch& search, const FitProblem& problem) {
  if (!problem.has_stepped()) return from;
  constexpr double close = 1e-6;
  constexpr int few = 8;
  const SearchPlace best = scan_steps(problem, {from.parameters, search.squares(from.parameters)},
                                      [&](const Eigen::VectorXd& q) -> SearchPlace {
                                        const LeastSquaresFit found = search.improve(q, close, few);
                                        return {found.parameters, search.squares(found.parameters)};
                                      });
  from.parameters = best.q;
  from.sum_of_squares = best.squares;
  return from;
}

std::optional<SearchResult> ended_search(const FitProblem& problem, LeastSquaresFit from,
                                         const SearchOptions& options) {
  constexpr int most_rounds = 12;
  constexpr double settled = 1e-3;
  constexpr double large = 0.1;
  // A search ends where a step lowers the sum of squares by a small part of the variance of a reading, so that the
  // parameters are within a hundredth of their standard errors. Along a valley in which the readings hardly tell
  // parameters apart, steps go on for ever. While the weights still change by a multiple, less will do.
  const double variance = 1.0 / std::max(1.0, problem.readings().count());
  const double fine = std::max(1e-8, 1e-4 * variance);
  const double coarse = std::max(1e-5, 1e-2 * variance);
  WeightedSearch search(problem, options);
  const bool several_weights = has_several_weights(problem, options);
  double last = several_weights && search.begins_anew() ? core::infinity : 0.0;
  for (int round = 0; round < most_rounds; ++round) {
    Eigen::VectorXd outputs;
    LeastSquaresFit next = search.improve(from.parameters, last > large ? coarse : fine, 100);
    if (next.jacobian.rows() == problem.readings().size() && next.jacobian.allFinite()) from = std::move(next);
    if (!problem.outputs(from.parameters, outputs)) return std::nullopt;
    const double change = search.reweight(outputs, from.jacobian);
    if (!several_weights || (change < settled && last <= large)) break;
    last = change;
  }
  return search.result(from);
}

EndedSearches::EndedSearches(const FitProblem& problem, const SearchOptions& options,
                             std::optional<SearchResult> best)
    : problem_(problem),
      options_(options),
      several_weights_(has_several_weights(problem, options)),
      guesses_weights_(guesses_weights(problem)),
      alike_(problem, options),
      best_(std::move(best)) {
  if (best_) others_ = std::move(best_->rivals);
}

std::optional<SearchResult> EndedSearches::result() {
  if (!best_) return std::nullopt;
  if (problem_.is_exhausted()) best_->is_cut_short = true;
  SearchOptions options = options_;
  if (guesses_weights_) options.deviations = best_->deviations;
  const WeightedSearch search(problem_, options);
  const double least = search.squares(best_->coordinates);
  const double most = least + most_excess * variance_of(least, problem_);
  for (Eigen::VectorXd& q : others_)
    if (search.squares(q) < most) best_->rivals.push_back(std::move(q));
  others_.clear();
  return std::move(best_);
}

bool EndedSearches::take(const std::optional<LeastSquaresFit>& found) {
  // With several weights the end of a search takes most of its time. With one, it tells closer places apart.
  const double alike = several_weights_ ? 0.01 : 1e-3;
  if (!found || std::ranges::any_of(
                    ended_, [&](const LeastSquaresFit& other) { return is_same_place(*found, other, alike); }))
    return false;
  ended_.push_back(*found);
  std::optional<SearchResult> result;
  if (!problem_.is_exhausted()) result = end(*found, options_);
  const bool is_cut = problem_.is_exhausted();
  if (is_cut && !best_) {
    // The first place that was found is finished, with as much work again.
    problem_.extend(1.0);
    result = end(*found, options_);
  }
  const bool is_best = result && compare(std::move(*result));
  if (best_) best_->is_cut_short = is_cut;
  return is_best;
}

void EndedSearches::take_weighed(const LeastSquaresFit& from, const std::vector<double>& deviations) {
  if (!best_ || problem_.is_exhausted()) return;
  SearchOptions options = options_;
  options.deviations = deviations;
  if (std::optional<SearchResult> result = end(from, options); result && !problem_.is_exhausted())
    compare(std::move(*result));
}

void EndedSearches::take_rivals(std::vector<LeastSquaresFit> ends, const WeightedSearch& search,
                                const FitProblem& problem) {
  if (ends.empty() || !best_) return;
  constexpr std::size_t most = 4;
  std::ranges::sort(ends, {}, &LeastSquaresFit::sum_of_squares);
  const double least = ends.front().sum_of_squares;
  std::vector<SearchPlace> valleys = {{best_->coordinates, search.squares(best_->coordinates)}};
  const auto is_known = [&](const LeastSquaresFit& found) {
    return std::ranges::any_of(valleys, [&](const SearchPlace& valley) {
      const double between = search.squares(0.5 * (found.parameters + valley.q));
      const double higher = std::max(found.sum_of_squares, valley.squares);
      return std::isfinite(between) && !is_clearly_less(higher, between, problem);
    });
  };
  for (LeastSquaresFit& found : ends) {
    const bool is_rival = found.sum_of_squares < least + most_excess * variance_of(least, problem);
    if (!is_rival || valleys.size() == most || problem_.is_exhausted()) return;
    if (is_known(found)) continue;
    // On the floor of a bent valley, a search is slow.
    constexpr double close = 1e-6;
    constexpr int many = 32;
    found = search.improve(found.parameters, close, many);
    found.sum_of_squares = search.squares(found);
    if (is_known(found)) continue;
    valleys.push_back({found.parameters, found.sum_of_squares});
    if (std::optional<SearchResult> result = end(found, options_); result && !problem_.is_exhausted())
      compare(std::move(*result));
  }
}

bool EndedSearches::is_better(const SearchResult& result) const {
  // With guessed weights a signal that no parameters explain would decide alone.
  if (guesses_weights_) return deviance_of(result, problem_, options_) < deviance_of(*best_, problem_, options_);
  return alike_.squares(result.coordinates) < least();
}

bool EndedSearches::compare(SearchResult result) {
  if (best_ && !is_better(result)) {
    others_.push_back(std::move(result.coordinates));
    return false;
  }
  if (best_) {
    others_.push_back(std::move(best_->coordinates));
    result.is_settled = best_->is_settled;
  }
  best_ = std::move(result);
  return true;
}

std::optional<SearchResult> EndedSearches::end(const LeastSquaresFit& found, const SearchOptions& options) const {
  return ended_search(problem_, scan(found, WeightedSearch(problem_, options), problem_), options);
}

}  // namespace dualdamp::identify
