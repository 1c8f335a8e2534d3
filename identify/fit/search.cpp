#include "identify/fit/search.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "core/constants.hpp"
#include "identify/experiments/starts.hpp"
#include "identify/fit/far_starts.hpp"
#include "identify/fit/linear_starts.hpp"
#include "identify/fit/residual_test.hpp"
#include "identify/fit/steps.hpp"
#include "identify/fit/weighted_search.hpp"
#include "identify/statistics/least_squares.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::identify {

namespace {

using core::infinity;

std::vector<Eigen::VectorXd> start_points(const FitProblem& problem, const std::vector<FitParameter>& parameters,
                                          const std::vector<double>& sizes, const SearchOptions& options) {
  std::vector<Eigen::VectorXd> points(static_cast<std::size_t>(options.points));
  const LinearStarts linear(problem, parameters, start_of(parameters, sizes, 0, options.scale));
  sim::in_parts(points.size(), 1, 0, [&](std::size_t i, std::size_t) {
    const auto number = static_cast<int>(i);
    Eigen::VectorXd start = start_of(parameters, sizes, number, options.scale);
    for (const ParallelElements& elements : options.elements) elements.begin(start, number);
    points[i] = problem.space().point(linear.fitted(start));
  });
  return points;
}

/// The points with the smallest sums of squares, best first.
std::vector<Eigen::VectorXd> best_of(const std::vector<Eigen::VectorXd>& points, const WeightedSearch& search,
                                     std::size_t wanted) {
  std::vector<std::pair<double, std::size_t>> order(points.size());
  sim::in_parts(points.size(), 1, 0,
                [&](std::size_t i, std::size_t) { order[i] = {search.squares(points[i]), i}; });
  std::ranges::sort(order);
  std::vector<Eigen::VectorXd> best;
  for (const auto& [squares, i] : order)
    if (std::isfinite(squares) && best.size() < wanted) best.push_back(points[i]);
  return best;
}

/// The best starts; where elements of a law begin in several ways, the best start of each way, best first.
std::vector<Eigen::VectorXd> best_starts(const std::vector<Eigen::VectorXd>& points, const WeightedSearch& search,
                                         const SearchOptions& options) {
  if (options.elements.empty()) return best_of(points, search, options.most_starts);
  std::map<std::size_t, std::vector<Eigen::VectorXd>> ways;
  for (std::size_t i = 0; i < points.size(); ++i)
    ways[options.elements.front().kind(static_cast<int>(i))].push_back(points[i]);
  if (ways.size() < 2) return best_of(points, search, options.most_starts);
  std::vector<Eigen::VectorXd> best;
  for (const auto& [kind, starts] : ways) std::ranges::move(best_of(starts, search, 1), std::back_inserter(best));
  return best_of(best, search, best.size());
}

/// Tolerance of the first steps, which only choose among several searches.
constexpr double rough = 1e-3;

void take_better(LeastSquaresFit found, const WeightedSearch& search, const FitProblem& problem,
                 std::optional<LeastSquaresFit>& best) {
  found.sum_of_squares = search.squares(found);
  if (!std::isfinite(found.sum_of_squares) || found.jacobian.rows() != problem.readings().size()) return;
  if (!best || found.sum_of_squares < best->sum_of_squares) best = std::move(found);
}

/// Whether two searches came to the same minimum: by their sums of squares, and by the change of the readings
/// between them.
bool is_same_place(const LeastSquaresFit& a, const LeastSquaresFit& b, double alike = 0.01) {
  const double between = (b.jacobian * (a.parameters - b.parameters)).squaredNorm();
  return std::abs(a.sum_of_squares / b.sum_of_squares - 1.0) < alike && between < alike * b.sum_of_squares;
}

/// The best of these points for `part`, after a few steps of a search; of those at one place the first, and none
/// that is far worse than another one. No more of them are tried when the problem has spent `most`.
std::vector<Eigen::VectorXd> improved(std::vector<Eigen::VectorXd> points, std::size_t wanted,
                                      const FitProblem& part, const SearchOptions& options,
                                      long most = std::numeric_limits<long>::max()) {
  constexpr int few = 8;
  constexpr double far_worse = 100.0;
  const WeightedSearch search(part, options);
  if (points.size() > wanted) points = best_of(points, search, wanted);
  double least = infinity;
  std::vector<LeastSquaresFit> ends;
  for (const Eigen::VectorXd& q : points) {
    if (part.spent() > most) break;
    LeastSquaresFit end = search.improve(q, rough, few);
    const auto is_there = [&](const LeastSquaresFit& other) { return is_same_place(other, end); };
    const bool has_motion = end.jacobian.rows() == part.readings().size();
    if (!has_motion || std::ranges::any_of(ends, is_there)) continue;
    least = std::min(least, end.sum_of_squares);
    ends.push_back(std::move(end));
  }
  points.clear();
  for (LeastSquaresFit& end : ends)
    if (!(end.sum_of_squares > far_worse * least)) points.push_back(std::move(end.parameters));
  return points;
}

/// Searches with all readings from the best of these points.
std::optional<LeastSquaresFit> search_whole(const std::vector<Eigen::VectorXd>& points,
                                            const WeightedSearch& search, const FitProblem& problem) {
  constexpr int some = 16;
  std::optional<LeastSquaresFit> best;
  for (const Eigen::VectorXd& q : best_of(points, search, 1))
    take_better(search.improve(q, rough, some), search, problem, best);
  return best;
}

/// Searches with models tied to the measured motions, with a weaker tie in each round.
std::optional<LeastSquaresFit> search_tied(std::vector<Eigen::VectorXd> points, const WeightedSearch& search,
                                           const FitProblem& problem, const SearchOptions& options) {
  std::size_t wanted = 4;
  for (const double strength : {1.0, 0.1, 0.01}) {
    const std::optional<FitProblem> tied = problem.tied(strength);
    if (!tied) return std::nullopt;
    points = improved(std::move(points), wanted, *tied, options);
    wanted = wanted / 2 + wanted % 2;
  }
  return search_whole(points, search, problem);
}

/// Searches from these points with the first share of each motion, which is doubled in each round.
std::optional<LeastSquaresFit> search_growing(std::vector<Eigen::VectorXd> points, double first,
                                              const WeightedSearch& search, const FitProblem& problem,
                                              const SearchOptions& options) {
  for (double share = first; share < 1.0; share *= 2.0) {
    const std::optional<FitProblem> part = problem.first_part(share);
    if (!part) return std::nullopt;
    points = improved(std::move(points), 2, *part, options);
  }
  return search_whole(points, search, problem);
}

/// Steady states near the end of searches from the best of these points with their motion held as it was measured;
/// nothing without steady states.
std::vector<Eigen::VectorXd> balanced_starts(const std::vector<Eigen::VectorXd>& points, std::size_t tried,
                                             const FitProblem& problem, const SearchOptions& options) {
  constexpr std::size_t wanted = 1;
  constexpr long most_work = 10'000'000;  // seconds; a law without a memory takes a fortieth for 40 points
  const std::optional<FitProblem> balanced = problem.balanced();
  if (!balanced) return {};
  return best_of(improved(points, tried, *balanced, options, problem.spent() + most_work),
                 WeightedSearch(*balanced, options), wanted);
}

/// Whether steady states at `q` are far from the measured amplitudes.
bool is_far_from_states(const FitProblem& problem, const Eigen::VectorXd& q) {
  constexpr double far = 0.02;
  Eigen::VectorXd outputs;
  if (!problem.has_steady_states() || !problem.outputs(q, outputs)) return false;
  const FitReadings& readings = problem.readings();
  const Eigen::VectorXd misses = readings.misses(outputs);
  return std::ranges::any_of(readings.signals(), [&](const SignalRows& rows) {
    return readings.experiment(rows).kind == ExperimentKind::steady_states && readings.signal(rows).name == "x" &&
           readings.rms(misses, rows) > far * readings.rms(readings.measured(), rows);
  });
}

/// Whether the residuals are noise, and no larger than the roughness of each signal. Kinks that are missed may look
/// like noise, but not be as small.
bool is_at_noise(const SearchResult& found, const FitProblem& problem) {
  constexpr double near = 1.3;
  Eigen::VectorXd outputs;
  if (holds_motion(found, problem) || !problem.outputs(found.coordinates, outputs)) return false;
  const FitReadings& readings = problem.readings();
  const Eigen::VectorXd misses = readings.misses(outputs);
  return std::ranges::all_of(readings.signals(), [&](const SignalRows& rows) {
    return readings.rms(misses, rows) <= near * readings.signal(rows).noise;
  });
}

/// Searches with the first parts of the motions. If two of them do not end at the same sum of squares and leave
/// more than noise, or if there are no motions, also searches from several starts with all readings.
std::optional<LeastSquaresFit> search_roughly(const std::vector<Eigen::VectorXd>& points,
                                              const WeightedSearch& search, const FitProblem& problem,
                                              const SearchOptions& options) {
  std::optional<LeastSquaresFit> best;
  const auto ends_alike = [&](std::optional<LeastSquaresFit> found) {
    if (!found) return false;
    constexpr double alike = 0.01;
    const bool agrees = best && std::abs(found->sum_of_squares / best->sum_of_squares - 1.0) < alike;
    take_better(std::move(*found), search, problem, best);
    return agrees;
  };
  ends_alike(search_growing(points, 0.1, search, problem, options));
  if (ends_alike(search_growing(points, 0.35, search, problem, options))) return best;
  if (best && !holds_motion(search.result(*best), problem)) return best;
  std::vector<Eigen::VectorXd> starts = best_starts(points, search, options);
  // Near resonance the amplitude tells more of the damping than of the friction: a start with a friction that does
  // not act may come closer than the one from the energy of the states, from which a search ends at the minimum.
  if (options.scale.friction > 0.0 && std::ranges::find(starts, points.front()) == starts.end() &&
      std::isfinite(search.squares(points.front())))
    starts.push_back(points.front());
  constexpr std::size_t tried = 6;
  std::ranges::move(balanced_starts(points, tried, problem, options), std::back_inserter(starts));
  constexpr int few = 8;
  for (const Eigen::VectorXd& start : starts) {
    take_better(search.improve(start, rough, starts.size() > 1 ? few : 100), search, problem, best);
    // The samples of a loop tell whether anything is left to find.
    if (best && problem.has_loops_only() && is_at_noise(search.result(*best), problem)) break;
  }
  if (best && is_far_from_states(problem, best->parameters))
    for (const Eigen::VectorXd& start : balanced_starts(points, points.size(), problem, options))
      take_better(search.improve(start, rough, few), search, problem, best);
  return best;
}

/// Scans the parameters that act in steps, from the end of another search.
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

/// Continues a search to its end, with weights from the residuals of each signal.
std::optional<LeastSquaresFit> finish(LeastSquaresFit found, WeightedSearch& search, const FitProblem& problem,
                                      bool several_weights) {
  constexpr double fine = 1e-8;
  constexpr int most_rounds = 12;
  constexpr double settled = 1e-3;
  // While the weights still change by a multiple, a minimum by them need not be found to its last digits.
  constexpr double coarse = 1e-5;
  constexpr double large = 0.1;
  double last = several_weights && search.begins_anew() ? core::infinity : 0.0;
  for (int round = 0; round < most_rounds; ++round) {
    Eigen::VectorXd outputs;
    LeastSquaresFit next = search.improve(found.parameters, last > large ? coarse : fine, 100);
    if (next.jacobian.rows() == problem.readings().size() && next.jacobian.allFinite()) found = std::move(next);
    if (!problem.outputs(found.parameters, outputs)) return std::nullopt;
    const double change = search.reweight(outputs, found.jacobian);
    if (!several_weights || (change < settled && last <= large)) break;
    last = change;
  }
  return found;
}

bool has_several_weights(const FitProblem& problem, const SearchOptions& options) {
  return options.robust || problem.readings().signals().size() > 1;
}

/// The first steps need only find the region of the minimum.
constexpr Accuracy of_first_steps{.tolerance = 1e-7, .step = 1e-3, .is_one_sided = true};

/// Whether a sum of squares is less than another one by more than chance between places of one valley.
bool is_clearly_less(double squares, double than, const FitProblem& problem) {
  constexpr double enough = 4.0;  // variances
  return squares < than - enough * than / std::max(1.0, problem.readings().count());
}

/// Searches from places far from the end of another one, along each parameter that is open there. Nothing, unless
/// one of them ends clearly lower. When the problem has spent `most`, only a place that is clearly lower already is
/// searched from.
std::optional<LeastSquaresFit> search_far(const SearchResult& from, const std::vector<FitParameter>& parameters,
                                          const WeightedSearch& search, const FitProblem& problem,
                                          const SearchOptions& options, long most) {
  constexpr int few = 4;
  constexpr int some = 16;
  LeastSquaresFit end = search.improve(from.coordinates, rough, some);
  end.sum_of_squares = search.squares(end);
  if (end.jacobian.rows() != problem.readings().size() || !std::isfinite(end.sum_of_squares)) return std::nullopt;
  const auto fit_held = [&](const FitProblem& held, const std::vector<Eigen::VectorXd>& points) -> SearchPlace {
    const std::vector<Eigen::VectorXd> first = best_of(points, search, 1);
    if (first.empty() || problem.spent() > most) return {points.front(), infinity};
    const Eigen::VectorXd there = WeightedSearch(held, options).improve(first.front(), rough, few).parameters;
    return {there, search.squares(there)};
  };
  std::optional<LeastSquaresFit> best = end;
  for (const std::size_t i :
       open_parameters(problem, parameters, {{end.parameters, end.sum_of_squares}, end.jacobian}))
    for (const SearchPlace& place : far_starts(problem, parameters, i, best->parameters, options.scale, fit_held))
      if (problem.spent() <= most || is_clearly_less(place.squares, best->sum_of_squares, problem))
        take_better(search.improve(place.q, rough, some), search, problem, best);
  if (!is_clearly_less(best->sum_of_squares, end.sum_of_squares, problem)) return std::nullopt;
  return best;
}

/// Searches that were ended, with weights from the residuals, and the best of them.
class EndedSearches {
 public:
  EndedSearches(const FitProblem& problem, const SearchOptions& options,
                std::optional<SearchResult> best = std::nullopt)
      : problem_(problem),
        options_(options),
        several_weights_(has_several_weights(problem, options)),
        alike_(problem, options),
        best_(std::move(best)) {}

