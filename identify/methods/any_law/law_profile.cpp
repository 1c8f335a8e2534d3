#include "identify/methods/any_law/law_profile.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "identify/methods/any_law/severity_refinement.hpp"
#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Least F0 and c in a fit, over their units.
constexpr double least_share = 0.02;

VectorXd weights_of(const ReadingModel& model, const ChannelNoise& noise) {
  VectorXd weights(model.readings().size());
  for (Index i = 0; i < weights.size(); ++i)
    weights[i] = 1.0 / noise.deviations[static_cast<std::size_t>(model.channels()[static_cast<std::size_t>(i)])];
  return weights;
}

VectorXd with_priors(const ReadingModel& model, const VectorXd& weighted, const VectorXd& unknowns) {
  const auto priors = static_cast<Index>(model.nuisances().size());
  VectorXd all(weighted.size() + priors);
  all.head(weighted.size()) = weighted;
  for (Index j = 0; j < priors; ++j)
    all[weighted.size() + j] = -unknowns[2 + j] / model.nuisances()[static_cast<std::size_t>(j)].deviation;
  return all;
}

MatrixXd with_priors(const ReadingModel& model, const MatrixXd& weighted) {
  const auto priors = static_cast<Index>(model.nuisances().size());
  MatrixXd all = MatrixXd::Zero(weighted.rows() + priors, weighted.cols());
  all.topRows(weighted.rows()) = weighted;
  for (Index j = 0; j < priors; ++j)
    all(weighted.rows() + j, 2 + j) = 1.0 / model.nuisances()[static_cast<std::size_t>(j)].deviation;
  return all;
}

/// Gauss-Newton with Broyden's corrections. Derivatives are computed anew only where the corrected ones mislead.
class Search {
 public:
  Search(const ReadingModel& model, const LawAt& law, const ChannelNoise& noise, NearbyOrbits& near)
      : model_(model), law_(law), weights_(weights_of(model, noise)), near_(near) {}

  /// `slopes`: derivatives of a similar law to begin with; empty: none are known.
  [[nodiscard]] bool minimize(const VectorXd& start, const MatrixXd& slopes) {
    constexpr int most_steps = 10;
    constexpr double settled = 0.1;     // standard deviations: what is left is linear
    constexpr double misleading = 0.3;  // of a step
    p_ = start;
    if (!evaluate(p_)) return false;
    jacobian_ = slopes;
    bool fresh = slopes.size() == 0;
    if (fresh && !differentiate()) return false;
    for (int i = 0; i < most_steps; ++i) {
      VectorXd step = pivoted_least_squares(jacobian_, residuals_);
      if (!step.allFinite()) return false;
      if ((jacobian_ * step).norm() < settled) {
        accept_unseen(step);
        return true;
      }
      const VectorXd before = residuals_;
      const bool moved = advance(step);
      if (!moved && fresh) return true;
      const double surprise = moved ? learn(before, step) : 1.0;
      fresh = surprise > misleading || !moved;
      if (fresh && !differentiate()) return false;
    }
    return true;
  }

  /// Computes the derivatives at the last evaluation.
  [[nodiscard]] bool differentiate() {
    const std::optional<MatrixXd> slopes = model_.derivatives(law_, seen_, *raw_, near_);
    if (!slopes) return false;
    jacobian_ = with_priors(model_, weights_.asDiagonal() * *slopes);
    return true;
  }

  /// The step that derivatives of the end still ask for, if it is short enough to be linear: corrected derivatives
  /// may have ended the search a little early.
  void settle() {
    constexpr double linear = 1.0;  // standard deviations
    const VectorXd step = pivoted_least_squares(jacobian_, residuals_);
    if (step.allFinite() && (jacobian_ * step).norm() < linear) accept_unseen(step);
  }

  [[nodiscard]] SeverityFit result() const {
    SeverityFit fit;
    fit.severity = law_.severity;
    fit.unknowns = p_;
    fit.residuals = residuals_;
    fit.chi2 = residuals_.squaredNorm();
    fit.slopes = jacobian_;
    return fit;
  }

