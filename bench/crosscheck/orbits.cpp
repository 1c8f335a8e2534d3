#include "bench/crosscheck/orbits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "bench/crosscheck/derivative.hpp"
#include "bench/crosscheck/patience.hpp"
#include "sim/engine/engine.hpp"
#include "sim/neutral_margin.hpp"
#include "sim/orbits/steady_state.hpp"
#include "sim/orbits/transient.hpp"

namespace dualdamp::crosscheck {

namespace {

constexpr double closure_tolerance = 1e-7;
/// Rest of a transient, relative to the size of the motion, that the comparison leaves out of account.
constexpr double settled = 0.1 * closure_tolerance;
/// Lengths of a transient in forcing periods; the second one if by the Floquet multipliers it should be over and is
/// not.
constexpr int usual_periods = 2'000;
constexpr int most_periods = 20'000;

/// Tolerance of the closure of a transient, as for a curve.
double size_of(const sim::Transient& motion) { return std::max(std::abs(motion.peak), std::abs(motion.trough)); }

double largest_multiplier(const sim::SteadyState& state) {
  double result = 0.0;
  for (const std::complex<double>& multiplier : state.multipliers) result = std::max(result, std::abs(multiplier));
  return result;
}

/// Whether the transient is not settled although by the largest Floquet multiplier nothing of it is left. With a
/// Floquet multiplier on the unit circle there is a continuum of orbits, along which a motion may creep at any
/// speed.
bool is_slower_than_multiplier(const sim::SteadyState& state, const sim::Transient& motion) {
  constexpr double safely = 1e-20;
  return state.outcome.ok() && motion.outcome.ok() && !motion.settled && motion.closure > closure_tolerance &&
         std::pow(largest_multiplier(state), motion.periods / state.period_ratio) < safely;
}

/// It is no contradiction if the search itself saw the motion still approach after more periods.
bool contradicts(const sim::SteadyState& state, const sim::Transient& motion) {
  return is_slower_than_multiplier(state, motion) && state.transient_periods < motion.periods;
}

/// Whether a transient in small steps would not settle within the usual periods, by the largest Floquet multiplier.
bool is_too_slow(const sim::Model& model, const sim::SteadyState& state) {
  const double multiplier = largest_multiplier(state);
  return state.outcome.ok() && !sim::is_exact(model) && multiplier < 1.0 - sim::neutral_margin &&
         std::pow(multiplier, usual_periods / state.period_ratio) > settled;
}

/// The transient, tested for closure over the periods of the steady state, since a subharmonic does not close over
/// one forcing period. Floquet multipliers hold near the orbit. A motion from far away, of whose energy friction
/// takes little in each period, needs more time.
sim::Transient transient(const sim::Model& model, const sim::SteadyState& state) {
  if (is_too_slow(model, state)) {
    sim::Transient none;
    none.outcome = {core::OutcomeKind::event_limit, "the transient is too long"};
    return none;
  }
  const Patience patience;
  const auto follow = [&](int periods) {
    return sim::follow_transient(model, {.max_periods = periods,
                                         .period_ratio = state.outcome.ok() ? state.period_ratio : 1,
                                         .settled = settled,
                                         .most_work = most_work,
                                         .give_up = [&] { return patience.is_over(); }});
  };
  sim::Transient motion = follow(usual_periods);
  if (!is_slower_than_multiplier(state, motion)) return motion;
  sim::Transient longer = follow(most_periods);
  // If the motion could not be followed further, the contradiction remains.
  return longer.settled || (longer.outcome.ok() && longer.periods > motion.periods) ? longer : motion;
}

/// How far the orbit on which a transient has settled is from the steady state, relative to the motion.
double distance(const sim::SteadyState& state, const sim::Transient& motion) {
  const double apart = std::max(std::abs(state.peak - motion.peak), std::abs(state.trough - motion.trough));
  return apart == 0.0 ? 0.0 : apart / std::max(size_of(motion), std::abs(state.peak));
}

/// Whether a change of the initial position by 1e-10 of the motion decides which of several orbits is reached.
bool is_reached_from_beside(sim::Model model, const sim::SteadyState& state) {
  const double start = model.initial.position;
  const double size = std::max({std::abs(start), std::abs(state.peak), std::abs(state.trough)});
  return std::ranges::any_of(std::array{-1e-10, 1e-10, -3e-11, 3e-11}, [&](double share) {
    model.initial.position = start + share * size;
    const sim::Transient motion = transient(model, state);
    return motion.outcome.ok() && motion.settled && distance(state, motion) <= closure_tolerance;
  });
}

Finding compare_transient(const sim::Model& model, const sim::SteadyState& state, const sim::Transient& motion) {
  const std::string name = "steady state against transient";
  const bool is_cut = motion.outcome.kind == core::OutcomeKind::event_limit;
  if (!motion.outcome.ok() && (!is_cut || !state.outcome.ok()))
    return {name, Verdict::refused, 0.0, "transient: " + motion.outcome.reason};
  if (!state.outcome.ok()) {
    if (motion.settled)
      return {name, Verdict::disagree, 0.0,
              fmt::format("the transient closes to {:.1e} after {} periods, peak {:.10g}, but: {}", motion.closure,
                          motion.periods, motion.peak, state.outcome.reason)};
    return {name, Verdict::refused, 0.0, state.outcome.reason};
  }
  if (!std::isfinite(state.peak) || !std::isfinite(state.trough) || !std::isfinite(state.energy.defect))
    return {name, Verdict::disagree, 0.0, "a steady state that is not finite"};
  if (!motion.settled) {
    if (contradicts(state, motion))
      return {name, Verdict::disagree, 0.0,
              fmt::format("largest multiplier {:.4g}, but after {} periods the transient closes to {:.1e} only",
                          largest_multiplier(state), motion.periods, motion.closure)};
    return {name, Verdict::not_compared, 0.0, "the transient is too long"};
  }
  const double worst = distance(state, motion);
  if (worst <= closure_tolerance) return {name, Verdict::agreed, worst, {}};
  if (is_reached_from_beside(model, state)) return {name, Verdict::exception, worst, "sensitive"};
  return {name, Verdict::disagree, worst,
          fmt::format("peak {:.10g}, trough {:.10g}; transient {:.10g}, {:.10g} after {} periods{}", state.peak,
                      state.trough, motion.peak, motion.trough, motion.periods,
                      state.warnings.empty() ? "" : "; warned: " + state.warnings.front())};
}

/// Why the period map of this model cannot start from an arbitrary state; empty if it can.
std::string reason_against_map(const sim::Model& model) {
  for (const friction::Law& law : model.friction) {
    if (!law.aperiodic().empty()) return std::string(law.aperiodic());
    if (law.delay() > 0.0) return "a law with a delay";
  }
  return {};
}

/// The steady state, and the transient beside it. A search that is cut short and finds none is repeated with all
/// the work that a user's search may take if the transient settles, because then there is an orbit; if the
/// transient does not settle, a longer search decides nothing here.
std::pair<sim::SteadyState, std::optional<sim::Transient>> orbit_and_transient(const sim::Model& model,
                                                                               double tolerance, bool has_map) {
  sim::SteadyStateOptions options;
  options.tolerance = tolerance;
  // A model without a map: that the search ends is all that is seen.
  options.most_work = has_map ? most_work : most_work / 6;
  sim::SteadyState state = sim::steady_state(model, options);
  if (!has_map) return {std::move(state), std::nullopt};
  sim::Transient motion = transient(model, state);
  if (!state.outcome.ok() && motion.settled) {
    options.most_work = std::numeric_limits<long>::max();
    state = sim::steady_state(model, options);
    if (state.outcome.ok()) motion = transient(model, state);
  }
  return {std::move(state), std::move(motion)};
}

}  // namespace

Findings compare_orbits(const scenarios::Scenario& scenario) {
  const sim::Model& model = scenario.model;
  Findings findings;
  const std::string reason = reason_against_map(model);
  const auto [state, motion] = orbit_and_transient(model, scenario.tolerance, reason.empty());
  if (!motion) {
    findings.push_back({"steady state against transient", Verdict::not_compared, 0.0, reason});
    return findings;
  }
  findings.push_back(compare_transient(model, state, *motion));
  const double omega = sim::natural_frequency(model.oscillator);
  sim::PeriodMap map(model);
  map.limit(most_work);
  static_cast<void>(map.from_start(model.initial.position, model.initial.velocity, sim::Monodromy::without));
  const sim::ForcingPeriod second = map.next(sim::Monodromy::without);
  if (map.outcome().ok())
    findings.push_back(compare_derivative("derivative in a transient", model, second.end, omega));
  if (state.outcome.ok())
    findings.push_back(compare_derivative("derivative on an orbit", model, state.start, omega));
  return findings;
}

}  // namespace dualdamp::crosscheck
