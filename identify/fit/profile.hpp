#pragma once
/// Intervals by profile likelihood: a parameter is held away from its estimate, and the others are fitted again.
///
/// The others are fitted by Gauss-Newton steps with the derivatives at the estimate. If the steps do not converge,
/// as along a bent valley, the derivatives are computed again on the way. An interval ends where the sum of squares
/// has grown by the square of a limit. The sum may also jump over it, when a reading changes its side of an event.

#include <Eigen/Core>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>

#include "identify/fit/fit.hpp"

namespace dualdamp::identify {

class Profiler {
 public:
  /// `rows`, `residuals`: weighted, at the estimate `q`. The arguments must outlive this.
  Profiler(const FitProblem& problem, const Eigen::VectorXd& weights, const Eigen::VectorXd& q,
           const Eigen::MatrixXd& rows, const Eigen::VectorXd& residuals);

  /// Calls `work` for 0 ... count - 1, on all cores.
  static void for_each(Eigen::Index count, const std::function<void(Eigen::Index)>& work);

  /// Values of parameter `i` at both ends; `unknown` if the sum of squares does not grow to the limit. The interval
  /// also ends at the end of the parameter's range. `limit`: of the square root of the growth.
  [[nodiscard]] Interval interval(Eigen::Index i, const FittedParameter& fitted, double limit) const;

  /// Coordinates with a smaller sum of squares than the estimate, if a profile found any: the search had not ended
  /// at the minimum.
  [[nodiscard]] std::optional<Eigen::VectorXd> lower() const {
    return lower_ ? std::optional(lower_->first) : std::nullopt;
  }

 private:
  /// The current place of a profile, and the derivatives there.
  struct Way {
    Eigen::VectorXd q;
    Eigen::VectorXd residuals;
    Eigen::MatrixXd rows;
    Eigen::MatrixXd normal;
    Eigen::VectorXd unit;  ///< of each coordinate; it scales the diagonal of the normal matrix to one
  };
  [[nodiscard]] Way at(const Eigen::VectorXd& q, const Eigen::VectorXd& residuals,
                       const Eigen::MatrixXd& rows) const;
  /// Least squares with parameter `i` held at `value`, by the derivatives of `way`.
  [[nodiscard]] Eigen::VectorXd step(Eigen::Index i, double value, const Way& way) const;
  /// The parameter that `i` must not be below; -1: none.
  [[nodiscard]] Eigen::Index other_of(Eigen::Index i, const Eigen::VectorXd& q) const;
  /// `q` with parameter `i` at `value`. The parameter that it must not be below gives way.
  [[nodiscard]] Eigen::VectorXd placed(Eigen::Index i, double value, const Eigen::VectorXd& q) const;
  /// The square root of the growth of the sum of squares with parameter `i` at `value`. Nothing: no motion.
  [[nodiscard]] std::optional<double> growth(Eigen::Index i, double value, double limit, Way& way) const;
  /// The same by Gauss-Newton steps from `way`.
  [[nodiscard]] std::optional<double> followed(Eigen::Index i, double value, Way& way) const;
  /// The same with the other parameters unchanged.
  [[nodiscard]] std::optional<double> alone(Eigen::Index i, double value, Way& way) const;
  /// Moves `way` to `q` if the sum of squares is smaller there. False: no motion.
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