 private:
  bool evaluate(const VectorXd& p) {
    raw_ = model_.residuals(law_, p, near_);
    if (!raw_) return false;
    seen_ = p;
    residuals_ = with_priors(model_, raw_->cwiseProduct(weights_), p);
    return true;
  }

  /// Makes a step that is too short to be worth an evaluation.
  void accept_unseen(const VectorXd& step) {
    if ((p_ + step).head(2).minCoeff() < least_share) return;
    p_ += step;
    residuals_ -= jacobian_ * step;
  }

  /// Broyden's correction. Returns the error of the expected change of the residuals, over the change.
  double learn(const VectorXd& before, const VectorXd& step) {
    const VectorXd expected = jacobian_ * step;
    const VectorXd apart = before - expected - residuals_;
    jacobian_ += apart * step.transpose() / step.squaredNorm();
    return apart.norm() / expected.norm();
  }

  /// Halves the step until the sum of squares falls; false where it does not.
  bool advance(VectorXd& step) {
    const double before = residuals_.squaredNorm();
    const VectorXd kept = residuals_;
    const std::optional<VectorXd> raw = raw_;
    const VectorXd seen = seen_;
    constexpr int halvings = 4;
    constexpr double most = 0.5;
    step = step.cwiseMax(-most).cwiseMin(most);
    for (int i = 0; i < halvings; ++i, step *= 0.5) {
      VectorXd moved = p_ + step;
      moved.head(2) = moved.head(2).cwiseMax(least_share);
      if (!evaluate(moved) || residuals_.squaredNorm() > before) continue;
      step = moved - p_;
      p_ = moved;
      return true;
    }
    residuals_ = kept;
    raw_ = raw;
    seen_ = seen;
    return false;
  }

  const ReadingModel& model_;
  LawAt law_;
  VectorXd weights_;
  NearbyOrbits& near_;
  VectorXd p_;
  VectorXd seen_;                ///< unknowns of the last accepted evaluation, within a step of p_
  std::optional<VectorXd> raw_;  ///< residuals there, in the units of the readings
  VectorXd residuals_;
  MatrixXd jacobian_;
};

/// Covariance of the unknowns from the derivatives; false where the readings do not determine them.
bool find_covariance(SeverityFit& fit) {
  fit.covariance = DefiniteMatrix(gram(fit.slopes)).inverse();
  constexpr double determined = 100.0;  // units of F0 and c: with a larger error the readings determine nothing
  return fit.covariance.allFinite() && fit.covariance.diagonal().minCoeff() > 0.0 && std::isfinite(fit.chi2) &&
         fit.covariance.diagonal().head(2).maxCoeff() < determined * determined;
}

/// What the smooth curve leaves of the residuals of each channel, from residuals over `noise`.
ChannelNoise channel_noise(const ReadingModel& model, const ChannelNoise& noise, const VectorXd& residuals) {
  ChannelNoise found = noise;
  found.freedom = core::infinity;
  double freedom = 0.0;
  bool known = true;
  for (std::size_t channel = 0; channel < noise.deviations.size(); ++channel) {
    if (model.known_deviations()[channel] > 0.0) {
      found.deviations[channel] = model.known_deviations()[channel];
      continue;
    }
    std::vector<Index> rows;
    for (std::size_t i = 0; i < model.channels().size(); ++i)
      if (model.channels()[i] == static_cast<int>(channel)) rows.push_back(static_cast<Index>(i));
    if (rows.empty()) continue;
    const MatrixXd curve = model.smooth_curve()(rows, Eigen::all);
    const VectorXd own = residuals(rows);
    const VectorXd left = left_beside(curve, own);
    Index rank = 0;
    for (Index j = 0; j < curve.cols(); ++j) rank += curve.col(j).isZero(0.0) ? 0 : 1;
    if (channel > 0 && own.size() <= rank) {
      // The curve leaves nothing of so few phases: they are taken to be as noisy as the amplitudes.
      found.deviations[channel] = std::max(found.deviations[0] / model.reference().amplitude,
                                           model.least_deviation(static_cast<int>(channel)));
      continue;
    }
    known = false;
    const double own_freedom = std::max(1.0, static_cast<double>(own.size() - rank));
    freedom += own_freedom;
    found.deviations[channel] = std::max(noise.deviations[channel] * std::sqrt(left.squaredNorm() / own_freedom),
                                         model.least_deviation(static_cast<int>(channel)));
  }
  if (!known) found.freedom = freedom;
  return found;
}

