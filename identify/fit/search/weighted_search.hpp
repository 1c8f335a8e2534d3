#pragma once
/// The weights of the readings of a fit, and a search with them.
///
/// A weight is 1/deviation of the signal; where the noise is not stated, the deviation follows from the residuals.
/// In a robust search, a residual beyond Huber's bound has the influence of one at the bound.
///
/// Errors: none; what cannot be predicted has an infinite sum of squares. Cost: that of the motions.

#include <Eigen/Core>
#include <vector>

#include "identify/fit/problem.hpp"
#include "identify/fit/search/search.hpp"
#include "identify/statistics/least_squares.hpp"

namespace dualdamp::identify {

class WeightedSearch {
 public:
  /// The problem and the options must outlive this.
  WeightedSearch(const FitProblem& problem, const SearchOptions& options);

  [[nodiscard]] SearchResult result(const LeastSquaresFit& found) const {
    return {found.parameters, weights_, unbounded_, deviations_};
  }

  /// Of each signal.
  [[nodiscard]] const std::vector<double>& deviations() const { return deviations_; }

  /// Whether the weights are only guessed yet.
  [[nodiscard]] bool begins_anew() const { return options_.deviations.empty(); }

  /// Weighted sum of squares, or Huber's sum of a robust search; infinite if there is no motion. For weights that
  /// are not yet bounded.
  [[nodiscard]] double squares(const Eigen::VectorXd& q) const;

  /// `squares` at the end of a search.
  [[nodiscard]] double squares(const LeastSquaresFit& found) const {
    return options_.robust ? squares(found.parameters) : found.sum_of_squares;
  }

  [[nodiscard]] LeastSquaresFit improve(const Eigen::VectorXd& start, double tolerance, int most_iterations) const;

  /// Sets the weights from the residuals of a fit. `rows_of_fit`: weighted derivatives there. Returns the largest
  /// relative change of a deviation, or of a weight: those of outliers change also where the noise is stated.
  double reweight(const Eigen::VectorXd& outputs, const Eigen::MatrixXd& rows_of_fit);

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

  [[nodiscard]] bool evaluate(const Eigen::VectorXd& q, bool with_jacobian, Last& last) const;
  /// The noise if it is known; else a share of the signal, for the first weights.
  [[nodiscard]] double first_deviation(const SignalRows& rows) const;
  void spread();
  /// Huber's weights: a residual beyond the bound has the influence of one at the bound.
  void bound(const Eigen::VectorXd& misses);

  const FitProblem& problem_;
  const SearchOptions& options_;
  std::vector<double> deviations_;  ///< of each signal
  Eigen::VectorXd weights_;
  Eigen::VectorXd unbounded_;
};

}  // namespace dualdamp::identify
