#include "identify/fit/search/far_starts.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <ranges>
#include <utility>

#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

namespace {

/// Deviations of the coordinates by the derivatives. A coordinate that changes nothing has about `most`.
Eigen::VectorXd deviations_of(const SearchEnd& end, double readings) {
  constexpr double most = 10.0;
  const Eigen::Index count = end.jacobian.cols();
  const double variance = end.place.squares / std::max(1.0, readings - static_cast<double>(count));
  const Eigen::MatrixXd information =
      gram(end.jacobian) + variance / (most * most) * Eigen::MatrixXd::Identity(count, count);
  const Eigen::MatrixXd covariance = DefiniteMatrix(information).inverse();
  return (variance * covariance.diagonal().cwiseMax(0.0)).cwiseSqrt();
}

bool is_speed(const FitParameter& parameter) { return parameter.unit == "m/s"; }

/// Values of a coordinate over the range of its starts.
std::vector<double> values_along(const FitProblem& problem, const FitParameter& parameter, std::size_t number,
                                 const Eigen::VectorXd& from, const DataScale& scale) {
  const SearchCoordinate& c = problem.space()[number];
  std::vector<double> values;
  if (parameter.above) {
    const double base = problem.space().values(from)[static_cast<Eigen::Index>(*parameter.above)];
    constexpr std::array shares = {0.05, 0.1, 0.2, 0.4, 0.8, 1.6};
    for (const double share : shares) values.push_back(share * base / c.size);
  } else {
    constexpr int count = 9;
    const double reach = std::log(spread_of(parameter, scale));
    for (int k = 0; k < count; ++k) values.push_back(reach * ((2.0 * k + 1.0) / count - 1.0));
  }
  for (double& value : values) value = std::clamp(value, c.low, c.high);
  const auto [first, last] = std::ranges::unique(values);
  values.erase(first, last);
  return values;
}

}  // namespace

std::vector<std::size_t> open_parameters(const FitProblem& problem, const std::vector<FitParameter>& parameters,
                                         const SearchEnd& end) {
  if (problem.has_steady_states()) return {};
  constexpr double known = 0.03;
  const Eigen::VectorXd deviations = deviations_of(end, problem.readings().count());
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const FitParameter& parameter = parameters[i];
    const auto at = static_cast<Eigen::Index>(i);
    const bool is_logarithm = problem.space()[i].logarithmic;
    // Along a loop no law comes to rest one half swing earlier or later: the level at rest has no false minima.
    const bool is_missed = (parameter.above && !problem.has_loops_only()) || (is_speed(parameter) && is_logarithm);
    if (parameter.owner != Owner::law || problem.is_stepped(at) || !is_missed) continue;
    if (deviations[at] > known * (is_logarithm ? 1.0 : end.place.q[at])) open.push_back(i);
  }
  std::ranges::stable_sort(open, {}, [&](std::size_t i) { return is_speed(parameters[i]) ? 0 : 1; });
  return open;
}

std::vector<SearchPlace> far_starts(const FitProblem& problem, const std::vector<FitParameter>& parameters,
                                    std::size_t number, const Eigen::VectorXd& from, const DataScale& scale,
                                    const FitHeld& fit_held) {
  const FitProblem held = problem.holding(number);
  const auto at = static_cast<Eigen::Index>(number);
  const auto with = [at](Eigen::VectorXd q, double value) {
    q[at] = value;
    return q;
  };
  const std::vector<double> values = values_along(problem, parameters[number], number, from, scale);
  std::vector<SearchPlace> places;
  const auto follow = [&](const auto& part) {
    std::vector<Eigen::VectorXd> before;
    for (const double value : part) {
      std::vector<Eigen::VectorXd> points = {with(from, value)};
      if (!before.empty()) points.push_back(with(before.back(), value));
      places.push_back(fit_held(held, points));
      if (std::isfinite(places.back().squares)) before.push_back(places.back().q);
    }
  };
  // Outwards from where the search ended.
  const auto middle = std::ranges::lower_bound(values, from[at]);
  follow(std::ranges::subrange(middle, values.end()));
  follow(std::ranges::subrange(std::make_reverse_iterator(middle), values.rend()));
  std::ranges::sort(places, {}, &SearchPlace::squares);
  constexpr std::size_t wanted = 2;
  std::vector<SearchPlace> starts;
  for (SearchPlace& place : places)
    if (std::isfinite(place.squares) && starts.size() < wanted) starts.push_back(std::move(place));
  return starts;
}

}  // namespace dualdamp::identify
