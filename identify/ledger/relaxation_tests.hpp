#pragma once
/// Tests of all relaxations of a record at once, at one family level, and what a departure is charged to.
///
/// The t statistic of a relaxation is that of its coefficient beside the base parameters. Statistics of one record
/// are correlated. Their maximum is therefore simulated under the base model, with these correlations
/// (westfall1993): the p-value of a test is how often the maximum is at least as large. The level is shared out by
/// weights (genovese2006), the standard errors of the changes of zeta or F0 by the departures: a test that measures
/// its departure precisely gets a stricter level and leaves more to the tests that need it. A departure that can
/// have only one sign is tested on that side. If a test rejects, the relaxation that explains most is taken into
/// the model and the others are tested again beside it, until none rejects or four are taken.
///
/// A relaxation that explains nearly as much (log-likelihood within `equal_likelihood` of the best, at equal number
/// of parameters) is named beside it: the record cannot tell them apart. So is one of which next to nothing is left
/// beside it: such relaxations are one departure, and none is tested beside another. Of relaxations that explain
/// the same but for rounding, that of the constant with the larger stated uncertainty comes first, then the first
/// of the model's list.
///
/// If this charges anything but constants and gains, and a constant and gains are stated with their uncertainties,
/// errors of all of them are tried together: each of them alone may explain too little, and a further mode more. If
/// errors that the uncertainties allow leave nothing that a test rejects, they are the departures.
///
/// Far from the fit no single test may reject, because the misfit is in the residuals of all. Where the model
/// misses the record as a whole (misfit.hpp), every relaxation is fitted, and the best is taken if it explains far
/// more. What then is still missed is stated: no relaxation explains it.
///
/// Cost: a few milliseconds beside the projection of the columns.

#include <optional>
#include <vector>

#include "identify/ledger/joint_model.hpp"
#include "identify/ledger/misfit.hpp"

namespace dualdamp::identify {

/// Twice the difference of log-likelihoods: odds of one to ten.
inline constexpr double equal_likelihood = 4.6;

/// One relaxation beside those already taken into the model.
struct RelaxationTest {
  std::size_t index = 0;     ///< in the model's list
  double t = 0.0;            ///< statistic
  double p_value = 1.0;      ///< of the family
  double p_alone = 1.0;      ///< of this test alone
  double explained = 0.0;    ///< twice the gain of the log-likelihood
  double coefficient = 0.0;  ///< of its column, as the linear model has it
  KnownConstants constants;  ///< as the model fitted with it has them; unknown where it was not fitted
  double zeta_change = 0.0;  ///< of the damping ratio when relaxed; of c where there is no spring
  double F0_change = 0.0;    ///< N
  double F0_part = 0.0;      ///< friction force of a part of the record, less the mean [N]
  double zeta_part = 0.0;    ///< damping ratio of a part of the record, less the mean
  double zeta_blind = 0.0;   ///< change by a departure that is missed in one record of five
  double F0_blind = 0.0;
};

/// A departure that the tests found: the relaxation taken into the model and those that explain as much, best
/// first.
struct FoundDeparture {
  std::vector<RelaxationTest> explanations;
};

struct RelaxationTests {
  std::vector<RelaxationTest> tests;  ///< beside all departures; those that can be told from the base parameters
  std::vector<std::size_t> alone;     ///< relaxations that cannot be told from the base parameters
  std::vector<FoundDeparture> departures;  ///< in the order found
  double freedom = 0.0;                    ///< degrees of freedom left
  std::optional<Misfit> misfit;            ///< that is left beside all departures
  std::optional<JointModel> relaxed;  ///< the model linearised with the departures relaxed, where it has such a fit
};

struct TestOptions {
  double least_change = 0.02;  ///< relative change of zeta or F0 that matters
  double mass = 0.0;           ///< stated uncertainty, relative; 0: none
  double stiffness = 0.0;
  bool gains = false;    ///< uncertainties of gains are stated
  double allowed = 0.0;  ///< largest relative error of k/m or of a gain that the stated uncertainties allow
};

[[nodiscard]] RelaxationTests test_relaxations(const JointModel& model, const TestOptions& options = {});

}  // namespace dualdamp::identify
