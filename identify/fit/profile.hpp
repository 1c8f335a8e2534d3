#pragma once
/// Intervals by profile likelihood: a parameter is held off its estimate, and the others take their best values.
///
/// These follow by Gauss and Newton's steps with the derivatives at the estimate; where these do not settle, as
/// along a bent valley, the motion is differentiated anew on the way. The ends lie where the sum of squares has
/// grown by the square of a limit, or jumps over it: a reading may change its side of an event.

#include <Eigen/Core>
#include <array>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>

#include "identify/fit/fit.hpp"

namespace dualdamp::identify {

class Profiler {
 public:
  /// `rows`, `residuals`: weighted, at the estimate `q`. All outlive this.
  Profiler(const FitProblem& problem, const Eigen::VectorXd& weights, const Eigen::VectorXd& q,
           const Eigen::MatrixXd& rows, const Eigen::VectorXd& residuals);

  /// Calls `work` for 0 ... count - 1, on all cores.
  static void for_each(Eigen::Index count, const std::function<void(Eigen::Index)>& work);

  /// Values of parameter `i` at both ends; `unknown` where the sum of squares does not grow that far. The end of
  /// its range ends the interval too. `limit`: of the root of the growth.
  [[nodiscard]] std::array<double, 2> interval(Eigen::Index i, const FittedParameter& fitted, double limit) const;

  /// A place below the estimate that a profile has come by: the search had ended beside the least squares.
  [[nodiscard]] std::optional<Eigen::VectorXd> lower() const {
    return lower_ ? std::optional(lower_->first) : std::nullopt;
  }

 private:
  /// Where the others have gone, and the derivatives they go by.
  struct Way {
    Eigen::VectorXd q;
    Eigen::VectorXd residuals;
    Eigen::MatrixXd rows;
    Eigen::MatrixXd normal;
    Eigen::VectorXd unit;  ///< of each coordinate, which makes the diagonal of the normal matrix one
  };
  [[nodiscard]] Way at(const Eigen::VectorXd& q, const Eigen::VectorXd& residuals,
                       const Eigen::MatrixXd& rows) const;
  /// Least squares with parameter `i` held at `value`, by the derivatives of `way`.
  [[nodiscard]] Eigen::VectorXd step(Eigen::Index i, double value, const Way& way) const;
  /// The root of the growth of the sum of squares where parameter `i` is `value`; nothing where there is no motion.
  [[nodiscard]] std::optional<double> growth(Eigen::Index i, double value, double limit, Way& way) const;
  /// The same by steps of Gauss and Newton from `way`.
  [[nodiscard]] std::optional<double> followed(Eigen::Index i, double value, Way& way) const;
  /// The same with the others where they are.
  [[nodiscard]] std::optional<double> alone(Eigen::Index i, double value, Way& way) const;
  /// Goes to `q` where the sum of squares is smaller there. False: no motion.
  [[nodiscard]] bool take(const Eigen::VectorXd& q, Way& way, double& best) const;
  void note_lower(const Way& way) const;
  [[nodiscard]] double growth_of(const Eigen::VectorXd& residuals) const;
  [[nodiscard]] double end(Eigen::Index i, const FittedParameter& fitted, double limit, double sign) const;

  const FitProblem& problem_;
  const Eigen::VectorXd& weights_;
  const Eigen::VectorXd& q_;
  const Eigen::MatrixXd& rows_;
  const Eigen::VectorXd& residuals_;
  double squares_ = 0.0;
  mutable std::mutex mutex_;
  mutable std::optional<std::pair<Eigen::VectorXd, double>> lower_;
};

}  // namespace dualdamp::identify