  [[nodiscard]] const std::optional<SearchResult>& best() const { return best_; }
  [[nodiscard]] bool is_cut_short() const { return problem_.is_exhausted() || (best_ && best_->is_cut_short); }
  [[nodiscard]] bool is_at_end() const { return is_cut_short() || (best_ && !holds_motion(*best_, problem_)); }

  [[nodiscard]] std::optional<SearchResult> result() {
    if (best_ && problem_.is_exhausted()) best_->is_cut_short = true;
    return std::move(best_);
  }

  /// Ends another search. Returns whether it is the best one.
  bool take(const std::optional<LeastSquaresFit>& found) {
    // With several weights the end of a search takes most of its time. With one, it tells closer places apart.
    const double alike = several_weights_ ? 0.01 : rough;
    if (!found || std::ranges::any_of(
                      ended_, [&](const LeastSquaresFit& other) { return is_same_place(*found, other, alike); }))
      return false;
    ended_.push_back(*found);
    std::optional<SearchResult> result;
    if (!problem_.is_exhausted()) result = end(*found);
    const bool is_cut = problem_.is_exhausted();
    if (is_cut && !best_) {
      // The first place that was found is finished, with as much work again.
      problem_.extend(1.0);
      result = end(*found);
    }
    const bool is_best =
        result && (!best_ || alike_.squares(result->coordinates) < alike_.squares(best_->coordinates));
    if (is_best) best_ = std::move(result);
    if (best_) best_->is_cut_short = is_cut;
    return is_best;
  }

