#include "identify/methods/amplitudes/energy_balance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/constants.hpp"
#include "identify/conclusion.hpp"
#include "identify/methods/amplitudes/input_levels.hpp"
#include "identify/methods/amplitudes/steady_states.hpp"
#include "identify/models/force_parameters.hpp"
#include "identify/records/history_energy.hpp"
#include "identify/records/usable_histories.hpp"
#include "identify/statistics/noise_level.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

using std::numbers::pi;

EnergyTerms energy_of(const Pair& pair, double stiffness) {
  const double fundamental = std::isnan(pair.fundamental) ? pair.x : pair.fundamental;
  const double period = core::two_pi / pair.omega;
  const double speed = pair.omega * fundamental;
  return {
      .work = pi * stiffness * pair.Y * fundamental * std::sin(pair.phase),
      .path = 4.0 * pair.x,
      .speed_square = period * (std::isnan(pair.mean_square_speed) ? 0.5 * speed * speed : pair.mean_square_speed),
      .number = pair.number};
}

namespace {

std::optional<ForceLine> force_line_of(const std::vector<EnergyTerms>& accounts) {
  std::vector<Datum> points;
  points.reserve(accounts.size());
  for (const EnergyTerms& account : accounts)
    points.push_back({account.speed_square / account.path, account.work / account.path, account.number});
  return force_line(std::move(points), 1.0);
}

std::vector<EnergyTerms> accounts_of(const std::vector<Pair>& states, double stiffness) {
  std::vector<EnergyTerms> accounts;
  accounts.reserve(states.size());
  for (const Pair& state : states) accounts.push_back(energy_of(state, stiffness));
  return accounts;
}

}  // namespace

bool balance(const std::vector<EnergyTerms>& accounts, const KnownConstants& constants, Estimate& estimate,
             std::vector<std::string>& faults, const OwnAccounts& own) {
  const std::optional<ForceLine> line = force_line_of(accounts);
  if (!line) {
    refuse(estimate, "two steady states of different speeds are needed");
    return false;
  }
  set_estimate(estimate, *line, constants);
  ForceLine scattered = *line;  // less the error of the method's own approximation, which is no error of the data
  if (own && estimate.value.zeta > 0.0 && estimate.value.x_f >= 0.0) {
    const std::optional<ForceLine> of_own = force_line_of(own(estimate.value));
    if (of_own && of_own->residuals.size() == scattered.residuals.size()) {
      scattered.residuals -= of_own->residuals;
      set_estimate(estimate, scattered, constants);
    }
  }
  estimate.used = numbers_of(line->points);
  const double scale = output_range(line->points);
  judge_force_signs(estimate, scale / line->moments.mean_Y, scale, faults);
  const CurvatureColumns columns = curvature_columns(line->points);
  estimate.lack_of_fit =
      added_term_test(columns.line, scattered.residuals, columns.square, scale, "quadratic term F-test");
  if (estimate.lack_of_fit && estimate.lack_of_fit->fired)
    estimate.findings.emplace_back(
        "the dissipation per path does not grow with the speed as Coulomb and viscous friction make it, so no "
        "single zeta and F0 describes these states");
  return true;
}

namespace {

/// Number of periods in all samples of x, by the rate of reversals between the first reversal and the last. A
/// reversal counts only if x turns back by more than `band`.
int periods_of(const std::vector<double>& x, double band) {
  std::vector<std::size_t> turns;
  double sense = 0.0;
  std::size_t furthest = 0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double beyond = x[i] - x[furthest];
    const bool turned = std::abs(beyond) > band && sense * beyond < 0.0;
    if (turned) turns.push_back(furthest);
    if (turned || sense * beyond > 0.0 || (sense == 0.0 && std::abs(beyond) > band)) {
      sense = beyond > 0.0 ? 1.0 : -1.0;
      furthest = i;
    }
  }
  if (turns.size() < 2) return 1;
  const double half_period =
      static_cast<double>(turns.back() - turns.front()) / static_cast<double>(turns.size() - 1);
  return std::max(static_cast<int>(static_cast<double>(x.size()) / (2.0 * half_period)), 1);
}

/// The shortest path of a window that counts. Noise adds to the path of a mass that stands still, and the filter
/// rounds its stops: both weigh most where a motion is small. Such windows are at the end of the line that tells
/// F0.
double least_path(const std::vector<WindowEnergy>& windows, double noise_path) {
  constexpr double times_noise = 10.0;
  constexpr double of_largest = 0.1;
  const double largest = std::ranges::max(windows, {}, &WindowEnergy::path).path;
  return std::max(times_noise * noise_path, of_largest * largest);
}

/// The first cut-off; 0, no filter, if that is below four times the frequency of the motion. So it is with fewer
/// than 20 samples in a period: the filter would take part of the motion, and so few samples need none.
double cutoff_of(const History& history, const FilterOptions& options) {
  constexpr double room = 4.0;
  const double first = cutoffs_for(history, options).front();
  return options.cutoffs.empty() && first < room * mean_frequency(history) ? 0.0 : first;
}

