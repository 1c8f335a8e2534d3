#include "identify/fit/search/linear_starts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "identify/experiments/starts.hpp"
#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

namespace {

bool is_stated(const FitParameter& parameter) { return !std::isnan(parameter.stated); }

/// Owners of numbers that act in other ways than by a force along the path, or not at all on a loop.
bool is_of_rig(const FitParameter& parameter) {
  return parameter.owner == Owner::mass || parameter.owner == Owner::stiffness ||
         parameter.owner == Owner::cubic_stiffness || parameter.owner == Owner::damping;
}

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

LinearStarts::LinearStarts(const FitProblem& problem, const std::vector<FitParameter>& parameters,
                           const Eigen::VectorXd& values)
    : problem_(problem), parameters_(parameters), weights_(problem.readings().counted()) {
  if (!problem.has_loops_only()) return;
  const Eigen::VectorXd& measured = problem.readings().measured();
  for (const SignalRows& rows : problem.readings().signals())
    if (const double size = measured.segment(rows.begin, rows.size()).norm(); size > 0.0)
      weights_.segment(rows.begin, rows.size()) /= size;
  const std::optional<Eigen::VectorXd> from = force(values);
  if (!from) return;
  constexpr double rounding = 1e-4;  // of laws that are integrated roughly
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(from->size());
  for (const Direction& one : candidates()) {
    const auto change = [&](const std::vector<Direction>& along, double step) -> std::optional<Eigen::VectorXd> {
      const Eigen::VectorXd steps = Eigen::VectorXd::Constant(std::ssize(along), step);
      std::optional<Eigen::VectorXd> there = force(moved(values, along, steps));
      if (there) *there -= *from;
      return there;
    };
    std::vector<Direction> together = directions_;
    together.push_back(one);
    constexpr double back = -0.5;
    const auto forth = change({one}, 1.0);
    const auto half_back = change({one}, back);
    const auto all = change(together, 1.0);
    if (!forth || !half_back || !all || !(forth->norm() > 0.0)) continue;
    const double allowed = rounding * forth->norm();
    if ((*half_back - back * *forth).norm() > allowed || (*all - sum - *forth).norm() > allowed) continue;
    sum += *forth;
    directions_ = std::move(together);
  }
}

std::vector<LinearStarts::Direction> LinearStarts::candidates() const {
  std::vector<Direction> all;
  const auto single = [&](std::size_t i) {
    Direction one{{i}};
    for (std::size_t j = 0; j < parameters_.size(); ++j)
      if (parameters_[j].above == i && !is_stated(parameters_[j])) one.numbers.push_back(j);
    return one;
  };
  std::size_t laws = 0;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    if (is_of_rig(parameters_[i]) && !is_stated(parameters_[i])) all.push_back(single(i));
    if (parameters_[i].owner == Owner::law) laws = std::max(laws, parameters_[i].index + 1);
  }
  for (std::size_t law = 0; law < laws; ++law) {
    std::vector<std::size_t> forces;
    bool is_free = true;
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      const FitParameter& parameter = parameters_[i];
      if (parameter.owner != Owner::law || parameter.index != law || power_of_force(parameter.unit) == 0) continue;
      forces.push_back(i);
      is_free = is_free && !is_stated(parameter);
    }
    if (!forces.empty() && is_free) all.push_back({forces, true});
    for (const std::size_t i : forces)
      if (!is_stated(parameters_[i])) all.push_back(single(i));
  }
  return all;
}

Eigen::VectorXd LinearStarts::moved(const Eigen::VectorXd& values, const std::vector<Direction>& along,
                                    const Eigen::VectorXd& steps) const {
  Eigen::VectorXd result = values;
  for (std::size_t k = 0; k < along.size(); ++k)
    if (along[k].is_scale)
      for (const std::size_t i : along[k].numbers)
        result[index(i)] *= std::pow(1.0 + steps[index(k)], power_of_force(parameters_[i].unit));
  for (std::size_t k = 0; k < along.size(); ++k) {
    if (along[k].is_scale) continue;
    const std::size_t first = along[k].numbers.front();
    const std::optional<std::size_t>& base = parameters_[first].above;
    const double length = values[index(first)] - (base ? values[index(*base)] : 0.0);
    for (const std::size_t i : along[k].numbers) result[index(i)] += steps[index(k)] * length;
  }
  return result;
}

bool LinearStarts::allows(const Eigen::VectorXd& values, const Direction& along) const {
  const std::size_t first = along.numbers.front();
  const FitParameter& parameter = parameters_[first];
  const double low = parameter.above ? values[index(*parameter.above)] : parameter.range.low;
  return values[index(first)] > low && values[index(first)] <= parameter.range.high;
}

std::optional<Eigen::VectorXd> LinearStarts::force(const Eigen::VectorXd& values) const {
  Eigen::VectorXd outputs;
  if (!problem_.outputs(problem_.space().point(values), outputs)) return std::nullopt;
  return outputs.cwiseProduct(weights_);
}

Eigen::VectorXd LinearStarts::fitted(const Eigen::VectorXd& values) const {
  const std::optional<Eigen::VectorXd> from = directions_.empty() ? std::nullopt : force(values);
  if (!from) return values;
  std::vector<Direction> along;
  Eigen::MatrixXd columns(from->size(), std::ssize(directions_));
  for (const Direction& one : directions_) {
    const std::optional<Eigen::VectorXd> there = force(moved(values, {one}, Eigen::VectorXd::Ones(1)));
    if (!there || !there->allFinite()) continue;
    columns.col(std::ssize(along)) = *there - *from;
    along.push_back(one);
  }
  const Eigen::VectorXd left = problem_.readings().measured().cwiseProduct(weights_) - *from;
  Eigen::VectorXd result = values;
  while (!along.empty()) {
    const Eigen::VectorXd steps = pivoted_least_squares(columns.leftCols(std::ssize(along)), left);
    result = moved(values, along, steps);
    const auto bad = std::ranges::find_if(along, [&](const Direction& one) { return !allows(result, one); });
    if (bad == along.end()) return result.allFinite() ? result : values;
    const auto at = bad - along.begin();
    for (Eigen::Index k = at; k + 1 < std::ssize(along); ++k) columns.col(k) = columns.col(k + 1).eval();
    along.erase(bad);
  }
  return values;
}

}  // namespace dualdamp::identify
