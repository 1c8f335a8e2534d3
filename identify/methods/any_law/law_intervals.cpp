#include "identify/methods/any_law/law_intervals.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/ties.hpp"

namespace dualdamp::identify {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double level = 0.05;
using core::infinity;

/// One law over its severity, at many points.
struct Profile {
  const LawFits* law = nullptr;
  std::vector<SeverityPoint> points{};
  double least = infinity;  ///< chi2
};

/// A point of the mixture: a normal distribution with a weight.
struct Component {
  double weight = 0.0;
  double value = 0.0;
  double deviation = 0.0;
};

/// Probability that a value of the mixture lies below x.
double below(const std::vector<Component>& mixture, double x) {
  constexpr double certain = 9.0;  // beyond so many deviations a normal distribution is 0 or 1 to the last bit
  double sum = 0.0;
  for (const Component& part : mixture) {
    const double distance = (x - part.value) / part.deviation;
    if (distance > certain)
      sum += part.weight;
    else if (distance > -certain)
      sum += part.weight * 0.5 * std::erfc(-distance / std::numbers::sqrt2);
  }
  return sum;
}

double quantile(const std::vector<Component>& mixture, double share) {
  double low = infinity;
  double high = -infinity;
  constexpr double reach = 6.0;
  for (const Component& part : mixture) {
    low = std::min(low, part.value - reach * part.deviation);
    high = std::max(high, part.value + reach * part.deviation);
  }
  const auto excess = [&](double x) { return below(mixture, x) - share; };
  const double at_low = excess(low);
  const double at_high = excess(high);
  if (!(std::isfinite(high - low) && at_low < 0.0 && at_high > 0.0)) return unknown;
  constexpr int bits = 50;
  std::uintmax_t most = 100;
  const auto [left, right] = boost::math::tools::toms748_solve(
      excess, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(bits), most);
  return std::midpoint(left, right);
}

/// Likelihood at chi2 = least chi2 of the law + `above`, with the deviation known or estimated (Student).
double likelihood(double above, double scale, double freedom) {
  if (std::isinf(freedom)) return std::exp(-0.5 * above / scale);
  return std::pow(1.0 + above / scale / freedom, -0.5 * (freedom + 1.0));
}

class Summary {
 public:
  Summary(const ReadingModel& model, const KnownConstants& constants, const PlainFit& plain,
          std::vector<Profile> profiles)
      : model_(model), constants_(constants), plain_(plain), profiles_(std::move(profiles)) {}

  [[nodiscard]] LawIntervals intervals() {
    LawIntervals result;
    result.data = model_.data();
    judge(result);
    const double student = quantile95(plain_.noise.freedom);
    for (const Profile& profile : profiles_) result.laws.push_back(answer_of(profile, student * student));
    weigh(result);
    draw_hull(result);
    result.aliases = aliases(result);
    sort_with_ties(result.laws, &LawAnswer::p_value,
                   [](const LawAnswer& a, const LawAnswer& b) { return a.name < b.name; });
    return result;
  }

 private:
  /// Degrees of freedom of a law's fit.
  [[nodiscard]] double freedom_of(const Profile& profile) const {
    const auto rows = static_cast<double>(model_.readings().size());
    const double own = profile.law->law.departure == nullptr ? 2.0 : 3.0;
    return std::max(rows - own, 1.0);
  }

  /// chi2 for the test of a law. The error of the laws counts only for a law that is like the departure: its chi2
  /// is at most half that of plain friction. Any other law is judged by the noise alone, as plain friction is.
  [[nodiscard]] double misfit_of(const Profile& profile) const {
    constexpr double like = 0.5;
    if (profile.law->law.departure == nullptr) return plain_.own_chi2;
    if (profile.least <= like * plain_.fit.chi2) return profile.least;
    const SeverityFit& best = profile.law->best();
    const Index rows = model_.readings().size();
    double own = best.residuals.tail(best.residuals.size() - rows).squaredNorm();
    for (Index i = 0; i < rows; ++i) {
      const auto channel = static_cast<std::size_t>(model_.channels()[static_cast<std::size_t>(i)]);
      own += std::pow(best.residuals[i] * plain_.noise.deviations[channel] / plain_.own_deviations[channel], 2);
    }
    return profile.least * own / best.chi2;
  }

  [[nodiscard]] double p_value(const Profile& profile) const {
    const double freedom = freedom_of(profile);
    const double denominator = std::min(plain_.noise.freedom, 1e8);
    return f_test_p_value(misfit_of(profile) / scale_ / freedom, freedom, denominator);
  }

  /// Raises the noise until the best law is not rejected.
  void judge(LawIntervals& result) {
    double best = 0.0;
    for (const Profile& profile : profiles_) best = std::max(best, p_value(profile));
    if (best >= level) return;
    double least = infinity;
    for (const Profile& profile : profiles_) least = std::min(least, misfit_of(profile) / freedom_of(profile));
    scale_ = std::max(least, 1.0);
    result.inflation = std::sqrt(scale_);
  }

