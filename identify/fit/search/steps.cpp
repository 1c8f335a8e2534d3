#include "identify/fit/search/steps.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/constants.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::identify {

namespace {

using core::infinity;

/// Between two values of a scan of a logarithmic coordinate.
constexpr double apart = 0.144;

/// Predicts the readings with one coordinate changed.
class Along {
 public:
  Along(const FitProblem& problem, Eigen::VectorXd q, Eigen::Index i)
      : problem_(problem), q_(std::move(q)), i_(i) {}

  [[nodiscard]] const SearchCoordinate& coordinate() const { return problem_.space()[i_]; }

  [[nodiscard]] Eigen::VectorXd at(double value) const {
    Eigen::VectorXd there = q_;
    there[i_] = std::clamp(value, coordinate().low, coordinate().high);
    return there;
  }

  /// Nothing: no motion.
  [[nodiscard]] std::optional<Eigen::VectorXd> readings(double value) const {
    Eigen::VectorXd outputs;
    if (!problem_.outputs(at(value), outputs)) return std::nullopt;
    return problem_.readings().misses(outputs);
  }

  [[nodiscard]] bool is_alike(double a, double b) const {
    const std::optional<Eigen::VectorXd> first = readings(a);
    return first && first == readings(b);
  }

  /// Whether a reading changes by more than rounding: of a fall exp(-(v/v_s)^2) that is over before the lowest
  /// speed, the last bits are all that changes.
  [[nodiscard]] bool is_moved(double a, double b) const {
    constexpr double rounding = 1e-6;  // a change of 1e-9 shows no smaller effect than 1e-7
    const std::optional<Eigen::VectorXd> first = readings(a);
    const std::optional<Eigen::VectorXd> second = readings(b);
    const double size = problem_.readings().measured().lpNorm<Eigen::Infinity>();
    return first && (!second || (*second - *first).lpNorm<Eigen::Infinity>() > rounding * size);
  }

 private:
  const FitProblem& problem_;
  Eigen::VectorXd q_;
  Eigen::Index i_;
};

/// Whether the readings change over a factor of two of a parameter, but not near any of some values in between.
bool acts_in_steps(const Along& along, double middle) {
  const SearchCoordinate& c = along.coordinate();
  constexpr double tiny = 1e-9;
  const double factor = std::log(2.0);
  const double start = c.logarithmic ? middle : std::log(std::max(std::abs(middle), 1.0));
  const auto value = [&](double logarithm) { return c.logarithmic ? logarithm : std::exp(logarithm); };
  constexpr int farthest = 20;
  constexpr int between = 4;
  // From the middle outwards: 0, -1, 1, -2 ...
  for (int number = 0; number < farthest; ++number) {
    const int step = number % 2 == 0 ? number / 2 : -(number + 1) / 2;
    const double low = start + factor * step;
    if (value(low) < c.low || value(low + factor) > c.high) continue;
    for (int k = 0; k <= between; ++k) {
      const double there = low + factor * k / between;
      if (!along.is_alike(value(there), value(there + tiny))) return false;
    }
    if (along.is_moved(value(low), value(low + factor))) return true;
  }
  return false;
}

/// Values over the range of a coordinate, in their order.
std::vector<double> values_over(const SearchCoordinate& c, double now) {
  std::vector<double> values = {now};
  if (c.logarithmic) {
    for (double value = c.low; value <= c.high; value += apart) values.push_back(value);
  } else {
    constexpr double least = 1e-2;
    constexpr double most = 1e5;
    values.push_back(0.0);
    for (double size = least; size <= most; size *= std::exp(2.0 * apart)) {
      values.push_back(size);
      values.push_back(-size);
    }
    std::erase_if(values, [&c](double value) { return value < c.low || value > c.high; });
  }
  std::ranges::sort(values);
  return values;
}

class Scan {
 public:
  Scan(const FitProblem& problem, SearchPlace from, Eigen::Index i, const FitOthers& fit_others)
      : along_(problem, from.q, i), i_(i), fit_others_(fit_others), best_(std::move(from)) {}

