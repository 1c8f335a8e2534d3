#pragma once
/// Least squares in x of one friction law through x-Y pairs, by its harmonic balance:
///
///   ((k - m w^2) X)^2 + Phi(w X, X)^2 = (k Y)^2
///
/// in units that make all quantities of order one. The output that solves it is found by Newton's method.
///
/// Errors: no fit if the law has no output for these inputs or if the fit does not converge. Cost: about 1 us a
/// pair, parameter and step.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identify/methods/amplitudes/fundamental_laws.hpp"

namespace dualdamp::identify {

/// One pair with forces over k Y_max, lengths over x_max, speeds over V_max.
struct LawPoint {
  double Y = 0.0;
  double x = 0.0;        ///< less the error of harmonic balance
  double elastic = 0.0;  ///< (k - m w^2) x_max/(k Y_max)
  double speed = 0.0;    ///< w x_max/V_max
};

/// The output that a law gives, and quantities of its equation there.
struct LawOutput {
  double X = 0.0;
  double across = 0.0;  ///< Phi
  double slope = 0.0;   ///< derivative of half the squared balance by the output
  FundamentalLaw::Fundamentals fundamentals;
};

/// sum_j p_j terms_j
[[nodiscard]] double sum_of_terms(const FundamentalLaw& law, const Eigen::VectorXd& p,
                                  const FundamentalLaw::Terms& terms);

/// The last parameter if the law has a shape; otherwise 0.
[[nodiscard]] double shape_of(const FundamentalLaw& law, const Eigen::VectorXd& p);

/// Found by Newton's method from the measured output; nothing if the law has no output.
[[nodiscard]] std::optional<LawOutput> output_of(const FundamentalLaw& law, const Eigen::VectorXd& p,
                                                 const LawPoint& point);

struct LawFit {
  const FundamentalLaw* law = nullptr;
  Eigen::VectorXd p;
  Eigen::VectorXd residuals;
  Eigen::MatrixXd jacobian;

  [[nodiscard]] double squares() const { return residuals.squaredNorm(); }
  [[nodiscard]] double freedom() const { return static_cast<double>(residuals.size() - p.size()); }
};

[[nodiscard]] std::optional<LawFit> fit_law(const FundamentalLaw& law, const std::vector<LawPoint>& points);

}  // namespace dualdamp::identify
