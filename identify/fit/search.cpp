#include "identify/fit/search.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/constants.hpp"
#include "identify/experiments/starts.hpp"
#include "identify/fit/freedom.hpp"
#include "identify/fit/residual_test.hpp"
#include "identify/fit/steps.hpp"
#include "identify/statistics/huber.hpp"
#include "identify/statistics/least_squares.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::identify {

namespace {

using core::infinity;

/// The weights of the readings, and searches with them.
class Search {
 public:
  Search(const FitProblem& problem, const SearchOptions& options)
      : problem_(problem), options_(options), weights_(Eigen::VectorXd::Ones(problem.rows())) {
    deviations_ = options.deviations;
    if (deviations_.size() != problem.signals().size()) {
      deviations_.clear();
      for (const SignalRows& rows : problem.signals()) deviations_.push_back(first_deviation(rows));
    }
    spread();
  }

  [[nodiscard]] SearchResult result(const LeastSquaresFit& found) const {
    return {found.parameters, weights_, unbounded_, deviations_};
  }

  /// Whether the weights are only guessed yet.
  [[nodiscard]] bool begins_anew() const { return options_.deviations.empty(); }

  /// Weighted sum of squares, or Huber's sum of a robust search; infinite if there is no motion. For weights that
  /// are not yet bounded.
  [[nodiscard]] double squares(const Eigen::VectorXd& q) const {
    Eigen::VectorXd outputs;
    if (!problem_.outputs(q, outputs)) return infinity;
    const Eigen::VectorXd sizes = problem_.misses(outputs).cwiseProduct(weights_);
    const double sum = options_.robust ? huber_sum(sizes) : sizes.squaredNorm();
    return std::isfinite(sum) ? sum : infinity;
  }

  /// `squares` at the end of a search.
  [[nodiscard]] double squares(const LeastSquaresFit& found) const {
    return options_.robust ? squares(found.parameters) : found.sum_of_squares;
  }

  [[nodiscard]] LeastSquaresFit improve(const Eigen::VectorXd& start, double tolerance, int most_iterations) const {
    LeastSquaresProblem least;
    least.residuals = problem_.rows();
    least.start = start;
    least.low.resize(start.size());
    least.high.resize(start.size());
    for (Eigen::Index i = 0; i < start.size(); ++i) {
      least.low[i] = problem_.coordinates()[static_cast<std::size_t>(i)].low;
      least.high[i] = problem_.coordinates()[static_cast<std::size_t>(i)].high;
    }
    least.tolerance = tolerance;
    least.most_iterations = most_iterations;
    least.slopes_along_steps = true;
    Last last;
    least.evaluate = [&](const Eigen::VectorXd& q, Eigen::VectorXd& residuals, Eigen::MatrixXd* jacobian) {
      if (!evaluate(q, jacobian != nullptr, last)) return false;
      residuals = problem_.misses(last.outputs).cwiseProduct(weights_);
      if (jacobian != nullptr) *jacobian = weights_.asDiagonal() * last.jacobian;
      return true;
    };
    return fit(least);
  }

  /// Sets the weights from the residuals of a fit. `rows_of_fit`: weighted derivatives there. Returns the largest
  /// relative change of a deviation, or of a weight: those of outliers change also where the noise is stated.
  double reweight(const Eigen::VectorXd& outputs, const Eigen::MatrixXd& rows_of_fit) {
    const Eigen::VectorXd misses = problem_.misses(outputs);
    const std::vector<double> freedoms = freedoms_of(problem_, rows_of_fit);
    const Eigen::VectorXd before = weights_;
    double change = 0.0;
    for (std::size_t s = 0; s < deviations_.size(); ++s) {
      const SignalRows& rows = problem_.signals()[s];
      const double count = problem_.count(rows);
      if (problem_.signal(rows).is_stated || freedoms[s] < least_freedom) continue;
      const double found = options_.robust ? robust_deviation(problem_.counted(misses, rows), freedoms[s]).deviation
                                           : problem_.rms(misses, rows) * std::sqrt(count / freedoms[s]);
      if (!(found > 0.0)) continue;
      change = std::max(change, std::abs(std::log(found / deviations_[s])));
      deviations_[s] = found;
    }
    spread();
    if (options_.robust) bound(misses);
    for (Eigen::Index i = 0; i < before.size(); ++i)
      if (weights_[i] > 0.0) change = std::max(change, std::abs(std::log(weights_[i] / before[i])));
    return change;
  }

