#include "identify/fit/search/search.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include "core/constants.hpp"
#include "identify/experiments/starts.hpp"
#include "identify/fit/residual_test.hpp"
#include "identify/fit/search/ended_searches.hpp"
#include "identify/fit/search/far_starts.hpp"
#include "identify/fit/search/linear_starts.hpp"
#include "identify/fit/search/weighted_search.hpp"
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

/// Searches in which one signal after the other decides: of the others, deviations of their own size are taken. A
/// law that is not that of the rig may follow the amplitudes or the phases; with guessed weights the search follows
/// those that it cannot explain.
void take_each_signal(EndedSearches& ended, const std::vector<Eigen::VectorXd>& points, const FitProblem& problem,
                      const SearchOptions& options) {
  constexpr double of_their_size = 100.0;  // times the first deviation
  constexpr int some = 16;
  const std::vector<double> first = WeightedSearch(problem, options).deviations();
  for (std::size_t s = 0; s < first.size(); ++s) {
    SearchOptions of_signal = options;
    of_signal.deviations = first;
    for (std::size_t other = 0; other < first.size(); ++other)
      if (other != s && !problem.readings().signal(problem.readings().signals()[other]).is_stated)
        of_signal.deviations[other] *= of_their_size;
    const WeightedSearch search(problem, of_signal);
    std::optional<LeastSquaresFit> found;
    for (const Eigen::VectorXd& q : best_of(points, search, 2))
      take_better(search.improve(q, rough, some), search, problem, found);
    if (found) ended.take_weighed(*found, of_signal.deviations);
  }
}

/// The first steps need only find the region of the minimum.
constexpr Accuracy of_first_steps{.tolerance = 1e-7, .step = 1e-3, .is_one_sided = true};

/// Searches from places far from the end of another one.
struct FarSearch {
  std::optional<LeastSquaresFit> best;  ///< if one of them ends clearly lower
  std::vector<LeastSquaresFit> ends;    ///< of all of them, and of the other one
};

/// Searches from far places along each parameter that is open at the end of another search. When the problem has
/// spent `most`, only a place that is clearly lower already is searched from.
FarSearch search_far(const SearchResult& from, const std::vector<FitParameter>& parameters,
                     const WeightedSearch& search, const FitProblem& problem, const SearchOptions& options,
                     long most) {
  constexpr int few = 4;
  constexpr int some = 16;
  LeastSquaresFit end = search.improve(from.coordinates, rough, some);
  end.sum_of_squares = search.squares(end);
  if (end.jacobian.rows() != problem.readings().size() || !std::isfinite(end.sum_of_squares)) return {};
  const auto fit_held = [&](const FitProblem& held, const std::vector<Eigen::VectorXd>& points) -> SearchPlace {
    const std::vector<Eigen::VectorXd> first = best_of(points, search, 1);
    if (first.empty() || problem.spent() > most) return {points.front(), infinity};
    const Eigen::VectorXd there = WeightedSearch(held, options).improve(first.front(), rough, few).parameters;
    return {there, search.squares(there)};
  };
  std::optional<LeastSquaresFit> best = end;
  FarSearch all{.ends = {end}};
  for (const std::size_t i :
       open_parameters(problem, parameters, {{end.parameters, end.sum_of_squares}, end.jacobian}))
    for (const SearchPlace& place : far_starts(problem, parameters, i, best->parameters, options.scale, fit_held)) {
      if (problem.spent() > most && !is_clearly_less(place.squares, best->sum_of_squares, problem)) continue;
      std::optional<LeastSquaresFit> found;
      take_better(search.improve(place.q, rough, some), search, problem, found);
      if (!found) continue;
      all.ends.push_back(*found);
      if (found->sum_of_squares < best->sum_of_squares) best = std::move(found);
    }
  if (is_clearly_less(best->sum_of_squares, end.sum_of_squares, problem)) all.best = std::move(best);
  return all;
}

/// Ends searches that begin far from the best one, until none of them is better.
void take_far(EndedSearches& ended, const FitProblem& problem, const std::vector<FitParameter>& parameters,
              const WeightedSearch& rough_search, const FitProblem& rough_problem, const SearchOptions& options) {
  constexpr int most_rounds = 4;
  const long most = 3 * rough_problem.spent();
  for (int round = 1; ended.best() && !ended.is_cut_short(); ++round) {
    const double before = ended.least();
    FarSearch far = search_far(*ended.best(), parameters, rough_search, rough_problem, options, most);
    const bool is_better = ended.take(far.best) && is_clearly_less(ended.least(), before, problem);
    if (is_better && round < most_rounds) continue;
    ended.take_rivals(std::move(far.ends), rough_search, rough_problem);
    // Where a far start was better, and no work is left for others, another one may be better still.
    ended.set_settled(!is_better && (round == 1 || rough_problem.spent() <= most));
    return;
  }
}

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
    return !is_noise(
        noise_p_value(problem.readings().signal(rows), outputs.segment(rows.begin, size), part, parameters));
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
  LeastSquaresFit start;
  start.parameters = coordinates;
  return ended_search(problem, std::move(start), options);
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
  if (guesses_weights(problem) && ended.best() &&
      (!ended.is_at_end() || is_far_from_states(problem, ended.best()->coordinates)))
    take_each_signal(ended, points, rough_problem, options);
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
  take_far(ended, problem, parameters, rough_search, rough_problem, options);
  return ended.result().value_or(std::move(before));
}

}  // namespace dualdamp::identify