  /// Ends searches that begin far from the best one, until none of them is better.
  void take_far(const std::vector<FitParameter>& parameters, const WeightedSearch& rough_search,
                const FitProblem& rough_problem) {
    constexpr int most_rounds = 4;
    const long most = 3 * rough_problem.spent();
    for (int round = 1; best_ && !is_cut_short(); ++round) {
      const double before = alike_.squares(best_->coordinates);
      const bool is_better = take(search_far(*best_, parameters, rough_search, rough_problem, options_, most)) &&
                             is_clearly_less(alike_.squares(best_->coordinates), before, problem_);
      if (is_better && round < most_rounds) continue;
      // Where a far start was better, and no work is left for others, another one may be better still.
      best_->is_settled = !is_better && (round == 1 || rough_problem.spent() <= most);
      return;
    }
  }

 private:
  [[nodiscard]] std::optional<SearchResult> end(const LeastSquaresFit& found) const {
    WeightedSearch search(problem_, options_);
    const std::optional<LeastSquaresFit> ended =
        finish(scan(found, search, problem_), search, problem_, several_weights_);
    return ended ? std::optional(search.result(*ended)) : std::nullopt;
  }

  const FitProblem& problem_;
  const SearchOptions& options_;
  bool several_weights_;
  WeightedSearch alike_;  ///< compares ended searches with equal weights
  std::optional<SearchResult> best_;
  std::vector<LeastSquaresFit> ended_;  ///< before their weights were found
};

}  // namespace