/// Balances of windows of about a period each, filtered with the first cut-off, where the mass moves.
std::vector<EnergyTerms> accounts_of_histories(const Record& record, const KnownConstants& constants,
                                               const FilterOptions& options, Estimate& estimate) {
  std::vector<EnergyTerms> accounts;
  for (const NumberedHistory& item : usable_histories(record, options, estimate)) {
    const double cutoff = cutoff_of(*item.history, options);
    const PreparedHistory motion = sharply_prepared(*item.history, cutoff);
    constexpr double widest_noise = 10.0;  // standard deviations; of a million Gaussian ones it is 9.8
    const double band = widest_noise * noise_level(item.history->x);
    const std::vector<WindowEnergy> windows = energy_of(motion, constants, periods_of(motion.x, band));
    const double still = std::sqrt(2.0 / pi) * speed_noise(*item.history, cutoff);
    const double least = least_path(windows, still * windows.front().duration);
    for (const WindowEnergy& window : windows)
      if (window.path > 0.0 && window.path >= least && window.range > band)
        accounts.push_back({.work = window.input - window.stored,
                            .path = window.path,
                            .speed_square = window.square_speed,
                            .number = item.number});
  }
  return accounts;
}

Estimate of_histories(const Record& record, const KnownConstants& constants, const FilterOptions& options,
                      Estimate estimate) {
  estimate.is_of_histories = true;
  if (std::string fault = lacks_constants(constants); !fault.empty()) {
    refuse(estimate, std::move(fault));
    return estimate;
  }
  const std::vector<EnergyTerms> accounts = accounts_of_histories(record, constants, options, estimate);
  std::vector<std::string> faults;
  if (!estimate.outcome.ok()) return estimate;
  if (accounts.size() < 2) {
    refuse(estimate, "fewer than two periods have a motion that stands out of the noise of the sensor");
    return estimate;
  }
  if (!balance(accounts, constants, estimate, faults)) return estimate;
  const auto repeated = std::ranges::unique(estimate.used);
  estimate.used.erase(repeated.begin(), repeated.end());
  conclude(estimate, faults,
           "rests on " + std::to_string(accounts.size()) + " periods of " + std::to_string(estimate.used.size()) +
               (estimate.used.size() == 1 ? " history" : " histories"));
  return estimate;
}

Estimate of_states(const Record& record, const KnownConstants& constants, Estimate estimate) {
  const std::optional<std::vector<Pair>> states = take_states(record, constants, true, estimate);
  if (!states) return estimate;
  if (std::string lack = lacks_levels(*states); !lack.empty()) {
    refuse(estimate, std::move(lack));
    return estimate;
  }
  const bool approximate = std::ranges::any_of(
      *states, [](const Pair& pair) { return std::isnan(pair.fundamental) || std::isnan(pair.mean_square_speed); });
  const auto own = [&](const ParameterSet& value) {
    return accounts_of(exact_states(*states, value, constants), constants.stiffness);
  };
  std::vector<std::string> faults;
  if (!balance(accounts_of(*states, constants.stiffness), constants, estimate, faults,
               approximate ? OwnAccounts(own) : OwnAccounts()))
    return estimate;
  if (approximate) {
    const auto read = [&](const std::vector<Pair>& exact) -> std::optional<ParameterSet> {
      const std::optional<ForceLine> line = force_line_of(accounts_of(exact, constants.stiffness));
      if (!line) return std::nullopt;
      return parameters(ForceParameters{constants.mass, line->c(), constants.stiffness, line->F0()});
    };
    if (std::isnan(constants.mass))
      estimate.warnings.emplace_back(
          "a harmonic motion was assumed, since fundamental or mean square speed were not measured: c is some 2 % "
          "too large and F0 too small, or more away from resonance");
    judge_own_reading(*states, constants, read,
                      "because fundamental or mean square speed were not measured and a harmonic motion is assumed",
                      estimate, faults);
  }
  conclude(estimate, faults,
           "rests on " + std::to_string(estimate.used.size()) + " of " +
               std::to_string(record.pairs->pairs.size()) + " steady states");
  return estimate;
}

/// Why the record has neither two pairs with phases nor histories; empty when it has.
std::string lacks_energy(const Record& record) {
  return record.histories.empty() || lacks_phases(record).empty() ? lacks_phases(record) : "";
}

}  // namespace

/// States are preferred to histories, because they are averaged over many periods.
Estimate energy_balance(const Record& record, const KnownConstants& constants, const FilterOptions& options) {
  Estimate estimate;
  estimate.method = energy_balance_method.name;
  if (record.histories.empty() || lacks_phases(record).empty())
    return of_states(record, constants, std::move(estimate));
  return of_histories(record, constants, options, std::move(estimate));
}

constinit const MethodEntry energy_balance_method{
    .name = "energy_balance",
    .summary = "viscous damping and friction force from the work of the base, exact at any frequency",
    .assumes =
        "Coulomb and viscous friction, a harmonic base, two turning points in a period, a true phase; checked: "
        "quadratic term F-test, the bias where the mean square speed was not measured",
    .equation = "pi k Y X_1 sin(phi) = 4 F0 x + c integral v^2 dt over a period",
    .sources = "tomlinson1979, liang2006balancing",
    .needs = RecordKind::phases,
    .lacks = lacks_energy,
    .call = call_of<energy_balance>,
    .rests_on = AssumptionSet::all_but(Assumption::spring, Assumption::one_mode, Assumption::symmetry),
};

}  // namespace dualdamp::identify