  [[nodiscard]] SearchPlace run() {
    const std::vector<double> values = distinct(values_over(along_.coordinate(), best_.q[i_]));
    const std::vector<SearchPlace> places = fitted(values);
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t k = 0; k < places.size(); ++k) order.emplace_back(places[k].squares, k);
    std::ranges::sort(order);
    constexpr std::size_t wanted = 3;
    if (order.size() > wanted) order.resize(wanted);
    double distance = 0.0;
    for (const auto& [squares, k] : order) {
      if (!std::isfinite(squares)) continue;
      const double left = k > 0 ? values[k] - values[k - 1] : 0.0;
      const double right = k + 1 < values.size() ? values[k + 1] - values[k] : 0.0;
      const SearchPlace near = nearer(places[k], std::max(left, right));
      if (!(near.squares < best_.squares)) continue;
      best_ = near;
      distance = std::max(left, right) / zoom;
    }
    constexpr int most_rounds = 14;
    for (int round = 0; round < most_rounds && distance > 0.0 && !is_on_one_step(distance); ++round) {
      best_ = nearer(best_, distance);
      distance /= zoom;
    }
    return to_middle(distance);
  }

 private:
  static constexpr int zoom = 4;

  /// One value of each run of values with the same readings.
  [[nodiscard]] std::vector<double> distinct(const std::vector<double>& values) const {
    std::vector<std::optional<Eigen::VectorXd>> readings(values.size());
    sim::in_parts(values.size(), 1, 0,
                  [&](std::size_t k, std::size_t) { readings[k] = along_.readings(values[k]); });
    std::vector<double> kept;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (readings[k] && (k == 0 || readings[k] != readings[k - 1])) kept.push_back(values[k]);
    return kept;
  }

  [[nodiscard]] std::vector<SearchPlace> fitted(const std::vector<double>& values) const {
    std::vector<SearchPlace> places(values.size());
    sim::in_parts(values.size(), 1, 0,
                  [&](std::size_t k, std::size_t) { places[k] = fit_others_(along_.at(values[k])); });
    return places;
  }

  /// The best place within a distance of another one.
  [[nodiscard]] SearchPlace nearer(const SearchPlace& middle, double distance) const {
    std::vector<double> values;
    for (int k = -zoom; k <= zoom; ++k)
      if (k != 0) values.push_back(middle.q[i_] + distance * k / zoom);
    SearchPlace best = middle;
    for (const SearchPlace& place : fitted(values))
      if (place.squares < best.squares) best = place;
    return best;
  }

  [[nodiscard]] bool is_on_one_step(double distance) const {
    const double middle = best_.q[i_];
    return along_.is_alike(middle - distance, middle) && along_.is_alike(middle, middle + distance);
  }

  /// How far from the best place, to one side, the readings stay the same.
  [[nodiscard]] double end_of_step(double first, double sign) const {
    const double middle = best_.q[i_];
    const std::optional<Eigen::VectorXd> same = along_.readings(middle);
    const auto is_same = [&](double distance) { return along_.readings(middle + sign * distance) == same; };
    constexpr int most = 24;
    double inner = 0.0;
    double outer = first;
    for (int round = 0; round < most && is_same(outer); ++round) {
      inner = outer;
      outer *= 2.0;
    }
    for (int round = 0; round < most; ++round) {
      const double half = 0.5 * (inner + outer);
      (is_same(half) ? inner : outer) = half;
    }
    return inner;
  }

  [[nodiscard]] SearchPlace to_middle(double distance) const {
    constexpr double least = 1e-8;
    const double first = std::max(distance, least);
    const double above = end_of_step(first, 1.0);
    const double below = end_of_step(first, -1.0);
    const SearchCoordinate& c = along_.coordinate();
    const double high = best_.q[i_] + above;
    const double low = best_.q[i_] - below;
    SearchPlace result = best_;
    // A step without an end, as that of a play beyond the motion, has no middle.
    if (high < c.high && low > c.low) result.q[i_] = 0.5 * (low + high);
    return result;
  }

  Along along_;
  Eigen::Index i_;
  const FitOthers& fit_others_;
  SearchPlace best_;
};

}  // namespace

std::vector<bool> stepped_parameters(const FitProblem& problem, const Eigen::VectorXd& q) {
  std::vector<bool> found(static_cast<std::size_t>(q.size()), false);
  if (!problem.has_loops_only()) return found;
  for (Eigen::Index i = 0; i < q.size(); ++i)
    found[static_cast<std::size_t>(i)] = acts_in_steps(Along(problem, q, i), q[i]);
  return found;
}

SearchPlace scan_steps(const FitProblem& problem, const SearchPlace& from, const FitOthers& fit_others) {
  const std::vector<bool>& stepped = problem.stepped();
  const auto count = std::ranges::count(stepped, true);
  constexpr int several = 2;
  SearchPlace best = from;
  for (int round = 0; round < (count > 1 ? several : 1); ++round)
    for (std::size_t i = 0; i < stepped.size(); ++i)
      if (stepped[i]) best = Scan(problem, best, static_cast<Eigen::Index>(i), fit_others).run();
  return best;
}

}  // namespace dualdamp::identify