bool holds_motion(const SearchResult& found, const FitProblem& problem, std::optional<std::size_t> record) {
  Eigen::VectorXd outputs;
  if (!problem.outputs(found.coordinates, outputs)) return false;
  const Eigen::VectorXd misses = problem.readings().misses(outputs);
  const auto parameters = static_cast<double>(found.coordinates.size());
  return std::ranges::any_of(problem.readings().signals(), [&](const SignalRows& rows) {
    if (record && rows.experiment != *record) return false;
    const Eigen::Index size = rows.size();
    const Eigen::VectorXd part =
        bounded_residuals(misses.segment(rows.begin, size), found.weights.segment(rows.begin, size));
    return !is_noise(noise_p_value(problem.readings().signal(rows), part, parameters));
  });
}

std::optional<SearchResult> search_near(const FitProblem& problem, const std::vector<Eigen::VectorXd>& points,
                                        const SearchOptions& options) {
  constexpr int some = 16;
  const FitProblem rough_problem = problem.roughly(of_first_steps);
  const WeightedSearch rough_search(rough_problem, options);
  std::optional<LeastSquaresFit> best;
  for (const Eigen::VectorXd& q : points)
    take_better(rough_search.improve(q, rough, some), rough_search, rough_problem, best);
  if (!best) return std::nullopt;
  return search_from(problem, scan(std::move(*best), rough_search, rough_problem).parameters, options);
}

