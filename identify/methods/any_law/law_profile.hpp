#pragma once
/// One law over its severity: at each of a few severities the best fit of all else, with its covariance.
///
///   chi2(s) = min over F0, c and the nuisances of sum (reading - prediction)^2/sigma^2 + sum
///   (nuisance/deviation)^2
///
/// Between the severities the values are interpolated. The 95 % region of zeta and F0 over all severities is that
/// of the profile likelihood: severity s adds the interval theta(s) +- sqrt((D - chi2(s) + chi2_min) V(s)).

#include <Eigen/Core>
#include <vector>

#include "identify/methods/any_law/reading_model.hpp"
#include "identify/methods/any_law/severity_scale.hpp"

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
  /// Whether derivatives are computed where the fit ends. Otherwise they are those of the search, as corrected by
  /// its steps.
  bool own_slopes = true;
};

/// The best fit of a law at one severity, from `start`. Nothing if the law has no steady states there.
[[nodiscard]] std::optional<SeverityFit> fit_law(const ReadingModel& model, const LawAt& law,
                                                 const ChannelNoise& noise, const LawStart& start,
                                                 NearbyOrbits& near);

/// Gives the fit number `of` derivatives interpolated between those of its neighbours, and the covariance of these.
void share_slopes(SeverityScale scale, std::size_t of, std::vector<SeverityFit>& fits);

/// The fit that one Gauss-Newton step from `unknowns` makes, with the residuals and the derivatives of the readings
/// there, in the units of the readings. Nothing if the readings do not determine the unknowns.
[[nodiscard]] std::optional<SeverityFit> stepped_fit(const ReadingModel& model, double severity,
                                                     const ChannelNoise& noise, const Eigen::VectorXd& unknowns,
                                                     const Eigen::VectorXd& residuals,
                                                     const Eigen::MatrixXd& slopes);

/// The fit of Coulomb and viscous friction, and the noise of the readings. Noise that is not known is what a smooth
/// curve leaves of the residuals of this fit, which is repeated until its weights are those of the noise.
struct PlainFit {
  ChannelNoise noise;  ///< with the error of the laws, once `with_law_error` has added it
  SeverityFit fit;
  std::vector<double> own_deviations;  ///< of the noise alone
  double own_chi2 = 0.0;               ///< by the noise alone: plain friction has no error of a law
};
[[nodiscard]] std::optional<PlainFit> plain_fit(const ReadingModel& model);

/// Adds the error of the laws to the noise: `share` of what plain friction leaves of the readings beyond the noise,
/// channel by channel, as a standard deviation. Returns the fit of plain friction with these deviations, or
/// nothing.
[[nodiscard]] std::optional<PlainFit> with_law_error(const ReadingModel& model, PlainFit plain, double share);

/// The fits of a law over its severity.
struct LawProfile {
  std::vector<SeverityFit> fits{};
  bool cut_short = false;  ///< the search has done the most work that it may (`ReadingModel::most_work`)
};

/// Fits over the severities of one departure, the mildest first: a few over the whole range, and further ones where
/// the curve through them is not yet known (severity_refinement.hpp); `plain` is the fit at severity zero. Ends
/// early once a severity fits so much worse than a milder one that no region reaches it. Negative `largest`:
/// severities of the other sign. If the law fits best at `largest`, and far better than plain friction, it is
/// followed on to `furthest`, of the same sign; zero: it is not followed on.
[[nodiscard]] LawProfile law_profile(const ReadingModel& model, const departures::Departure& departure,
                                     double largest, const ChannelNoise& noise, const SeverityFit& plain,
                                     double furthest = 0.0);

}  // namespace dualdamp::identify
