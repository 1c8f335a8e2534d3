#include "identify/methods/amplitudes/law_selection.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/methods/amplitudes/bootstrap.hpp"
#include "identify/methods/amplitudes/den_hartog_fit.hpp"
#include "identify/methods/amplitudes/fundamental_laws.hpp"
#include "identify/methods/amplitudes/law_fit.hpp"
#include "identify/methods/amplitudes/resonance_line.hpp"
#include "identify/models/force_parameters.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/least_squares.hpp"
#include "identify/statistics/statistics.hpp"
#include "sim/analytic/den_hartog.hpp"

namespace dualdamp::identify {

namespace analytic = sim::analytic;

namespace {

using core::infinity;

/// Differences of x below this fraction of its range are ignored.
constexpr double least_effect = 5e-4;

/// The pairs and their scales.
struct Test {
  std::vector<Datum> pairs;
  std::vector<LawPoint> points;
  double force = 0.0;   ///< k Y_max [N]
  double length = 0.0;  ///< x_max [m]
  double speed = 0.0;   ///< V_max [m/s]
  double range = 0.0;   ///< of x, over x_max
  bool one_frequency = true;
};

/// Number of input levels, summed over the frequencies. Inputs within 3 % of their range are one level.
std::size_t levels_of(const std::vector<Datum>& pairs) {
  std::vector<Datum> sorted = pairs;
  std::ranges::sort(sorted, {}, [](const Datum& datum) { return std::pair(datum.r, datum.Y); });
  const auto [least, greatest] = std::ranges::minmax_element(pairs, {}, &Datum::Y);
  const double reach = 0.03 * (greatest->Y - least->Y);
  std::size_t count = 0;
  const Datum* first = nullptr;
  for (const Datum& datum : sorted) {
    const bool same = first != nullptr && is_same_frequency(first->r, datum.r) && datum.Y - first->Y <= reach;
    if (same) continue;
    first = &datum;
    ++count;
  }
  return count;
}

/// Effective number of independent pairs: N/(1 + (n - 1) rho) with the correlation rho of residuals within a sweep
/// of n pairs (kish1965), from the analysis of variance.
double effective_count(const std::vector<Datum>& pairs, const Eigen::VectorXd& residuals) {
  const std::vector<std::vector<std::size_t>> blocks = sweep_blocks(pairs);
  const auto count = static_cast<double>(pairs.size());
  const auto sweeps = static_cast<double>(blocks.size());
  if (blocks.size() < 2 || count - sweeps < 1.0) return count;
  double within = 0.0;
  double between = 0.0;
  const double mean = residuals.mean();
  for (const std::vector<std::size_t>& block : blocks) {
    double own = 0.0;
    for (const std::size_t i : block)
      own += residuals[static_cast<Eigen::Index>(i)] / static_cast<double>(block.size());
    for (const std::size_t i : block) within += std::pow(residuals[static_cast<Eigen::Index>(i)] - own, 2);
    between += static_cast<double>(block.size()) * (own - mean) * (own - mean);
  }
  const double size = count / sweeps;
  const double of_pairs = within / (count - sweeps);
  const double of_sweeps = std::max((between / (sweeps - 1.0) - of_pairs) / size, 0.0);
  if (!(of_pairs + of_sweeps > 0.0)) return count;
  return count / (1.0 + (size - 1.0) * of_sweeps / (of_pairs + of_sweeps));
}

/// The scaled pairs. The error of harmonic balance at the fit of Coulomb and viscous friction is subtracted from x.
std::optional<Test> make_test(const ResonanceData& data, const std::vector<int>& used, const ParameterSet& value) {
  Test test;
  for (const Datum& datum : data.pairs)
    if (std::ranges::binary_search(used, datum.number)) test.pairs.push_back(datum);
  const KnownConstants& constants = data.constants;
  const double omega_n = std::sqrt(constants.stiffness) / std::sqrt(constants.mass);
  double least = infinity;
  std::set<double> frequencies;
  for (const Datum& datum : test.pairs) {
    test.force = std::max(test.force, constants.stiffness * datum.Y * data.unit);
    test.length = std::max(test.length, datum.x * data.unit);
    test.speed = std::max(test.speed, omega_n * datum.r * datum.x * data.unit);
    least = std::min(least, datum.x * data.unit);
    frequencies.insert(datum.r);
  }
  test.one_frequency = is_same_frequency(*frequencies.rbegin(), *frequencies.begin());
  test.range = (test.length - least) / test.length;
  const FundamentalLaw& plain = fundamental_laws().front();
  const Eigen::VectorXd p = Eigen::Vector2d(value.F0 / test.force, value.c * test.speed / test.force).cwiseMax(0.0);
  for (const Datum& datum : test.pairs) {
    LawPoint point{constants.stiffness * datum.Y * data.unit / test.force, datum.x * data.unit / test.length,
                   constants.stiffness * (1.0 - datum.r) * (1.0 + datum.r) * test.length / test.force,
                   omega_n * datum.r * test.length / test.speed};
    const auto exact = analytic::amplitude(analytic::den_hartog(value.zeta, datum.r), datum.Y * data.unit,
                                           std::max(value.x_f, 0.0));
    const std::optional<LawOutput> balanced = output_of(plain, p, point);
    if (!exact || !balanced) return std::nullopt;
    point.x += balanced->X - *exact / test.length;
    test.points.push_back(point);
  }
  return test;
}

LawCandidate candidate_of(const LawFit& fit, const Test& test, double count) {
  const FundamentalLaw& law = *fit.law;
  LawCandidate candidate;
  candidate.law = law.name;
  const double freedom = fit.freedom();
  const std::optional<Eigen::MatrixXd> unit = unit_covariance(fit.jacobian);
  const bool known = unit && freedom >= 1.0;
  const double variance = freedom >= 1.0 ? fit.squares() / freedom : 0.0;
  const double half_width = known ? quantile95(freedom) : 0.0;
  const auto add = [&](std::string_view name, std::string_view unit_name, Eigen::Index j, double scale) {
    const double value = fit.p[j] * scale;
    candidate.parameters.push_back(
        known ? further(std::string(name), std::string(unit_name), value, variance * (*unit)(j, j) * scale * scale,
                        half_width)
              : FurtherParameter{std::string(name), std::string(unit_name), value, std::nullopt, std::nullopt});
  };
  const double shape = shape_of(law, fit.p);
  for (std::size_t j = 0; j < law.coefficients.size(); ++j) {
    const LawCoefficient& coefficient = law.coefficients[j];
    const bool of_exponent = law.shape && law.shape->is_exponent && j + 1 == law.coefficients.size();
    const double power = of_exponent ? shape : coefficient.speed_power;
    add(coefficient.name, coefficient.unit, static_cast<Eigen::Index>(j),
        test.force * std::pow(test.speed, -power) * std::pow(test.length, -coefficient.length_power));
  }
  if (law.shape)
    add(law.shape->name, law.shape->unit, static_cast<Eigen::Index>(law.coefficients.size()),
        law.shape->is_speed ? test.speed : 1.0);
  candidate.residual_deviation = std::sqrt(variance) * test.length;

  const double floor = least_effect * test.range;
  const double square = fit.squares() / static_cast<double>(fit.residuals.size()) + floor * floor;
  const double likelihood = count * std::log(square / (test.range * test.range));
  const double K = static_cast<double>(law.parameters()) + 1.0;  // the variance is estimated too
  candidate.AICc =
      count - K - 1.0 > 0.5 ? likelihood + 2.0 * K + 2.0 * K * (K + 1.0) / (count - K - 1.0) : infinity;
  candidate.BIC = likelihood + K * std::log(count);
  return candidate;
}

/// Sorts the candidates, best first, and sets their Akaike weights (from BIC if an AICc is infinite). True when
/// AICc ranks.
bool rank(std::vector<LawCandidate>& candidates) {
  const bool by_AICc =
      std::ranges::all_of(candidates, [](const LawCandidate& candidate) { return std::isfinite(candidate.AICc); });
  const auto criterion = [by_AICc](const LawCandidate& candidate) {
    return by_AICc ? candidate.AICc : candidate.BIC;
  };
  std::ranges::stable_sort(candidates, {}, criterion);
  double sum = 0.0;
  for (LawCandidate& candidate : candidates) {
    candidate.weight = std::exp(-0.5 * (criterion(candidate) - criterion(candidates.front())));
    sum += candidate.weight;
  }
  for (LawCandidate& candidate : candidates) candidate.weight /= sum;
  return by_AICc;
}

/// F test of the best law with one more parameter against Coulomb and viscous friction. Its p value is multiplied
/// by the number of such laws with different curves.
std::optional<LackOfFit> widening_test(const std::vector<LawFit>& fits, const Test& test) {
  const LawFit* best = nullptr;
  double compared = 0.0;
  for (const LawFit& fit : fits) {
    if (!fit.law->one_more) continue;
    if (!(test.one_frequency && fit.law->alias_at_one_frequency)) compared += 1.0;
    if (best == nullptr || fit.squares() < best->squares()) best = &fit;
  }
  if (best == nullptr || best->freedom() < 1.0) return std::nullopt;
  const double gain = std::max(fits.front().squares() - best->squares(), 0.0);
  const double rounding = 1e-14 * test.range;
  const double left = std::max(best->squares() / best->freedom(), rounding * rounding);
  LackOfFit result;
  result.test = "F test of " + std::string(best->law->name) + ", the best of " + core::format_number(compared, 2) +
                " laws with one more parameter";
  result.freedom = static_cast<int>(best->freedom());
  result.statistic = gain / left;
  result.p_value = std::min(1.0, compared * f_test_p_value(result.statistic, 1.0, best->freedom()));
  result.effect = std::sqrt(gain / static_cast<double>(best->residuals.size())) / test.range;
  result.fired = result.p_value < result.level && result.effect > result.least_effect;
  return result;
}

/// Coulomb and viscous friction and the best law of velocity.
void add_curve(const std::vector<LawFit>& fits, const std::vector<LawCandidate>& candidates, const Test& test,
               Estimate& estimate) {
  std::vector<const LawFit*> drawn = {&fits.front()};
  for (const LawCandidate& candidate : candidates) {
    const auto fit = std::ranges::find(fits, candidate.law, [](const LawFit& f) { return f.law->name; });
    if (fit->law->forces == nullptr) continue;
    if (&*fit != drawn.front()) drawn.push_back(&*fit);
    break;
  }
  constexpr int points = 50;
  EstimateCurve curve{"friction_velocity", {{"v", "m/s", {}}}};
  for (const LawFit* fit : drawn) curve.columns.push_back({"F_" + std::string(fit->law->name), "N", {}});
  for (int i = 1; i <= points; ++i) {
    const double v = static_cast<double>(i) / points;
    curve.columns[0].values.push_back(v * test.speed);
    for (std::size_t j = 0; j < drawn.size(); ++j)
      curve.columns[j + 1].values.push_back(
          test.force * sum_of_terms(*drawn[j]->law, drawn[j]->p,
                                    drawn[j]->law->forces(v, shape_of(*drawn[j]->law, drawn[j]->p))));
  }
  estimate.curves.push_back(std::move(curve));
}

void judge(const Test& test, Estimate& estimate) {
  const LawCandidate& best = estimate.candidates.front();
  const bool plain = best.law == fundamental_laws().front().name;
  const bool fired = estimate.lack_of_fit && estimate.lack_of_fit->fired;
  if (fired)
    estimate.findings.push_back("Coulomb + viscous friction is rejected (" + estimate.lack_of_fit->test + ", " +
                                p_text(estimate.lack_of_fit->p_value) + "); " + best.law +
                                " ranks first, so no single zeta and F0 describes the pairs");
  else if (!plain)
    estimate.warnings.push_back(best.law +
                                " ranks before Coulomb + viscous friction, and the difference may be chance");
  if (!fired && plain) return;
  estimate.warnings.emplace_back(
      test.one_frequency
          ? "amplitudes at one frequency cannot show which mechanism bends them: a law of velocity, one of "
            "position and one of amplitude can give exactly these data, and F0 (1 - |x|/L) gives those of a "
            "smaller c; other frequencies, phases, harmonics or a free decay distinguish them"
          : "amplitudes distinguish a law of velocity from one of position by their frequencies alone, and neither from "
            "one of amplitude: phases, harmonics or a free decay distinguish them");
}

/// The laws that these pairs can support.
std::vector<LawFit> fit_laws(const Test& test, std::size_t levels, Estimate& estimate) {
  std::vector<LawFit> fits;
  for (const FundamentalLaw& law : fundamental_laws()) {
    if (law.parameters() + 2 > levels && !fits.empty()) continue;
    // Its curve equals that of a smaller c, for any data.
    if (test.one_frequency && law.name == "position_linear") continue;
    std::optional<LawFit> fit = fit_law(law, test.points);
    if (fit)
      fits.push_back(std::move(*fit));
    else
      estimate.warnings.push_back(std::string(law.name) + " could not be fitted and was left out");
    if (fits.empty()) break;
  }
  return fits;
}

}  // namespace

Estimate law_selection(const Record& record, const KnownConstants& constants, const KnownDeviations& options) {
  Estimate estimate = den_hartog_fit(record, constants, DenHartogOptions{options});
  estimate.method = law_selection_method.name;
  if (!estimate.outcome.ok()) return estimate;
  estimate.lack_of_fit.reset();
  Estimate ignored;
  const std::optional<ResonanceData> data = take_pairs(record, constants, ignored);
  const std::size_t least_levels = 4;
  const auto few = [&](std::size_t count) {
    refuse(estimate, "four levels are needed to compare laws, and the record has " + std::to_string(count));
    return estimate;
  };
  const std::optional<Test> test = data ? make_test(*data, estimate.used, estimate.value) : std::nullopt;
  const std::size_t levels = test ? levels_of(test->pairs) : 0;
  if (levels < least_levels) return few(levels);
  const std::vector<LawFit> fits = fit_laws(*test, levels, estimate);
  if (fits.empty()) {
    refuse(estimate, "Coulomb + viscous friction could not be fitted");
    return estimate;
  }
  const double count = effective_count(test->pairs, fits.front().residuals);
  for (const LawFit& fit : fits) estimate.candidates.push_back(candidate_of(fit, *test, count));
  const bool by_AICc = rank(estimate.candidates);
  estimate.lack_of_fit = widening_test(fits, *test);
  add_curve(fits, estimate.candidates, *test, estimate);

  std::vector<std::string> faults;
  judge_signs(estimate, test->length, faults);
  judge(*test, estimate);
  conclude(estimate, faults,
           "rests on " + std::to_string(test->pairs.size()) + " pairs at " + std::to_string(levels) +
               " levels, ranked by " + (by_AICc ? "AICc" : "BIC"));
  return estimate;
}

constinit const MethodEntry law_selection_method{
    .name = "law_selection",
    .summary = "compares Coulomb + viscous friction with other laws on amplitude pairs",
    .assumes =
        "no sticking, errors in x alone, harmonic balance for the difference between laws; checked: sticking pairs are "
        "left out, F test of the best wider law; what amplitudes cannot distinguish is said",
    .equation = "least squares in x of ((k - m w^2) X)^2 + Phi(w X, X)^2 = (k Y)^2, ranked by AICc or BIC",
    .sources = "burnham2002, schwarz1978, denhartog1931",
    .needs = RecordKind::states,
    .lacks = lacks_pairs,
    .call = call_of<law_selection>,
    .rests_on = AssumptionSet::all_but(),
};

}  // namespace dualdamp::identify