 private:
  /// The last point of a search; the solver asks for some of them twice.
  struct Last {
    LastMotions last;
    Eigen::VectorXd q;
    Eigen::VectorXd outputs;
    Eigen::MatrixXd jacobian;
    bool is_known = false;
    bool has_jacobian = false;
  };

  [[nodiscard]] bool evaluate(const Eigen::VectorXd& q, bool with_jacobian, Last& last) const {
    const bool is_first = last.q.size() == 0;  // the solver asks for the derivatives next
    const bool is_same = last.is_known && last.q == q;
    if (is_same && (last.has_jacobian || !with_jacobian)) return true;
    with_jacobian = with_jacobian || is_first;
    last.q = q;
    last.is_known = with_jacobian ? problem_.derivatives(q, last.outputs, last.jacobian, true, &last.last)
                                  : problem_.outputs(q, last.outputs, &last.last);
    last.has_jacobian = with_jacobian && last.is_known;
    return last.is_known;
  }

  /// The noise if it is known; else a share of the signal, for the first weights.
  [[nodiscard]] double first_deviation(const SignalRows& rows) const {
    const Signal& signal = problem_.signal(rows);
    if (signal.noise > 0.0) return signal.noise;
    if (signal.unit == "rad") return 0.01;
    const Eigen::VectorXd part = problem_.measured().segment(rows.begin, rows.size());
    const double size = std::sqrt((part.array() - part.mean()).square().mean());
    return size > 0.0 ? 0.01 * size : 1.0;
  }

  void spread() {
    for (std::size_t s = 0; s < deviations_.size(); ++s) {
      const SignalRows& rows = problem_.signals()[s];
      weights_.segment(rows.begin, rows.size()).setConstant(1.0 / deviations_[s]);
    }
    weights_ = weights_.cwiseProduct(problem_.counted());
    unbounded_ = weights_;
  }

  /// Huber's weights: a residual beyond the bound has the influence of one at the bound.
  void bound(const Eigen::VectorXd& misses) {
    for (Eigen::Index i = 0; i < misses.size(); ++i) {
      const double size = std::abs(misses[i]) * weights_[i];
      if (size > huber_bound) weights_[i] *= std::sqrt(huber_bound / size);
    }
  }