/// Unknowns at a severity, continued linearly from those of the last two fits.
VectorXd continued(SeverityScale scale, const std::vector<SeverityFit>& fits, double severity) {
  const SeverityFit& last = fits.back();
  if (fits.size() < 3) return last.unknowns;
  const SeverityFit& before = fits[fits.size() - 2];
  const double end = scale.of(last.severity);
  const double part = (scale.of(severity) - end) / (end - scale.of(before.severity));
  VectorXd unknowns = last.unknowns + part * (last.unknowns - before.unknowns);
  unknowns.head(2) = unknowns.head(2).cwiseMax(least_share);
  return unknowns;
}

/// Whether a law has to be followed on beyond the expected severities: it fits best at the last of them, and far
/// better than plain friction. Otherwise its region would end only because the search ends.
bool is_open(const std::vector<SeverityFit>& fits, double least) {
  constexpr double far = 10.0;
  return fits.back().chi2 <= least && fits.front().chi2 - least > far;
}

/// Adds fits at growing severities until no region reaches further, or up to `furthest`.
void follow(const ReadingModel& model, const departures::Departure& departure, const ChannelNoise& noise,
            double furthest, NearbyOrbits& near, std::vector<SeverityFit>& fits) {
  const SeverityScale scale(&departure);
  constexpr double growth = 1.5;
  constexpr double out_of_region = 15.0;
  double least = fits.back().chi2;
  while (std::abs(fits.back().severity) < std::abs(furthest) && fits.back().chi2 - least < out_of_region) {
    double severity = growth * fits.back().severity;
    if (std::abs(severity) > std::abs(furthest)) severity = furthest;
    const LawStart start{continued(scale, fits, severity), fits.back().slopes, true};
    const std::optional<SeverityFit> fit = fit_law(model, {&departure, severity}, noise, start, near);
    if (!fit) return;
    fits.push_back(*fit);
    least = std::min(least, fit->chi2);
  }
}

}  // namespace

void share_slopes(SeverityScale scale, std::size_t of, std::vector<SeverityFit>& fits) {
  const SeverityFit& left = fits[of - 1];
  const SeverityFit& right = fits[of + 1];
  const double before = scale.of(left.severity);
  const double part = (scale.of(fits[of].severity) - before) / (scale.of(right.severity) - before);
  SeverityFit shared = fits[of];
  shared.slopes = (1.0 - part) * left.slopes + part * right.slopes;
  if (find_covariance(shared)) fits[of] = std::move(shared);
}

std::optional<SeverityFit> fit_law(const ReadingModel& model, const LawAt& law, const ChannelNoise& noise,
                                   const LawStart& start, NearbyOrbits& near) {
  Search search(model, law, noise, near);
  if (!search.minimize(start.unknowns, start.slopes)) return std::nullopt;
  if (start.own_slopes) {
    if (!search.differentiate()) return std::nullopt;
    search.settle();
  }
  SeverityFit fit = search.result();
  return find_covariance(fit) ? std::optional(fit) : std::nullopt;
}

std::optional<SeverityFit> stepped_fit(const ReadingModel& model, double severity, const ChannelNoise& noise,
                                       const VectorXd& unknowns, const VectorXd& residuals,
                                       const MatrixXd& slopes) {
  const VectorXd weights = weights_of(model, noise);
  SeverityFit fit;
  fit.severity = severity;
  fit.slopes = with_priors(model, weights.asDiagonal() * slopes);
  const VectorXd before = with_priors(model, residuals.cwiseProduct(weights), unknowns);
  VectorXd step = pivoted_least_squares(fit.slopes, before);
  // An unknown that would fall below its least value ends there, and the others are fitted beside it.
  for (Index j = 0; j < 2; ++j) {
    if (!(unknowns[j] + step[j] < least_share)) continue;
    MatrixXd others = fit.slopes;
    others.col(j).setZero();
    const double fixed = least_share - unknowns[j];
    step = pivoted_least_squares(others, before - fixed * fit.slopes.col(j));
    step[j] = fixed;
    step[1 - j] = std::max(step[1 - j], least_share - unknowns[1 - j]);
    break;
  }
  fit.unknowns = unknowns + step;
  fit.residuals = before - fit.slopes * step;
  fit.chi2 = fit.residuals.squaredNorm();
  return find_covariance(fit) ? std::optional(fit) : std::nullopt;
}

