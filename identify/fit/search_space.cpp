#include "identify/fit/search_space.hpp"

#include "core/angle.hpp"
#include "core/constants.hpp"

namespace dualdamp::identify {

namespace {

/// Largest factor between a parameter with a logarithmic coordinate and its size. A contact a thousand times
/// stiffer than the data could show would need a thousand times the steps.
constexpr double reach = 1e4;
/// Largest value of a parameter in units of its size; plausible values are far below.
constexpr double far = 1e6;

/// A bound, of the law or of the caller, takes the place of these two.
SearchCoordinate coordinate_of(const FitParameter& parameter, double size) {
  const auto& [low, high, low_open, high_open] = parameter.range;
  if (!parameter.above && low >= 0.0 && (low_open || low > 0.0))
    return {true, size, std::log(low > 0.0 ? low / size : 1.0 / reach),
            std::log(std::isfinite(high) ? high / size : reach)};
  if (parameter.above) return {false, size, 0.0, far};
  return {false, size, std::isfinite(low) ? low / size : -far, std::isfinite(high) ? high / size : far};
}

/// A force over the force that is sought in its place; 1 for any other parameter.
double over_force_sought(const FitParameter& parameter, const Eigen::VectorXd& values) {
  return parameter.at_speed && parameter.at_speed->sought_at > 0.0
             ? over_force_at(parameter.at_speed->sought_at, parameter, values)
             : 1.0;
}

/// Whether the motion repeats itself with each turn of a parameter: the phase of the drive, or of a law.
bool is_phase(const FitParameter& parameter) {
  if (parameter.owner != Owner::law) return parameter.owner == Owner::phase;
  return parameter.unit == "rad" && parameter.path.substr(parameter.path.rfind('.') + 1) == "phase";
}

}  // namespace

std::vector<double> sizes_of_stated(const std::vector<FitParameter>& parameters) {
  std::vector<double> sizes;
  for (const FitParameter& parameter : parameters) {
    const double size = std::abs(parameter.stated);
    sizes.push_back(size > 0.0 && std::isfinite(size) ? size : 1.0);
  }
  return sizes;
}

SearchSpace::SearchSpace(const std::vector<FitParameter>& parameters, const std::vector<double>& sizes)
    : parameters_(parameters) {
  for (std::size_t i = 0; i < parameters.size(); ++i)
    coordinates_.push_back(coordinate_of(parameters[i], sizes[i]));
  const Eigen::VectorXd middle =
      Eigen::Map<const Eigen::VectorXd>(sizes.data(), static_cast<Eigen::Index>(sizes.size()));
  for (const FitParameter& parameter : parameters) units_.push_back(over_force_sought(parameter, middle));
}

Eigen::VectorXd SearchSpace::values(const Eigen::VectorXd& q) const {
  Eigen::VectorXd result(q.size());
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    const SearchCoordinate& c = coordinates_[i];
    const auto at = static_cast<Eigen::Index>(i);
    result[at] = c.size * (c.logarithmic ? std::exp(q[at]) : q[at]);
  }
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    if (parameters_[i].above)
      result[static_cast<Eigen::Index>(i)] += result[static_cast<Eigen::Index>(*parameters_[i].above)];
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    result[static_cast<Eigen::Index>(i)] *= over_force_sought(parameters_[i], result) / units_[i];
  return result;
}

Eigen::VectorXd SearchSpace::point(const Eigen::VectorXd& values) const {
  Eigen::VectorXd result(values.size());
  for (std::size_t i = 0; i < coordinates_.size(); ++i) {
    const SearchCoordinate& c = coordinates_[i];
    const auto at = static_cast<Eigen::Index>(i);
    double value = values[at];
    if (parameters_[i].above) value -= values[static_cast<Eigen::Index>(*parameters_[i].above)];
    value *= units_[i] / over_force_sought(parameters_[i], values);
    const double q = c.logarithmic ? std::log(std::max(value, 0.0) / c.size) : value / c.size;
    result[at] = std::clamp(q, c.low, c.high);
  }
  return result;
}

Eigen::VectorXd SearchSpace::within_one_turn(const Eigen::VectorXd& q) const {
  Eigen::VectorXd turned = values(q);
  Eigen::VectorXd result = q;
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const FitParameter& parameter = parameters_[static_cast<std::size_t>(i)];
    const double there = core::wrapped(turned[i]);
    if (!is_phase(parameter) || std::abs(turned[i]) <= 0.5 * core::two_pi || !parameter.range.contains(there))
      continue;
    turned[i] = there;
    result[i] = point(turned)[i];
  }
  return result;
}

Eigen::MatrixXd SearchSpace::slope(const Eigen::VectorXd& q) const {
  const Eigen::Index count = q.size();
  const Eigen::VectorXd at = values(q);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const SearchCoordinate& c = coordinates_[static_cast<std::size_t>(i)];
    result(i, i) = c.size * (c.logarithmic ? std::exp(q[i]) : 1.0);
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const FitParameter& parameter = parameters_[static_cast<std::size_t>(i)];
    const auto add = [&](const std::optional<std::size_t>& other, double by_other) {
      if (!other) return;
      const auto j = static_cast<Eigen::Index>(*other);
      result(i, j) += by_other * result(j, j);
    };
    add(parameter.above, 1.0);
    if (!parameter.at_speed || !(parameter.at_speed->sought_at > 0.0)) continue;
    // value = sought (v0/v)^n
    result(i, i) *= over_force_sought(parameter, at) / units_[static_cast<std::size_t>(i)];
    const auto& [speed, power, sought_at] = *parameter.at_speed;
    add(power.sought, at[i] * std::log(speed.value(at) / sought_at));
    add(speed.sought, at[i] * power.value(at) / speed.value(at));
  }
  return result;
}

}  // namespace dualdamp::identify
