#pragma once
/// Intervals by profile likelihood: a parameter is held away from its estimate, and the others are fitted again.
///
/// The others are fitted by Gauss-Newton steps with the derivatives at the estimate. If the steps do not converge,
/// as along a bent valley, the derivatives are computed again on the way. If they do not help at all, as when a
/// parameter with nearly no effect runs away, they are damped (Levenberg). An interval ends where the sum of
/// squares has grown by the square of a limit. The sum may also jump over it, when a reading changes its side of an
/// event.

#include <Eigen/Core>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "identify/fit/fit.hpp"

namespace dualdamp::identify {

/// Whether an end of the profile differs from the interval by the covariance. `quantile`: of the parameter, in
/// standard errors.
[[nodiscard]] bool bends(const FittedParameter& fitted, double quantile);

class Profiler {
 public:
  /// `rows`, `residuals`: weighted, at the estimate `q`; `motions`: those there. The arguments must outlive this.
  Profiler(const FitProblem& problem, const Eigen::VectorXd& weights, const Eigen::VectorXd& q,
           const Eigen::MatrixXd& rows, const Eigen::VectorXd& residuals, const LastMotions& motions);

  /// Calls `work` for 0 ... count - 1, on all cores.
  static void for_each(Eigen::Index count, const std::function<void(Eigen::Index)>& work);

  /// Values of parameter `i` at both ends; `unknown` if the sum of squares does not grow to the limit. The interval
  /// also ends at the end of the parameter's range. That of a parameter that is sought above another one begins at
  /// the other one if the sum of squares there is below the limit, whatever lies between: a mass that need not rest
  /// has no level at which it breaks away, and rests under a high one. `limit`: of the square root of the growth.
  [[nodiscard]] Interval interval(Eigen::Index i, const FittedParameter& fitted, double limit) const;

  /// Widens the profiles, once all have ended, to the values of their parameters wherever any profile came with a
  /// growth below the limit (0: no profile). A profile that starts beside a bound may not find the valley that
  /// another one finds. Nor does one that starts where another parameter has lost its effect, as the exponent of a
  /// sharp yield: from the places far from there it is searched on.
  void widen(std::vector<FittedParameter>& parameters, const Eigen::VectorXd& limits) const;

  /// Coordinates with a smaller sum of squares than the estimate, if a profile found any: the search had not ended
  /// at the minimum.
  [[nodiscard]] std::optional<Eigen::VectorXd> lower() const;

  /// Whether a profile came so far below the estimate that the profiles are to be made again from there. Those of
  /// the parameters after it have then ended early, and none of them counts.
  [[nodiscard]] bool are_in_vain() const { return is_in_vain(q_.size()); }