  const FitProblem& problem_;
  const SearchOptions& options_;
  std::vector<double> deviations_;  ///< of each signal
  Eigen::VectorXd weights_;
  Eigen::VectorXd unbounded_;
};

std::vector<Eigen::VectorXd> start_points(const FitProblem& problem, const std::vector<FitParameter>& parameters,
                                          const std::vector<double>& sizes, const SearchOptions& options) {
  std::vector<Eigen::VectorXd> points;
  for (int i = 0; i < options.points; ++i)
    points.push_back(problem.coordinates(start_of(parameters, sizes, i, options.scale)));
  return points;
}

/// The points with the smallest sums of squares, best first.
std::vector<Eigen::VectorXd> best_of(const std::vector<Eigen::VectorXd>& points, const Search& search,
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

/// Tolerance of the first steps, which only choose among several searches.
constexpr double rough = 1e-3;

void take_better(LeastSquaresFit found, const Search& search, const FitProblem& problem,
                 std::optional<LeastSquaresFit>& best) {
  found.sum_of_squares = search.squares(found);
  if (!std::isfinite(found.sum_of_squares) || found.jacobian.rows() != problem.rows()) return;
  if (!best || found.sum_of_squares < best->sum_of_squares) best = std::move(found);
}

/// The best of these points for `part`, after a few steps of a search.
std::vector<Eigen::VectorXd> improved(std::vector<Eigen::VectorXd> points, std::size_t wanted,
                                      const FitProblem& part, const SearchOptions& options) {
  constexpr int few = 8;
  const Search search(part, options);
  if (points.size() > wanted) points = best_of(points, search, wanted);
  for (Eigen::VectorXd& q : points) q = search.improve(q, rough, few).parameters;
  return points;
}

/// Searches with all readings from the best of these points.
std::optional<LeastSquaresFit> search_whole(const std::vector<Eigen::VectorXd>& points, const Search& search,
                                            const FitProblem& problem) {
  constexpr int some = 16;
  std::optional<LeastSquaresFit> best;
  for (const Eigen::VectorXd& q : best_of(points, search, 1))
    take_better(search.improve(q, rough, some), search, problem, best);
  return best;
}

/// Searches with models tied to the measured motions, with a weaker tie in each round.
std::optional<LeastSquaresFit> search_tied(std::vector<Eigen::VectorXd> points, const Search& search,
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
                                              const Search& search, const FitProblem& problem,
                                              const SearchOptions& options) {
  for (double share = first; share < 1.0; share *= 2.0) {
    const std::optional<FitProblem> part = problem.first_part(share);
    if (!part) return std::nullopt;
    points = improved(std::move(points), 2, *part, options);
  }
  return search_whole(points, search, problem);
}

/// Steady states near the end of a search with their motion held as it was measured; nothing without steady states.
std::vector<Eigen::VectorXd> balanced_starts(const std::vector<Eigen::VectorXd>& points, const FitProblem& problem,
                                             const SearchOptions& options) {
  constexpr std::size_t tried = 6;
  constexpr std::size_t wanted = 1;
  const std::optional<FitProblem> balanced = problem.balanced();
  if (!balanced) return {};
  return best_of(improved(points, tried, *balanced, options), Search(*balanced, options), wanted);
}

/// Searches with the first parts of the motions. If two of them do not end at the same sum of squares, or if there
/// are no motions, also searches from several starts with all readings.
std::optional<LeastSquaresFit> search_roughly(const std::vector<Eigen::VectorXd>& points, const Search& search,
                                              const FitProblem& problem, const SearchOptions& options) {
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
  std::vector<Eigen::VectorXd> starts = best_of(points, search, options.most_starts);
  // Near resonance the amplitude tells more of the damping than of the friction: a start with a friction that does
  // not act may come closer than the one from the energy of the states, from which a search ends at the minimum.
  if (options.scale.friction > 0.0 && std::ranges::find(starts, points.front()) == starts.end() &&
      std::isfinite(search.squares(points.front())))
    starts.push_back(points.front());
  std::ranges::move(balanced_starts(points, problem, options), std::back_inserter(starts));
  constexpr int few = 8;
  for (const Eigen::VectorXd& start : starts)
    take_better(search.improve(start, rough, starts.size() > 1 ? few : 100), search, problem, best);
  return best;
}

/// Scans the parameters that act in steps, from the end of another search.
LeastSquaresFit scan(LeastSquaresFit from, const Search& search, const FitProblem& problem) {
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
std::optional<LeastSquaresFit> finish(LeastSquaresFit found, Search& search, const FitProblem& problem,
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
    if (next.jacobian.rows() == problem.rows() && next.jacobian.allFinite()) found = std::move(next);
    if (!problem.outputs(found.parameters, outputs)) return std::nullopt;
    const double change = search.reweight(outputs, found.jacobian);
    if (!several_weights || (change < settled && last <= large)) break;
    last = change;
  }
  return found;
}

/// Whether two searches came to the same minimum: by their sums of squares, and by the change of the readings
/// between them.
bool is_same_place(const LeastSquaresFit& a, const LeastSquaresFit& b) {
  constexpr double alike = 0.01;
  const double between = (b.jacobian * (a.parameters - b.parameters)).squaredNorm();
  return std::abs(a.sum_of_squares / b.sum_of_squares - 1.0) < alike && between < alike * b.sum_of_squares;
}

bool has_several_weights(const FitProblem& problem, const SearchOptions& options) {
  return options.robust || problem.signals().size() > 1;
}

/// The first steps need only find the region of the minimum.
constexpr Accuracy of_first_steps{.tolerance = 1e-7, .step = 1e-3};

}  // namespace

bool holds_motion(const SearchResult& found, const FitProblem& problem, std::optional<std::size_t> record) {
  Eigen::VectorXd outputs;
  if (!problem.outputs(found.coordinates, outputs)) return false;
  const Eigen::VectorXd misses = problem.misses(outputs);
  const auto parameters = static_cast<double>(found.coordinates.size());
  return std::ranges::any_of(problem.signals(), [&](const SignalRows& rows) {
    if (record && rows.experiment != *record) return false;
    const Eigen::Index size = rows.size();
    const Eigen::VectorXd part =
        bounded_residuals(misses.segment(rows.begin, size), found.weights.segment(rows.begin, size));
    return !is_noise(noise_p_value(problem.signal(rows), part, parameters));
  });
}

std::optional<SearchResult> search_near(const FitProblem& problem, const std::vector<Eigen::VectorXd>& points,
                                        const SearchOptions& options) {
  constexpr int some = 16;
  const FitProblem rough_problem = problem.roughly(of_first_steps);
  const Search rough_search(rough_problem, options);
  std::optional<LeastSquaresFit> best;
  for (const Eigen::VectorXd& q : points)
    take_better(rough_search.improve(q, rough, some), rough_search, rough_problem, best);
  if (!best) return std::nullopt;
  return search_from(problem, scan(std::move(*best), rough_search, rough_problem).parameters, options);
}

std::optional<SearchResult> search_from(const FitProblem& problem, const Eigen::VectorXd& coordinates,
                                        const SearchOptions& options) {
  Search search(problem, options);
  LeastSquaresFit start;
  start.parameters = coordinates;
  const std::optional<LeastSquaresFit> found =
      finish(std::move(start), search, problem, has_several_weights(problem, options));
  return found ? std::optional(search.result(*found)) : std::nullopt;
}

std::optional<SearchResult> search_parameters(const FitProblem& problem,
                                              const std::vector<FitParameter>& parameters,
                                              const std::vector<double>& sizes, const SearchOptions& options) {
  const std::vector<Eigen::VectorXd> points = parameters.empty()
                                                  ? std::vector<Eigen::VectorXd>{Eigen::VectorXd(0)}
                                                  : start_points(problem, parameters, sizes, options);
  const FitProblem rough_problem = problem.roughly(of_first_steps);
  const Search rough_search(rough_problem, options);
  const bool several_weights = has_several_weights(problem, options);
  const Search alike(problem, options);  // compares ended searches with equal weights
  std::optional<SearchResult> best;
  std::vector<LeastSquaresFit> ended;  // before their weights were found
  const auto take = [&](std::optional<LeastSquaresFit> found) {
    // With several weights the end of a search takes most of its time: the same place is not ended twice.
    if (found && several_weights &&
        std::ranges::any_of(ended, [&](const LeastSquaresFit& other) { return is_same_place(*found, other); }))
      return;
    if (found) ended.push_back(*found);
    if (!found) return;
    const auto end = [&] {
      Search search(problem, options);
      const std::optional<LeastSquaresFit> ended_search =
          finish(scan(*found, search, problem), search, problem, several_weights);
      return ended_search ? std::optional(search.result(*ended_search)) : std::nullopt;
    };
    std::optional<SearchResult> result;
    if (!problem.is_exhausted()) result = end();
    const bool is_cut = problem.is_exhausted();
    if (is_cut && !best) {
      // The first place that was found is finished, with as much work again.
      problem.extend(1.0);
      result = end();
    }
    if (result && (!best || alike.squares(result->coordinates) < alike.squares(best->coordinates)))
      best = std::move(result);
    if (best) best->is_cut_short = is_cut;
  };
  const auto is_cut_short = [&] { return problem.is_exhausted() || (best && best->is_cut_short); };
  const auto is_at_end = [&] { return is_cut_short() || (best && !holds_motion(*best, problem)); };
  take(search_roughly(points, rough_search, rough_problem, options));
  // From a distant start, as for a mass without a stated value, the first parts need more steps.
  if (best && !is_at_end()) take(search_growing({best->coordinates}, 0.1, rough_search, rough_problem, options));
  // Both searches may end in the same false minimum. Tied models approach the minimum on another way; they cost
  // most of the time of a fit.
  if (!is_at_end()) take(search_tied(points, rough_search, rough_problem, options));
  if (best && problem.is_exhausted()) best->is_cut_short = true;
  return best;
}

}  // namespace dualdamp::identify
