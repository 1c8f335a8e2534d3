#pragma once
/// Estimates: numbers, their uncertainty, and the method's own doubts.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace dualdamp::identify {

/// A value for each reported parameter.
struct ParameterSet {
  double zeta = 0.0;  ///< -
  double c = 0.0;     ///< N.s/m
  double x_f = 0.0;   ///< m
  double F0 = 0.0;    ///< N
};

struct ParameterIntervals {
  std::array<double, 2> zeta{}, c{}, x_f{}, F0{};
};

/// A datum left out and why (for example: it lies in the sticking range).
struct Exclusion {
  int number = 0;  ///< of the datum in the record, from 1
  std::string reason;
};

/// The test of a wider model against the fitted one.
struct LackOfFit {
  std::string test;        ///< "quadratic term F-test"
  double statistic = 0.0;
  double p_value = 1.0;
  bool fired = false;      ///< p_value below the level
  double level = 0.01;
};

/// One fit of a fraction of the data (the paper's lower 4/5, 3/5, 2/5).
struct SubsetFit {
  std::string label;  ///< "5/5", "4/5", ...
  int used = 0;
  ParameterSet value;
};

/// The straight line behind a resonance estimate: x = intercept + slope Y.
struct LineFit {
  double slope = 0.0;
  double intercept = 0.0;  ///< m
  double residual_deviation = 0.0;  ///< m
  double G = 0.0;          ///< parameter function at the estimate
  std::vector<double> residuals;  ///< m, of the used pairs in order
};

struct Estimate {
  std::string method;
  bool usable = false;
  std::string reason;                ///< why it is not usable, or what it rests on
  ParameterSet value;
  std::optional<ParameterSet> std;             ///< standard errors; absent when the data leave no freedom for them
  std::optional<ParameterIntervals> interval95;
  std::optional<Eigen::Matrix2d> covariance;   ///< of (zeta, F0)
  std::optional<double> correlation;           ///< of (zeta, F0)
  std::vector<int> used;                       ///< numbers of the data used
  std::vector<Exclusion> excluded;
  std::optional<LackOfFit> lack_of_fit;
  std::vector<SubsetFit> subsets;
  std::optional<LineFit> line;
  std::vector<std::string> warnings;           ///< each a sentence
};

}  // namespace dualdamp::identify
