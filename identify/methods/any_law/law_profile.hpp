#pragma once
/// One law over its severity: at each of a few severities the best fit of all else, with its covariance.
///
///   chi2(s) = min over F0, c and the nuisances of sum (reading - prediction)^2/sigma^2 + sum
///   (nuisance/deviation)^2
///
/// Between the severities the values are interpolated, so that the 95 % region of zeta and F0 over all severities
/// is that of the profile likelihood: severity s adds the interval theta(s) +- sqrt((D - chi2(s) + chi2_min) V(s)).

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/methods/any_law/reading_model.hpp"

namespace dualdamp::identify {

/// Standard deviation of each channel of readings, and the degrees of freedom behind it.
struct ChannelNoise {
  std::vector<double> deviations;
  double freedom = 0.0;  ///< infinite where they are known
};

/// The best fit of a law at one severity.
struct SeverityFit {
  double severity = 0.0;
  double chi2 = 0.0;
  Eigen::VectorXd unknowns;
  Eigen::VectorXd residuals;   ///< over their deviations
  Eigen::MatrixXd slopes;      ///< derivatives of the readings over their deviations by the unknowns
  Eigen::MatrixXd covariance;  ///< of the unknowns
};

/// Where a fit begins.
struct LawStart {
  Eigen::VectorXd unknowns;
  Eigen::MatrixXd slopes{};  ///< of a similar law; empty: none are known
  /// Whether derivatives are taken where the fit ends; else they are those that the search has learnt on its way.
  bool own_slopes = true;
};

/// The best fit of a law at one severity from `start` on; nothing where it has no steady states there.
[[nodiscard]] std::optional<SeverityFit> fit_law(const ReadingModel& model, const LawAt& law,
                                                 const ChannelNoise& noise, const LawStart& start,
                                                 NearbyOrbits& near);

/// The noise of the readings, where it is not known: what a smooth curve leaves of the residuals of Coulomb +
/// viscous friction. `plain`: that fit; it is repeated until its weights are those of the noise. Nothing where it
/// has none.
struct PlainFit {
  ChannelNoise noise;  ///< and what laws err by
  SeverityFit fit;
  std::vector<double> own_deviations;  ///< of the noise alone
  double own_chi2 = 0.0;               ///< by the noise alone: plain friction does not err, it holds or not
};
[[nodiscard]] std::optional<PlainFit> plain_fit(const ReadingModel& model);

/// Adds to the noise what laws that are not exact leave of the readings: `share` of what plain friction leaves
/// beyond the noise, channel by channel, as a standard deviation. The fit of plain friction with it, or nothing.
[[nodiscard]] std::optional<PlainFit> with_law_error(const ReadingModel& model, PlainFit plain, double share);

/// Fits over the severities of one departure, the mildest first; `plain` stands for severity zero. Ends where a law
/// explains the readings so much worse than a milder one that no region reaches it. Negative `largest`: the other
/// sign. A law that fits best at `largest`, and plain friction far worse, is followed on to `furthest` of the same
/// sign; zero: it is not.
[[nodiscard]] std::vector<SeverityFit> law_profile(const ReadingModel& model, const rigs::Rig& departure,
                                                   double largest, const ChannelNoise& noise,
                                                   const SeverityFit& plain, double furthest = 0.0);

}  // namespace dualdamp::identify
