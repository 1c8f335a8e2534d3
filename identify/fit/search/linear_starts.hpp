#pragma once
/// Starts of a search in friction loops, with the numbers on which the force depends linearly fitted to it.
///
/// Along a measured path the force is linear in mass, stiffness and damping, in the levels of many laws and in the
/// dampers of others, if the other numbers are given: the speed over which a level falls, the deflection at which a
/// bristle yields. The force of every law is proportional to all its numbers whose unit contains a force, each to
/// that power: forces have no other scale along a given path.
///
///   directions  a number, with those that must not be below it; or all forces of one law together. Those are kept
///               along which the force is linear at a start, alone and together. No law's name is asked
///   fitted      F = F(start) + sum of b_i [F(one step along i) - F(start)], b by least squares. What would leave
///               its range stays where the start has it
///
/// So a start has to be near in the other numbers only, of which most laws have one to three. Stated numbers stay.
///
/// Source: golub1973. Cost: three predictions of the loops for each direction once, and one for each start.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identify/fit/problem.hpp"

namespace dualdamp::identify {

class LinearStarts {
 public:
  /// The directions at the values of one start. None, unless all records are loops. Problem and parameters must
  /// outlive this.
  LinearStarts(const FitProblem& problem, const std::vector<FitParameter>& parameters,
               const Eigen::VectorXd& values);

  /// The values of a start with the least sum of squares along all directions, each loop relative to its force.
  [[nodiscard]] Eigen::VectorXd fitted(const Eigen::VectorXd& values) const;

 private:
  /// Numbers that are changed together.
  struct Direction {
    std::vector<std::size_t> numbers;  ///< the first one gives the length of the step
    bool is_scale = false;             ///< each is multiplied, with the power of the force in its unit
  };

  [[nodiscard]] std::vector<Direction> candidates() const;
  /// Values changed by `steps` along directions; a step of 1 doubles a number, or its distance above another one.
  [[nodiscard]] Eigen::VectorXd moved(const Eigen::VectorXd& values, const std::vector<Direction>& along,
                                      const Eigen::VectorXd& steps) const;
  [[nodiscard]] bool allows(const Eigen::VectorXd& values, const Direction& along) const;
  /// The weighted force at values, at the steps from them; nothing: there is none.
  [[nodiscard]] std::optional<Eigen::VectorXd> force(const Eigen::VectorXd& values) const;

  const FitProblem& problem_;
  const std::vector<FitParameter>& parameters_;
  Eigen::VectorXd weights_;
  std::vector<Direction> directions_;
};

}  // namespace dualdamp::identify
