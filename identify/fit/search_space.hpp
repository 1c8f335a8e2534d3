#pragma once
/// The coordinates in which a fit seeks its parameters.
///
/// The coordinate of a parameter is its logarithm, if zero is an open end of its range; its distance above another
/// parameter, if it must be at least that one; else its value in units of its size. A force at a speed far from
/// those of the data is sought as the force at a speed of the data (`ForceAtSpeed`).

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "identify/experiments/rig.hpp"

namespace dualdamp::identify {

/// The coordinate of one parameter.
struct SearchCoordinate {
  bool logarithmic = false;
  double size = 1.0;  ///< one unit of the coordinate; a factor e if it is a logarithm
  double low = 0.0;   ///< in coordinates
  double high = 0.0;

  [[nodiscard]] bool is_low_end(double q) const { return q <= low + near_end * std::max(1.0, std::abs(low)); }
  [[nodiscard]] bool is_high_end(double q) const { return q >= high - near_end * std::max(1.0, std::abs(high)); }
  [[nodiscard]] bool is_end(double q) const { return is_low_end(q) || is_high_end(q); }

 private:
  static constexpr double near_end = 1e-6;
};

/// Of each parameter, the absolute value that is stated; 1 if that is zero or unknown.
[[nodiscard]] std::vector<double> sizes_of_stated(const std::vector<FitParameter>& parameters);

class SearchSpace {
 public:
  /// `sizes`: of each parameter, > 0, in its unit. The parameters must outlive this.
  SearchSpace(const std::vector<FitParameter>& parameters, const std::vector<double>& sizes);

  [[nodiscard]] const std::vector<FitParameter>& parameters() const { return parameters_; }
  /// The coordinate of parameter `i`.
  [[nodiscard]] const SearchCoordinate& operator[](std::size_t i) const { return coordinates_[i]; }
  [[nodiscard]] const SearchCoordinate& operator[](Eigen::Index i) const {
    return coordinates_[static_cast<std::size_t>(i)];
  }

  /// The parameter that parameter `i` must not be below.
  [[nodiscard]] const std::optional<std::size_t>& above(Eigen::Index i) const {
    return parameters_[static_cast<std::size_t>(i)].above;
  }

  /// Values of the parameters at a point, in their units.
  [[nodiscard]] Eigen::VectorXd values(const Eigen::VectorXd& q) const;
  /// The point of values. A value beyond a bound is moved to the bound.
  [[nodiscard]] Eigen::VectorXd point(const Eigen::VectorXd& values) const;
  /// The same motion with each phase in [-pi, pi]: a search may end whole turns away. A phase whose range does not
  /// hold the value there stays.
  [[nodiscard]] Eigen::VectorXd within_one_turn(const Eigen::VectorXd& q) const;
  /// d(values)/d(coordinates).
  [[nodiscard]] Eigen::MatrixXd slope(const Eigen::VectorXd& q) const;

 private:
  const std::vector<FitParameter>& parameters_;
  std::vector<SearchCoordinate> coordinates_;
  std::vector<double> units_;  ///< of each parameter, `over_force_sought` at the sizes
};

}  // namespace dualdamp::identify