 private:
  /// Where the path of a profile is, and the derivatives there.
  struct ProfilePath {
    Eigen::VectorXd q;
    Eigen::VectorXd residuals;
    Eigen::MatrixXd rows;
    Eigen::MatrixXd normal;
    Eigen::VectorXd unit;  ///< of each coordinate; it scales the diagonal of the normal matrix to one
    LastMotions motions;   ///< where the derivatives were computed
  };
  [[nodiscard]] ProfilePath at(const Eigen::VectorXd& q, const Eigen::VectorXd& residuals,
                               const Eigen::MatrixXd& rows, LastMotions motions) const;
  /// Least squares with parameter `i` held at `value`, by the derivatives of `path`. `damping`: a change of
  /// another parameter by as much as itself counts as this share of the present growth.
  [[nodiscard]] Eigen::VectorXd step(Eigen::Index i, double value, const ProfilePath& path, double damping) const;
  /// A parameter whose coordinate also changes the value of `i`, such as one that `i` must not be below; -1: none.
  [[nodiscard]] Eigen::Index other_of(Eigen::Index i, const Eigen::VectorXd& q) const;
  /// `q` with parameter `i` at `value`. The parameter that it must not be below gives way.
  [[nodiscard]] Eigen::VectorXd placed(Eigen::Index i, double value, const Eigen::VectorXd& q) const;
  /// Square root of the growth of the sum of squares with parameter `i` at `value`, the least that is found from
  /// `path`, which moves there. Nothing: no motion. `glances`: the search ends if the first derivatives lead far
  /// beyond the limit.
  [[nodiscard]] std::optional<double> growth(Eigen::Index i, double value, double limit, bool glances,
                                             ProfilePath& path) const;
  /// Square root of the growth with parameter `i` at `value`, the better of two searches: from `others`, which may
  /// lie beyond the limit, and, if that ends beyond it, from `within` the limit.
  [[nodiscard]] std::optional<double> best_growth(Eigen::Index i, double value, double limit,
                                                  const ProfilePath* within, bool glances,
                                                  ProfilePath& others) const;
  /// Square root of the growth with parameter `i` at `value`, by Gauss-Newton steps from `path`, whose growth is
  /// `best`; infinite: parameter `i` is elsewhere. The steps end if the first derivatives lead to more than
  /// `astray`.
  [[nodiscard]] std::optional<double> growth_by_steps(Eigen::Index i, double value, double best, double damping,
                                                      double astray, ProfilePath& path) const;
  /// Square root of the growth with parameter `i` at `value` and all other parameters as they are in `path`.
  [[nodiscard]] std::optional<double> growth_with_others_fixed(Eigen::Index i, double value,
                                                               ProfilePath& path) const;
  /// Moves `path` of parameter `i` to `q` if the sum of squares is smaller there. False: no motion.
  [[nodiscard]] bool take(Eigen::Index i, const Eigen::VectorXd& q, ProfilePath& path, double& best) const;
  void note(Eigen::Index i, const ProfilePath& path, double growth) const;
  /// Whether the profile of parameter `i`, or of one before it, came far below the estimate. That those after it do
  /// not matter makes the result the same on any number of threads.
  [[nodiscard]] bool is_in_vain(Eigen::Index i) const;
  [[nodiscard]] double growth_of(const Eigen::VectorXd& residuals) const;
  /// Whether a parameter that is sought by its logarithm has no effect near the estimate: a factor e of it changes
  /// the readings by less than the limit. Its profile goes outwards by factors, to the end of the search.
  [[nodiscard]] bool acts_faintly(Eigen::Index i, const FittedParameter& fitted, double limit) const;
  /// The first distance of the parameter from its estimate.
  [[nodiscard]] double first_distance(Eigen::Index i, const FittedParameter& fitted, double limit) const;
  /// Where a profile begins: the value of its parameter there, and the growth.
  struct ProfileStart {
    ProfilePath path;
    double value = 0.0;
    double growth = 0.0;
  };
  [[nodiscard]] double end(Eigen::Index i, const FittedParameter& fitted, double limit, double sign,
                           const ProfileStart& start) const;
  /// Of the places of all profiles within the limit at which parameter `weak` is far from its estimate, that with
  /// the largest value of parameter `i`, or the smallest; nothing if there is none.
  [[nodiscard]] std::optional<ProfileStart> away_from(Eigen::Index weak, Eigen::Index i, double limit,
                                                      double sign) const;
  /// Widens the profile of parameter `i` by one that begins away from `weak`.
  void search_on(Eigen::Index weak, Eigen::Index i, double limit, FittedParameter& fitted) const;

  const FitProblem& problem_;
  const Eigen::VectorXd& weights_;
  const Eigen::VectorXd& q_;
  const Eigen::MatrixXd& rows_;
  const Eigen::VectorXd& residuals_;
  const LastMotions& motions_;
  double squares_ = 0.0;
  mutable std::mutex mutex_;
  struct Lower {
    Eigen::VectorXd q;
    double gain = 0.0;  ///< variances of a reading
  };
  mutable std::vector<std::optional<Lower>> lower_;  ///< found by the profile of each parameter
  mutable Eigen::Index first_in_vain_;
  mutable std::vector<std::pair<Eigen::VectorXd, double>> places_;  ///< values, and the growth there
};

}  // namespace dualdamp::identify