std::optional<SearchResult> search_from(const FitProblem& problem, const Eigen::VectorXd& coordinates,
                                        const SearchOptions& options) {
  WeightedSearch search(problem, options);
  LeastSquaresFit start;
  start.parameters = coordinates;
  const std::optional<LeastSquaresFit> found =
      finish(std::move(start), search, problem, has_several_weights(problem, options));
  return found ? std::optional(search.result(*found)) : std::nullopt;
}

std::optional<SearchResult> search_parameters(const FitProblem& problem,
                                              const std::vector<FitParameter>& parameters,
                                              const std::vector<double>& sizes, const SearchOptions& options) {
  const FitProblem rough_problem = problem.roughly(of_first_steps);
  const std::vector<Eigen::VectorXd> points = parameters.empty()
                                                  ? std::vector<Eigen::VectorXd>{Eigen::VectorXd(0)}
                                                  : start_points(rough_problem, parameters, sizes, options);
  const WeightedSearch rough_search(rough_problem, options);
  EndedSearches ended(problem, options);
  ended.take(search_roughly(points, rough_search, rough_problem, options));
  // From a distant start, as for a mass without a stated value, the first parts need more steps.
  if (ended.best() && !ended.is_at_end())
    ended.take(search_growing({ended.best()->coordinates}, 0.1, rough_search, rough_problem, options));
  // Both searches may end in the same false minimum. Tied models approach the minimum on another way; they cost
  // most of the time of a fit.
  if (!ended.is_at_end()) ended.take(search_tied(points, rough_search, rough_problem, options));
  return ended.result();
}

SearchResult search_far_from(SearchResult found, const FitProblem& problem,
                             const std::vector<FitParameter>& parameters, const SearchOptions& options) {
  const FitProblem rough_problem = problem.roughly(of_first_steps);
  const WeightedSearch rough_search(rough_problem, options);
  SearchResult before = found;
  EndedSearches ended(problem, options, std::move(found));
  ended.take_far(parameters, rough_search, rough_problem);
  return ended.result().value_or(std::move(before));
}

}  // namespace dualdamp::identify