  [[nodiscard]] double zeta_of(double c) const { return c / constants_.critical_damping(); }

  [[nodiscard]] LawAnswer answer_of(const Profile& profile, double reach) const {
    LawAnswer answer;
    answer.name = profile.law->law.name();
    answer.p_value = p_value(profile);
    answer.rejected = answer.p_value < level;
    const SeverityPoint& best = best_of(profile.points);
    answer.severity = best.severity;
    const bool below = best.severity < 0.0;
    answer.largest = (below ? profile.points.front() : profile.points.back()).severity;
    answer.value = {zeta_of(best.c), best.c, best.F0 / constants_.stiffness, best.F0};
    answer.F0_interval95 =
        region_of(profile.points, reach * scale_, &SeverityPoint::F0, &SeverityPoint::F0_deviation);
    const Interval c = region_of(profile.points, reach * scale_, &SeverityPoint::c, &SeverityPoint::c_deviation);
    answer.zeta_interval95 = {zeta_of(c[0]), zeta_of(c[1])};
    return answer;
  }

  /// Laws that are not rejected have the same weight: if two laws are wrong, the one that fits better need not have
  /// the smaller error in zeta and F0.
  void weigh(LawIntervals& result) const {
    const auto allowed = std::ranges::count_if(result.laws, [](const LawAnswer& law) { return !law.rejected; });
    std::vector<Component> zeta;
    std::vector<Component> F0;
    for (std::size_t i = 0; i < profiles_.size(); ++i) {
      if (result.laws[i].rejected) continue;
      result.laws[i].weight = 1.0 / static_cast<double>(allowed);
      const std::vector<double> shares = posterior_of(profiles_[i]);
      for (std::size_t j = 0; j < shares.size(); ++j) {
        const SeverityPoint& node = profiles_[i].points[j];
        const double weight = result.laws[i].weight * shares[j];
        zeta.push_back({weight, zeta_of(node.c), zeta_of(node.c_deviation) * std::sqrt(scale_)});
        F0.push_back({weight, node.F0, node.F0_deviation * std::sqrt(scale_)});
      }
    }
    for (auto [mixture, mean, std, interval] :
         {std::tuple{&zeta, &result.mean.zeta, &result.std.zeta, &result.zeta_average},
          std::tuple{&F0, &result.mean.F0, &result.std.F0, &result.F0_average}}) {
      double square = 0.0;
      for (const Component& part : *mixture) *mean += part.weight * part.value;
      for (const Component& part : *mixture)
        square += part.weight * (std::pow(part.value - *mean, 2) + part.deviation * part.deviation);
      *std = std::sqrt(square);
      *interval = {std::max(quantile(*mixture, 0.025), 0.0), quantile(*mixture, 0.975)};
    }
    const double critical = constants_.critical_damping();
    for (ParameterSet* set : {&result.mean, &result.std}) {
      set->c = set->zeta * critical;
      set->x_f = set->F0 / constants_.stiffness;
    }
  }

  /// Prior times likelihood of each node of a law; the sum is 1.
  [[nodiscard]] std::vector<double> posterior_of(const Profile& profile) const {
    std::vector<double> shares = prior_of(profile);
    double sum = 0.0;
    for (std::size_t j = 0; j < shares.size(); ++j) {
      const SeverityPoint& node = profile.points[j];
      shares[j] *= likelihood(node.chi2 - profile.least, scale_, plain_.noise.freedom) *
                   std::exp(node.log_volume - profile.points.front().log_volume);
      sum += shares[j];
    }
    for (double& share : shares) share /= sum;
    return shares;
  }

  /// Prior of each node: the normal density of its severity, by the trapezoidal rule; the sum is 1. If a law fits
  /// best beyond the expected severities, its prior is as wide as the severity of that fit.
  static std::vector<double> prior_of(const Profile& profile) {
    const std::vector<SeverityPoint>& nodes = profile.points;
    std::vector<double> prior(nodes.size(), 1.0);
    if (nodes.size() < 2) return prior;
    const LibraryLaw& law = profile.law->law;
    const double best = std::abs(best_of(nodes).severity);
    const double deviation = best > law.largest ? std::max(law.deviation, best) : law.deviation;
    double sum = 0.0;
    for (std::size_t j = 0; j < nodes.size(); ++j) {
      const double before = nodes[j == 0 ? 0 : j - 1].severity;
      const double after = nodes[std::min(j + 1, nodes.size() - 1)].severity;
      const double z = nodes[j].severity / deviation;
      prior[j] = 0.5 * (after - before) * std::exp(-0.5 * z * z);
      sum += prior[j];
    }
    for (double& weight : prior) weight /= sum;
    return prior;
  }

