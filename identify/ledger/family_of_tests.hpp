#pragma once
/// The p-values of tests that share one level: how often the largest statistic of all is at least as large as this
/// one, if nothing is wrong. It is simulated with the correlations of the tests (westfall1993) and with weights
/// that share the level out (genovese2006). A record has the same p-values each time, whatever the order of its
/// rows. Cost: 2000 draws.

#include <Eigen/Core>
#include <vector>

namespace dualdamp::identify {

/// Tests of unit columns, with what their p-values depend on.
struct FamilySetting {
  Eigen::MatrixXd unit;     ///< columns of unit length beside the base
  std::vector<int> signs;   ///< that the coefficient of each can have; 0: either
  Eigen::VectorXd weights;  ///< > 0
  double freedom = 0.0;     ///< of the deviation that a statistic is divided by
};

class FamilyOfTests {
 public:
  explicit FamilyOfTests(FamilySetting setting);

  /// Of the test of column j with the statistic t.
  [[nodiscard]] double p_value(Eigen::Index j, double t) const;

 private:
  /// Score by which the tests are compared: twice the gain of the log-likelihood plus twice the log of the weight.
  [[nodiscard]] double score(Eigen::Index j, double t) const;
  /// The |t| that a test needs for a score.
  [[nodiscard]] double t_for(Eigen::Index j, double score) const;
  [[nodiscard]] double largest_score(const Eigen::VectorXd& t) const;
  void draw();

  FamilySetting setting_;
  std::vector<double> largest_;  ///< scores of draws under the base model, ascending
};

/// Variances of residuals, of this sum of squares, beside each of the unit columns.
[[nodiscard]] Eigen::ArrayXd variances_beside(const Eigen::VectorXd& along, double squares, double freedom);

/// p-value of one test alone, for either sign.
[[nodiscard]] double two_sided_p_value(double t, double freedom);

}  // namespace dualdamp::identify