std::optional<PlainFit> plain_fit(const ReadingModel& model) {
  PlainFit plain;
  for (std::size_t channel = 0; channel < model.known_deviations().size(); ++channel) {
    const double known = model.known_deviations()[channel];
    constexpr double first_guess = 30.0;
    plain.noise.deviations.push_back(known > 0.0 ? known
                                                 : first_guess * model.least_deviation(static_cast<int>(channel)));
  }
  const std::unique_ptr<NearbyOrbits> near = model.no_orbits(plain.noise.deviations);
  LawStart start{.unknowns = model.start()};
  constexpr int rounds = 3;
  for (int i = 0; i < rounds; ++i) {
    const std::optional<SeverityFit> fit = fit_law(model, {}, plain.noise, start, *near);
    if (!fit) return std::nullopt;
    start.unknowns = fit->unknowns;
    plain.fit = *fit;
    plain.noise = channel_noise(model, plain.noise, fit->residuals.head(model.readings().size()));
  }
  const std::optional<SeverityFit> fit = fit_law(model, {}, plain.noise, start, *near);
  if (!fit) return std::nullopt;
  plain.fit = *fit;
  plain.own_chi2 = fit->chi2;
  plain.own_deviations = plain.noise.deviations;
  return plain;
}

std::optional<PlainFit> with_law_error(const ReadingModel& model, PlainFit plain, double share) {
  const std::size_t channels = plain.noise.deviations.size();
  std::vector<double> square(channels, 0.0);
  std::vector<double> count(channels, 0.0);
  for (std::size_t i = 0; i < model.channels().size(); ++i) {
    const auto channel = static_cast<std::size_t>(model.channels()[i]);
    square[channel] += std::pow(plain.fit.residuals[static_cast<Index>(i)], 2);
    count[channel] += 1.0;
  }
  for (std::size_t channel = 0; channel < channels; ++channel) {
    const double beyond = square[channel] / std::max(count[channel], 1.0) - 1.0;
    plain.noise.deviations[channel] *= std::sqrt(1.0 + share * share * std::max(beyond, 0.0));
  }
  const std::unique_ptr<NearbyOrbits> near = model.no_orbits(plain.noise.deviations);
  const std::optional<SeverityFit> fit = fit_law(model, {}, plain.noise, {.unknowns = plain.fit.unknowns}, *near);
  if (!fit) return std::nullopt;
  plain.fit = *fit;
  return plain;
}

LawProfile law_profile(const ReadingModel& model, const departures::Departure& departure, double largest,
                       const ChannelNoise& noise, const SeverityFit& plain, double furthest) {
  constexpr int count = 5;
  constexpr double out_of_reach = 60.0;
  const SeverityScale scale(&departure);
  std::vector<SeverityFit> fits = {plain};
  const std::unique_ptr<NearbyOrbits> near = model.no_orbits(noise.deviations);
  near->most_work = model.most_work();
  double least = plain.chi2;
  bool own_slopes = true;
  for (const double severity : scale.first_severities(largest, count)) {
    const LawStart start{continued(scale, fits, severity), fits.back().slopes, own_slopes};
    const std::optional<SeverityFit> fit = fit_law(model, {&departure, severity}, noise, start, *near);
    if (!fit) break;
    fits.push_back(*fit);
    if (own_slopes && fits.size() > 2) share_slopes(scale, fits.size() - 2, fits);
    own_slopes = !own_slopes;
    least = std::min(least, fit->chi2);
    if (fit->chi2 > least + out_of_reach && fit->chi2 > fits[fits.size() - 2].chi2) break;
  }
  if (fits.back().severity == largest && is_open(fits, least))
    follow(model, departure, noise, furthest, *near, fits);
  refine(model, departure, noise, *near, fits);
  return {std::move(fits), near->is_exhausted()};
}

}  // namespace dualdamp::identify
