#include "identify/methods/any_law/law_profile.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "identify/statistics/linear_least_squares.hpp"

namespace dualdamp::identify {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Friction and damping keep to a share of what plain friction has: below it a law is another one.
constexpr double least_share = 0.02;

/// Rows over their deviations, with a row for the prior of each nuisance.
struct Rows {
  VectorXd residuals;
  MatrixXd jacobian;
};

VectorXd weights_of(const ReadingModel& model, const ReadingNoise& noise) {
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

/// Gauss and Newton, whose derivatives are taken again only after a step that leaves their reach.
class Search {
 public:
  Search(const ReadingModel& model, const LawAt& law, const ReadingNoise& noise, NearbyOrbits& near)
      : model_(model), law_(law), weights_(weights_of(model, noise)), near_(near) {}

  [[nodiscard]] std::optional<LawFit> from(const VectorXd& start) {
    constexpr int most_steps = 8;
    constexpr double settled = 0.05;    // standard deviations
    constexpr double linear_in = 0.02;  // of a step relative to the unknowns
    VectorXd p = start;
    if (!evaluate(p) || !differentiate(p)) return std::nullopt;
    for (int i = 0; i < most_steps; ++i) {
      VectorXd step = pivoted_least_squares(jacobian_, residuals_);
      if (!step.allFinite()) return std::nullopt;
      const double length = (jacobian_ * step).norm();
      if (!advance(p, step)) break;
      if (length < settled) break;
      if (step.cwiseAbs().maxCoeff() > linear_in && !differentiate(p)) return std::nullopt;
    }
    return result(p);
  }

 private:
  bool evaluate(const VectorXd& p) {
    raw_ = model_.residuals(law_, p, near_);
    if (!raw_) return false;
    residuals_ = with_priors(model_, raw_->cwiseProduct(weights_), p);
    return true;
  }

  bool differentiate(const VectorXd& p) {
    const std::optional<MatrixXd> slopes = model_.derivatives(law_, p, *raw_, near_);
    if (!slopes) return false;
    jacobian_ = with_priors(model_, weights_.asDiagonal() * *slopes);
    return true;
  }

  /// Halves the step until the sum of squares falls; false where it does not.
  bool advance(VectorXd& p, VectorXd& step) {
    const double before = residuals_.squaredNorm();
    const VectorXd kept = residuals_;
    const std::optional<VectorXd> raw = raw_;
    constexpr int halvings = 4;
    constexpr double most = 0.5;
    step = step.cwiseMax(-most).cwiseMin(most);
    for (int i = 0; i < halvings; ++i, step *= 0.5) {
      VectorXd moved = p + step;
      moved.head(2) = moved.head(2).cwiseMax(least_share);
      if (!evaluate(moved) || residuals_.squaredNorm() > before) continue;
      step = moved - p;
      p = moved;
      return true;
    }
    residuals_ = kept;
    raw_ = raw;
    return false;
  }

  [[nodiscard]] std::optional<LawFit> result(const VectorXd& p) const {
    LawFit fit;
    fit.severity = law_.severity;
    fit.unknowns = p;
    fit.residuals = residuals_;
    fit.chi2 = residuals_.squaredNorm();
    const MatrixXd information = jacobian_.transpose() * jacobian_;
    const Eigen::LDLT<MatrixXd> factor(information);
    fit.covariance = factor.solve(MatrixXd::Identity(information.rows(), information.cols()));
    const bool sound = fit.covariance.allFinite() && fit.covariance.diagonal().minCoeff() > 0.0;
    return sound && std::isfinite(fit.chi2) ? std::optional(fit) : std::nullopt;
  }

  const ReadingModel& model_;
  LawAt law_;
  VectorXd weights_;
  NearbyOrbits& near_;
  std::optional<VectorXd> raw_;  ///< residuals in the units of the readings
  VectorXd residuals_;
  MatrixXd jacobian_;
};

/// What the smooth curve leaves of the residuals of each channel, from residuals over `noise`.
ReadingNoise noise_of(const ReadingModel& model, const ReadingNoise& noise, const VectorXd& residuals) {
  ReadingNoise found = noise;
  found.freedom = std::numeric_limits<double>::infinity();
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
    known = false;
    const MatrixXd curve = model.smooth_curve()(rows, Eigen::all);
    const VectorXd own = residuals(rows);
    const VectorXd left = own - curve * pivoted_least_squares(curve, own);
    Index rank = 0;
    for (Index j = 0; j < curve.cols(); ++j) rank += curve.col(j).isZero(0.0) ? 0 : 1;
    const double own_freedom = std::max(1.0, static_cast<double>(own.size() - rank));
    freedom += own_freedom;
    found.deviations[channel] = std::max(noise.deviations[channel] * std::sqrt(left.squaredNorm() / own_freedom),
                                         model.least_deviation(static_cast<int>(channel)));
  }
  if (!known) found.freedom = freedom;
  return found;
}

}  // namespace

std::optional<LawFit> fit_law(const ReadingModel& model, const LawAt& law, const ReadingNoise& noise,
                              const VectorXd& start, NearbyOrbits& near) {
  return Search(model, law, noise, near).from(start);
}

std::optional<PlainFit> plain_fit(const ReadingModel& model) {
  PlainFit plain;
  for (std::size_t channel = 0; channel < model.known_deviations().size(); ++channel) {
    const double known = model.known_deviations()[channel];
    constexpr double first_guess = 30.0;
    plain.noise.deviations.push_back(known > 0.0 ? known
                                                 : first_guess * model.least_deviation(static_cast<int>(channel)));
  }
  const std::unique_ptr<NearbyOrbits> near = model.no_orbits();
  VectorXd start = model.start();
  constexpr int rounds = 3;
  for (int i = 0; i < rounds; ++i) {
    const std::optional<LawFit> fit = fit_law(model, {}, plain.noise, start, *near);
    if (!fit) return std::nullopt;
    start = fit->unknowns;
    plain.fit = *fit;
    plain.noise = noise_of(model, plain.noise, fit->residuals.head(model.readings().size()));
  }
  const std::optional<LawFit> fit = fit_law(model, {}, plain.noise, start, *near);
  if (!fit) return std::nullopt;
  plain.fit = *fit;
  return plain;
}

std::vector<LawFit> law_profile(const ReadingModel& model, const bench::Rig& departure, double largest,
                                const ReadingNoise& noise, const LawFit& plain) {
  constexpr int count = 5;
  constexpr double out_of_reach = 60.0;
  std::vector<LawFit> fits = {plain};
  const std::unique_ptr<NearbyOrbits> near = model.no_orbits();
  double least = plain.chi2;
  for (int i = 1; i <= count; ++i) {
    // Deflections act on the motion by their root as much as in proportion: the mild severities stand closer.
    const double severity = largest * std::pow(static_cast<double>(i) / count, 1.5);
    const std::optional<LawFit> fit = fit_law(model, {&departure, severity}, noise, fits.back().unknowns, *near);
    if (!fit) break;
    fits.push_back(*fit);
    least = std::min(least, fit->chi2);
    if (fit->chi2 > least + out_of_reach && fit->chi2 > fits[fits.size() - 2].chi2) break;
  }
  return fits;
}

}  // namespace dualdamp::identify
