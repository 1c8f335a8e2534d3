#include "identify/methods/amplitudes/resonance_within_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/methods/amplitudes/bootstrap.hpp"
#include "identify/methods/amplitudes/line_estimate.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/scatter.hpp"
#include "identify/statistics/statistics.hpp"
#include "sim/analytic/den_hartog.hpp"

namespace dualdamp::identify {

namespace analytic = sim::analytic;

namespace {

struct Sweep {
  Moments moments;
  std::vector<Datum> pairs;
  int label = 0;  ///< index
};

/// Parallel lines through sweeps, lengths in the unit of the data.
struct ParallelLines {
  double slope = 0.0;
  double S_YY = 0.0;            ///< within the sweeps
  double sum_of_squares = 0.0;  ///< about the lines
  double count = 0.0;
  std::vector<double> intercepts;

  [[nodiscard]] double freedom() const { return count - static_cast<double>(intercepts.size()) - 1.0; }
  [[nodiscard]] double mean_intercept() const {
    double sum = 0.0;
    for (const double intercept : intercepts) sum += intercept;
    return sum / static_cast<double>(intercepts.size());
  }
};

std::vector<Sweep> sweeps_of(const std::vector<Datum>& pairs) {
  std::vector<Sweep> sweeps;
  for (const std::vector<std::size_t>& block : sweep_blocks(pairs)) {
    Sweep sweep;
    sweep.label = pairs[block.front()].sweep;
    for (const std::size_t i : block) {
      sweep.pairs.push_back(pairs[i]);
      sweep.moments.add(pairs[i].Y, pairs[i].x);
    }
    sweeps.push_back(std::move(sweep));
  }
  return sweeps;
}

/// Nothing when the inputs do not vary within the sweeps.
std::optional<ParallelLines> parallel_lines(const std::vector<const Moments*>& sweeps) {
  ParallelLines lines;
  double S_xY = 0.0;
  double S_xx = 0.0;
  for (const Moments* m : sweeps) {
    lines.count += m->count;
    lines.S_YY += m->S_YY;
    S_xY += m->S_xY;
    S_xx += m->S_xx;
  }
  if (!(lines.S_YY > 0.0)) return std::nullopt;
  lines.slope = S_xY / lines.S_YY;
  lines.sum_of_squares = std::max(S_xx - lines.slope * S_xY, 0.0);
  lines.intercepts.reserve(sweeps.size());
  for (const Moments* m : sweeps) lines.intercepts.push_back(m->mean_x - lines.slope * m->mean_Y);
  return lines;
}

std::optional<ParallelLines> parallel_lines(const std::vector<Sweep>& sweeps) {
  std::vector<const Moments*> moments;
  moments.reserve(sweeps.size());
  for (const Sweep& sweep : sweeps) moments.push_back(&sweep.moments);
  return parallel_lines(moments);
}

/// With the mean friction of the sweeps.
std::optional<LineFriction> friction_of(const ParallelLines& lines, const ResonanceG& G) {
  return friction_of(Line{lines.slope, lines.mean_intercept()}, G);
}

/// Leaves out the pairs that stick at the friction of their own sweep, until no pair sticks.
std::vector<Datum> sliding_pairs(const ResonanceData& data, Estimate& estimate) {
  std::vector<Datum> left = data.pairs;
  while (!left.empty()) {
    const std::vector<Sweep> sweeps = sweeps_of(left);
    const std::optional<ParallelLines> lines = parallel_lines(sweeps);
    const std::optional<LineFriction> friction = lines ? friction_of(*lines, data.G) : std::nullopt;
    if (!friction) break;
    const double limit = analytic::non_sticking_limit(analytic::den_hartog(friction->zeta, data.r));
    std::map<int, double> x_f;
    for (std::size_t j = 0; j < sweeps.size(); ++j) x_f[sweeps[j].label] = -lines->intercepts[j] / friction->G;
    const auto sticks = [&](const Datum& datum) { return !(datum.x > limit * x_f[datum.sweep]); };
    for (const Datum& datum : left)
      if (sticks(datum))
        estimate.excluded.push_back(
            {datum.number, "the mass sticks: x/x_f = " + core::format_number(datum.x / x_f[datum.sweep], 4) +
                               " of its sweep is not above " + core::format_number(limit, 4)});
    if (std::erase_if(left, sticks) == 0) break;
  }
  std::ranges::sort(estimate.excluded, {}, &Exclusion::number);
  std::ranges::sort(left, {}, &Datum::number);
  return left;
}

/// Lines with separate slopes, tested against parallel lines.
void judge_slopes(const std::vector<Sweep>& sweeps, const ParallelLines& lines,
                  std::vector<std::string>& warnings) {
  double separate = 0.0;  // sum of squares about lines of their own
  double slopes = 0.0;
  for (const Sweep& sweep : sweeps) {
    const Moments& m = sweep.moments;
    if (!(m.S_YY > 0.0)) continue;
    slopes += 1.0;
    separate += std::max(m.S_xx - m.S_xY * m.S_xY / m.S_YY, 0.0);
  }
  const double spent = slopes - 1.0;
  const double freedom = lines.freedom() - spent;
  if (spent < 1.0 || freedom < 1.0) return;
  const double gain = lines.sum_of_squares - separate;
  const double range = lines.slope * std::sqrt(lines.S_YY);
  if (!(gain > 1e-6 * range * range)) return;  // too small to count, as for noiseless data
  const double F = gain / spent / std::max(separate / freedom, 1e-24 * range * range);
  const double p = f_test_p_value(F, spent, freedom);
  constexpr double level = 0.05;
  if (p < level)
    warnings.push_back("the lines of the sweeps are not parallel (F test, " + p_text(p) +
                       "): friction may have drifted within sweeps");
}

void test_sweep_curvature(const std::vector<Datum>& used, const std::vector<Datum>& exact, Estimate& estimate) {
  estimate.lack_of_fit = friction_curvature_test(used, exact, sweep_blocks(used));
  if (estimate.lack_of_fit && estimate.lack_of_fit->fired)
    estimate.findings.emplace_back(
        "the pairs of the sweeps do not lie on straight lines, so no single zeta describes them");
}

/// Degrees of freedom of a sum of two independent variances, after Welch and Satterthwaite.
double combined_freedom(double first, double first_freedom, double second, double second_freedom) {
  const double sum = first + second;
  return sum * sum / (first * first / first_freedom + second * second / second_freedom);
}

void add_uncertainty(const ParallelLines& lines, const std::vector<Sweep>& sweeps, const LineFriction& friction,
                     const ResonanceData& data, const WithinSweepOptions& options, Estimate& estimate) {
  const auto scatter = scatter_of(lines.sum_of_squares, lines.freedom(), lines.slope, options, data.unit);
  if (!scatter) return;
  warn_of_scatter(scatter->ratio, lines.freedom(), estimate);
  const auto count = static_cast<double>(sweeps.size());
  double mean_Y = 0.0;
  double between = 0.0;  // variance of the heights of the lines, with their slope as known
  const double mean = lines.mean_intercept();
  for (std::size_t j = 0; j < sweeps.size(); ++j) {
    mean_Y += sweeps[j].moments.mean_Y / count;
    between += (lines.intercepts[j] - mean) * (lines.intercepts[j] - mean) / (count - 1.0);
  }
  const double zeta_slope = -2.0 * friction.zeta * friction.zeta;  // d zeta/d b
  const double x_f_slope =
      mean_Y / friction.G + mean * data.G.derivative(friction.zeta) * zeta_slope / (friction.G * friction.G);
  const double slope = scatter->variance / lines.S_YY;
  const double from_slope = x_f_slope * x_f_slope * slope;
  const double from_sweeps = between / count / (friction.G * friction.G);
  Eigen::Matrix2d covariance;
  covariance << zeta_slope * zeta_slope * slope, zeta_slope * x_f_slope * slope, zeta_slope * x_f_slope * slope,
      from_slope + from_sweeps;
  const Eigen::DiagonalMatrix<double, 2> to_metres(1.0, data.unit);
  set_uncertainty(estimate, to_metres * covariance * to_metres, scatter->half_width, data.constants);
  if (!(from_sweeps > 0.0)) return;
  const double slope_freedom = std::max(lines.freedom(), 1.0);
  const double half_width = quantile95(combined_freedom(from_slope, slope_freedom, from_sweeps, count - 1.0));
  estimate.interval95->x_f = around(estimate.value.x_f, half_width * estimate.std->x_f);
  estimate.interval95->F0 = around(estimate.value.F0, half_width * estimate.std->F0);
}

/// Lists the friction of each sweep, and how far these differ.
void list_sweeps(const std::vector<Sweep>& sweeps, const ParallelLines& lines, const LineFriction& friction,
                 const ResonanceData& data, Estimate& estimate) {
  double square = 0.0;
  for (std::size_t j = 0; j < sweeps.size(); ++j) {
    const double x_f = -lines.intercepts[j] / friction.G;
    square += (x_f - friction.x_f) * (x_f - friction.x_f);
    estimate.subsets.push_back({"sweep " + data.sweeps[static_cast<std::size_t>(sweeps[j].label)],
                                static_cast<int>(sweeps[j].pairs.size()),
                                parameters(friction.zeta, x_f * data.unit, data.constants)});
  }
  const double deviation = std::sqrt(square / static_cast<double>(sweeps.size() - 1)) * data.unit;
  estimate.others.push_back(
      {"F0_between_sweeps", "N", data.constants.stiffness * deviation, std::nullopt, std::nullopt});
}

void bootstrap(const std::vector<Sweep>& sweeps, const ResonanceData& data, int replicates, Estimate& estimate) {
  std::vector<const Moments*> drawn(sweeps.size());
  add_bootstrap(estimate, replicates, sweeps.size(), data.constants,
                [&](Draws& draws) -> std::optional<Eigen::Vector2d> {
                  for (const Moments*& moments : drawn) moments = &sweeps[draws.below(sweeps.size())].moments;
                  const std::optional<ParallelLines> lines = parallel_lines(drawn);
                  const auto friction = lines ? friction_of(*lines, data.G) : std::nullopt;
                  if (!friction) return std::nullopt;
                  return Eigen::Vector2d(friction->zeta, friction->x_f * data.unit);
                });
}

}  // namespace

std::string lacks_sweeps(const Record& record) {
  if (std::string lack = lacks_resonance_pairs(record); !lack.empty()) return lack;
  std::map<std::string, int> counts;
  for (const Pair& pair : record.pairs->pairs) ++counts[pair.sweep];
  const auto several = std::ranges::count_if(counts, [](const auto& item) { return item.second >= 2; });
  return several >= 2 ? "" : "the pairs are not labelled with two sweeps of two pairs or more";
}

Estimate resonance_within_sweep(const Record& record, const KnownConstants& constants,
                                const WithinSweepOptions& options) {
  Estimate estimate;
  estimate.method = resonance_within_sweep_method.name;
  if (std::string lack = lacks_sweeps(record); !lack.empty()) {
    refuse(estimate, std::move(lack));
    return estimate;
  }
  const std::optional<ResonanceData> data = prepare(record, constants, options, estimate);
  if (!data) return estimate;
  const std::vector<Datum> used = sliding_pairs(*data, estimate);
  if (std::string fault = fault_of(used, record.pairs->pairs.size(), estimate.excluded); !fault.empty()) {
    refuse(estimate, std::move(fault));
    return estimate;
  }
  const std::vector<Sweep> sweeps = sweeps_of(used);
  const std::optional<ParallelLines> lines = parallel_lines(sweeps);
  const std::optional<LineFriction> friction = lines ? friction_of(*lines, data->G) : std::nullopt;
  if (sweeps.size() < 2 || !friction) {
    refuse(estimate, sweeps.size() < 2 ? "only one sweep is left"
                                       : "within the sweeps the output amplitude does not grow with the input");
    return estimate;
  }
  estimate.value = parameters(friction->zeta, friction->x_f * data->unit, constants);
  estimate.used = numbers_of(used);
  add_uncertainty(*lines, sweeps, *friction, *data, options, estimate);

  std::vector<std::string> faults;
  judge_signs(estimate, used.front().Y * data->unit, faults);
  // The exact law with one friction for all sweeps: its departure from a line serves for each sweep.
  const std::vector<Datum> exact = exact_pairs(*data, used, *friction);
  test_sweep_curvature(used, exact, estimate);
  judge_slopes(sweeps, *lines, estimate.warnings);
  const auto line_through = [](const std::vector<Datum>& pairs) {
    return line_of(moments_of(pairs), core::infinity);
  };
  judge_method(*data, exact, *friction, line_through, estimate, faults);
  list_sweeps(sweeps, *lines, *friction, *data, estimate);
  if (options.bootstrap > 0) bootstrap(sweeps, *data, options.bootstrap, estimate);
  conclude(estimate, faults,
           "rests on " + std::to_string(used.size()) + " of " + std::to_string(record.pairs->pairs.size()) +
               " pairs in " + std::to_string(sweeps.size()) + " sweeps at " + frequency_text(*data));
  return estimate;
}

constinit const MethodEntry resonance_within_sweep_method{
    .name = "resonance_within_sweep",
    .summary = "one damping ratio and a friction force for each sweep from parallel lines",
    .assumes =
        "excitation at w = wn, zeta small, no sticking, errors in x alone, friction that may drift between sweeps but "
        "not within one; checked: sticking pairs are left out, quadratic friction F-test, separate slopes F-test, what "
        "the method would make of its own estimate by the exact law",
    .equation = "x = a_j + b Y, zeta = 1/(2 b), x_f,j = -a_j/G(zeta), G by Eq (4) at w = wn",
    .sources = "liang2004identifying, draper1998, welch1947",
    .needs = RecordKind::pairs,
    .lacks = lacks_sweeps,
    .call = call_of<resonance_within_sweep>,
    .rests_on = AssumptionSet::all_but(Assumption::stationarity),
};

}  // namespace dualdamp::identify
