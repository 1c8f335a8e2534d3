#pragma once
/// Estimates: numbers, their uncertainty, and the method's own diagnostics.
///
/// Two questions are separate. `outcome`: is there an estimate? If it is not ok(), the record did not allow one,
/// and `value` has no meaning. `usable`: does anything speak against the estimate? An estimate that is not usable
/// keeps its value, which is reported with the reason. Whether the assumptions hold in this record is decided by
/// the ledger, not by one method (answer/answer.hpp).

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/outcome.hpp"

namespace dualdamp::identify {

/// A value for each reported parameter.
struct ParameterSet {
  double zeta = 0.0;  ///< -
  double c = 0.0;     ///< N.s/m
  double x_f = 0.0;   ///< m
  double F0 = 0.0;    ///< N
};

/// Both ends: low, high.
using Interval = std::array<double, 2>;

struct ParameterIntervals {
  Interval zeta{}, c{}, x_f{}, F0{};
};

/// One of the reported parameters, for loops over all of them.
struct ReportedParameter {
  std::string_view name;
  std::string_view unit;  ///< SI; empty for a pure number
  double ParameterSet::* value;
  Interval ParameterIntervals::* interval;
};

inline constexpr std::array<ReportedParameter, 4> reported_parameters = {
    {{"zeta", "", &ParameterSet::zeta, &ParameterIntervals::zeta},
     {"c", "N.s/m", &ParameterSet::c, &ParameterIntervals::c},
     {"x_f", "m", &ParameterSet::x_f, &ParameterIntervals::x_f},
     {"F0", "N", &ParameterSet::F0, &ParameterIntervals::F0}}};

/// A datum that is left out, and why (for example: the mass sticks).
struct Exclusion {
  int number = 0;  ///< of the datum in the record, from 1
  std::string reason;
};

/// The test of a wider model against the fitted one.
struct LackOfFit {
  std::string test;        ///< "quadratic term F-test"
  double statistic = 0.0;  ///< F with 1 and `freedom` degrees of freedom
  int freedom = 0;
  double p_value = 1.0;
  double effect = 0.0;  ///< rms of the added term over the range of the data
  /// p_value below the level and effect above `least_effect`: with noiseless data even negligible differences are
  /// significant.
  bool fired = false;
  double level = 0.05;
  double least_effect = 5e-4;
};

/// A parameter beyond the four that every estimate reports: a mass, an offset, a contact stiffness, an exponent.
struct FurtherParameter {
  std::string name;
  std::string unit;  ///< SI; empty for a pure number
  double value = 0.0;
  std::optional<double> std;
  std::optional<Interval> interval95;
};

/// One fit of a fraction of the data (the paper's lower 4/5, 3/5, 2/5; windows of four extremes), or of all of them
/// with another setting of the method.
struct SubsetFit {
  std::string label;  ///< "5/5", "4/5", ... or "1-4", "2-5", ...
  int used = 0;
  ParameterSet value;
  std::vector<FurtherParameter> others;
};

/// The straight line behind a resonance estimate: x = intercept + slope Y.
struct LineFit {
  double slope = 0.0;
  double intercept = 0.0;           ///< m
  double residual_deviation = 0.0;  ///< m; 0 when two pairs leave no residual
  double G = 0.0;                   ///< parameter function at the estimate
  std::vector<double> residuals;    ///< m, of the used pairs in order
};

/// The decrement law behind a free-decay estimate: e_i = (-1)^i sign X_i + offset, X_(i+1) = R X_i - x_f (1 + R).
struct DecayFit {
  double R = 0.0;                   ///< decay of one half swing without dry friction
  double first_amplitude = 0.0;     ///< signed: e_0 - offset [m]
  double offset = 0.0;              ///< m
  double residual_deviation = 0.0;  ///< m; 0 when the extremes leave no residual
  std::vector<double> residuals;    ///< m, of the used extremes in order
};

/// One column of a curve.
struct CurveColumn {
  std::string name;
  std::string unit;  ///< SI; empty for a pure number
  std::vector<double> values;
};

/// A curve of the estimate to plot: friction over velocity, a profile of the likelihood.
struct EstimateCurve {
  std::string name;
  std::vector<CurveColumn> columns;  ///< of equal length; the first is the abscissa
};

/// One of the laws that `law_selection` compares.
struct LawCandidate {
  std::string law;  ///< "coulomb_viscous", "viscous_saturating", ...
  std::vector<FurtherParameter> parameters;
  double residual_deviation = 0.0;  ///< m
  double AICc = 0.0;                ///< infinite when the data are too few for it
  double BIC = 0.0;
  double weight = 0.0;  ///< Akaike weight among the candidates
};

struct LawIntervals;  // methods/any_law/law_intervals.hpp

struct Estimate {
  std::string method;
  core::Outcome outcome;  ///< not ok(): why there is no estimate
  /// Nothing speaks against the estimate, apart from the assumptions that the ledger tests (ledger/ledger.hpp).
  bool sound = false;
  std::vector<std::string>
      findings;  ///< results of the method's own tests against its assumptions, each a sentence
  /// The method finds as much in motions of its own law: its findings say nothing against the law.
  bool misreads_its_law = false;
  bool is_of_histories = false;  ///< read from histories by a method that reads steady states too
  // Until concluded() (answer/answer.hpp) the next three are the method's own; then `usable` and `reason` are those
  // of the ledger, and a value that the method did not correct for its bias is corrected.
  bool usable = false;  ///< sound and without findings
  std::string reason;   ///< why it is not usable, or which data it is from
  ParameterSet value;
  std::optional<ParameterSet> std;  ///< standard errors; absent when the data leave no freedom for them
  std::optional<ParameterIntervals> interval95;
  std::optional<Eigen::Matrix2d> covariance;  ///< of (zeta, F0)
  std::optional<double> correlation;          ///< of (zeta, F0)
  std::vector<int> used;                      ///< numbers of the data used
  std::vector<Exclusion> excluded;
  std::optional<LackOfFit> lack_of_fit;
  std::vector<SubsetFit> subsets;
  std::optional<LineFit> line;    ///< resonance methods
  std::optional<DecayFit> decay;  ///< free_decay
  std::vector<FurtherParameter> others;
  std::vector<LawCandidate> candidates;      ///< best first
  std::shared_ptr<const LawIntervals> laws;  ///< any_law
  std::vector<EstimateCurve> curves;
  std::vector<std::string> warnings;  ///< each a sentence
};

}  // namespace dualdamp::identify