  static void draw_hull(LawIntervals& result) {
    result.zeta_hull = result.F0_hull = {infinity, -infinity};
    for (const LawAnswer& law : result.laws) {
      if (law.rejected) continue;
      for (auto [hull, own, ends] : {std::tuple{&result.zeta_hull, &law.zeta_interval95, &result.zeta_ends},
                                     std::tuple{&result.F0_hull, &law.F0_interval95, &result.F0_ends}}) {
        // Of laws that reach as far but for rounding, the first of the library ends it.
        if ((*own)[0] < (*hull)[0] && !is_tie((*own)[0], (*hull)[0])) (*hull)[0] = (*own)[0], (*ends)[0] = law.name;
        if ((*own)[1] > (*hull)[1] && !is_tie((*own)[1], (*hull)[1])) (*hull)[1] = (*own)[1], (*ends)[1] = law.name;
      }
    }
  }

  [[nodiscard]] std::vector<std::vector<std::string>> aliases(const LawIntervals& result) const {
    constexpr double alike = 1.0;  // standard deviations between the readings of two best fits
    std::vector<std::vector<std::size_t>> groups;
    const Index rows = model_.readings().size();
    for (std::size_t i = 0; i < profiles_.size(); ++i) {
      if (result.laws[i].rejected) continue;
      const auto fits_in = [&](const std::vector<std::size_t>& group) {
        return std::ranges::all_of(group, [&](std::size_t j) {
          const VectorXd apart =
              profiles_[i].law->best().residuals.head(rows) - profiles_[j].law->best().residuals.head(rows);
          return apart.squaredNorm() < alike * scale_;
        });
      };
      const auto group = std::ranges::find_if(groups, fits_in);
      if (group == groups.end())
        groups.push_back({i});
      else
        group->push_back(i);
    }
    std::vector<std::vector<std::string>> named;
    for (const std::vector<std::size_t>& group : groups) {
      if (group.size() < 2) continue;
      named.emplace_back();
      for (const std::size_t i : group) named.back().push_back(result.laws[i].name);
    }
    return named;
  }

  const ReadingModel& model_;
  const KnownConstants& constants_;
  const PlainFit& plain_;
  std::vector<Profile> profiles_;
  double scale_ = 1.0;
};

/// Why the fits of these laws give no range: some searches ended before all fits were made. Empty: none did.
std::string why_cut_short(const std::vector<LawFits>& laws) {
  const auto first = std::ranges::find_if(laws, &LawFits::cut_short);
  if (first == laws.end()) return {};
  return "the search was cut short: where it came nearest to the data, steady states take too long to compute under " +
         first->law.name() +
         ", and perhaps under further laws; as a rule such data contradict the stated constants or sensors; 'without' "
         "leaves a law out";
}

}  // namespace

LawIntervals intervals_of(const ReadingModel& model, const KnownConstants& constants, const PlainFit& plain,
                          std::vector<LawFits>& laws) {
  std::vector<std::string> unsolved;
  for (const LawFits& law : laws)
    if (!law.solved()) unsolved.push_back(law.law.name());
  std::erase_if(laws, [](const LawFits& law) { return !law.solved(); });
  std::vector<Profile> profiles;
  for (const LawFits& law : laws) {
    Profile profile{&law, severity_curve(model, SeverityScale(law.law.departure), law.fits)};
    profile.least = best_of(profile.points).chi2;
    profiles.push_back(std::move(profile));
  }
  LawIntervals intervals = Summary(model, constants, plain, std::move(profiles)).intervals();
  intervals.unsolved = std::move(unsolved);
  return intervals;
}

std::string no_law_fits(const LawIntervals& laws) {
  constexpr double most = 3.0;
  if (!(laws.inflation > most)) return {};
  return "no law of the library fits: the best one misses the readings by " +
         core::format_number(laws.inflation, 2) + " times their noise";
}

std::string no_law_fits(const Estimate& estimate) {
  return estimate.laws ? no_law_fits(*estimate.laws) : std::string();
}

std::variant<LawStudy, std::string> study_laws(const ReadingModel& model, const KnownConstants& constants,
                                               const LawIntervalOptions& options) {
  std::optional<PlainFit> plain = plain_fit(model);
  if (plain) plain = with_law_error(model, std::move(*plain), options.law_error);
  if (!plain)
    return "no Coulomb and viscous friction has readings like these, or they do not distinguish its force "
           "from its damping";
  LawStudy study{.plain = std::move(*plain)};
  study.laws = fit_library(model, options, study.plain);
  // The part of a law's region that was not searched might be the end of the range.
  if (std::string why = why_cut_short(study.laws); !why.empty()) return why;
  study.intervals = intervals_of(model, constants, study.plain, study.laws);
  return study;
}

}  // namespace dualdamp::identify
