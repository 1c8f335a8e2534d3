#include "sim/orbits/steady_state.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "sim/batch/batch.hpp"
#include "sim/engine/engine.hpp"
#include "sim/motion/observers.hpp"
#include "sim/orbits/orbit_account.hpp"
#include "sim/orbits/period_map.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

using friction::Direction;

namespace {

/// Rounding of a Floquet multiplier on the unit circle.
constexpr double on_circle = 1e-9;

/// Closure that counts as an orbit when Newton's corrections have sunk into rounding.
constexpr double rounding_closure = 1e-12;

/// A motion that closes this well after thousands of periods and still is not periodic creeps.
constexpr double creeping = 1e-3;

/// Where orbits may coexist the motion is integrated until it closes this well before Newton's method takes over.
constexpr double near_orbit = 1e-2;
constexpr int periods_to_near_orbit = 500;

/// A motion that closes this well has settled every slider that comes to rest.
constexpr double settled = 1e-8;

constexpr int max_newton = 60;

/// Growth over the first periods' motion that counts as growth without bound.
constexpr double runaway = 1e9;

/// Tells growth without end from growth that slows down and from beats. Asked at 500, 1000, 2000, ... periods: an
/// amplitude grows on when it gained 1.7 times as much over the last doubling of time, n to 2 n, as over the one
/// before; 2 is in proportion to time. One that tends to its end as 1 - exp(-n/tau) or as tanh(n/tau) gains so much
/// for n below tau/4.5 or tau/3.4 only, and would not settle within `max_periods` from there. One that beats was
/// larger before.
class Growth {
 public:
  bool goes_on(int period, double amplitude) {
    largest_ = std::max(largest_, amplitude);
    if (period != next_) return false;
    next_ *= 2;
    constexpr double gained_more = 1.7;
    constexpr double beating = 0.9;
    constexpr double at_least = 0.1;  // of the amplitude; 1/2 in proportion to time
    const double gain = amplitude < beating * largest_ ? 0.0 : amplitude - last_;
    const bool on = gain_ > 0.0 && gain > gained_more * gain_ && gain > at_least * amplitude;
    gain_ = last_ > 0.0 ? gain : 0.0;
    last_ = amplitude;
    return on;
  }

 private:
  int next_ = 500;
  double largest_ = 0.0;
  double last_ = 0.0;
  double gain_ = 0.0;
};

class OrbitFinder {
 public:
  OrbitFinder(const Model& model, const SteadyStateOptions& options)
      : model_(model), options_(options), omega_(model.excitation.frequency), map_(model) {
    const double accuracy = map_.engine().accuracy();
    options_.tolerance = std::max(options_.tolerance, accuracy);
    rounding_closure_ = std::max(rounding_closure, 10.0 * accuracy);
    for (const friction::Law& law : model.friction) {
      const friction::Memory memory = law.start({});
      const double slipping = std::abs(law.force(memory, {}, Direction::forward));
      may_coexist_ = may_coexist_ || law.is_modal() || law.static_limit(memory, {}) > slipping;
    }
  }

  void find(SteadyState& result);
  [[nodiscard]] core::SearchCount count() {
    core::SearchCount sum = searched_;
    return sum += map_.engine().count();
  }
  void describe(SteadyState& result);

 private:
  bool begin_on_sliding_orbit(ForcingPeriod& period);
  bool newton(ForcingPeriod& period, SteadyState& result);
  bool integrate_to_orbit(ForcingPeriod& period, SteadyState& result);
  bool integrate(ForcingPeriod& period, double closure, int periods, SteadyState& result);
  [[nodiscard]] core::Outcome failure(const ForcingPeriod& period) const;

  const Model& model_;
  SteadyStateOptions options_;
  double omega_;
  PeriodMap map_;
  std::optional<OrbitAccount> account_;  ///< of the sliding orbit that Newton's method began on, if it stayed there
  core::SearchCount searched_;           ///< beside those of the engine
  double rounding_closure_ = 0.0;
  double first_half_ = 0.0;  ///< largest |x| in either half of the periods integrated [m]
  double second_half_ = 0.0;
  bool grows_ = false;        ///< and nothing slows it down
  bool may_coexist_ = false;  ///< static above kinetic, or laws that remember: more than one orbit may attract
};

/// Integrates the transient until one period closes to `closure`; gives up on a motion that grows without bound.
bool OrbitFinder::integrate(ForcingPeriod& period, double closure, int periods, SteadyState& result) {
  first_half_ = second_half_ = 0.0;
  const double early = period.size;
  Growth growth;
  for (int i = 0; i < periods; ++i) {
    if (period.closure(omega_) <= closure) return true;
    if (early > 0.0 && period.size > runaway * early) return false;
    grows_ = growth.goes_on(i, period.size);
    if (grows_) return false;
    double& largest = i < periods / 2 ? first_half_ : second_half_;
    largest = std::max(largest, period.size);
    period = map_.next(Monodromy::without);
    ++result.transient_periods;
    if (!map_.outcome().ok()) return false;
  }
  return period.closure(omega_) <= closure;
}

/// Newton on the period map; a step that does not bring the orbit closer is replaced by one period of transient.
bool OrbitFinder::newton(ForcingPeriod& period, SteadyState& result) {
  period = map_.from(period.begin, Monodromy::with, account_ ? &*account_ : nullptr);
  for (int i = 0; i < max_newton && map_.outcome().ok(); ++i) {
    const double closure = period.closure(omega_);
    if (closure <= options_.tolerance) return true;
    account_.reset();
    const Eigen::VectorXd step = newton_step(period);
    ++result.newton_steps;
    const State fallback = period.end;
    if (step.size() > 0) {
      const ForcingPeriod trial = map_.from(displaced(period.begin, step), Monodromy::with);
      if (map_.outcome().ok() && trial.closure(omega_) < 0.5 * closure) {
        period = trial;
        continue;
      }
    }
    if (closure <= rounding_closure_) return true;
    period = map_.from(fallback, Monodromy::with);
    ++result.transient_periods;
  }
  return false;
}

/// Why integrating the motion found no orbit. Without numbers of one point, so that many can share a reason.
core::Outcome OrbitFinder::failure(const ForcingPeriod& period) const {
  const std::string after = " after " + std::to_string(options_.max_periods) + " forcing periods";
  if (grows_ || second_half_ > 1.5 * first_half_ || period.size > 1.5 * first_half_) {
    return {core::OutcomeKind::no_steady_state,
            "no steady state: the amplitude still grows; damping limits it far out or not at all"};
  }
  if (period.closure(omega_) < creeping) {
    return {
        core::OutcomeKind::not_unique,
        "not unique: steady states form a continuum, and the motion from the initial state still creeps along it" +
            after};
  }
  return {core::OutcomeKind::no_steady_state,
          "no steady state: the motion from the initial state has not become periodic" + after};
}

/// The orbit that the motion from the initial state itself leads to: among neighbours that are steady too.
bool OrbitFinder::integrate_to_orbit(ForcingPeriod& period, SteadyState& result) {
  period = map_.from_start(model_.initial.position, model_.initial.velocity, Monodromy::without);
  if (!integrate(period, settled, options_.max_periods, result)) return false;
  // Sliders at rest: where they stand is settled, and Newton's method finds the rest of the orbit.
  ForcingPeriod trial = map_.from(period.begin, Monodromy::with);
  if (same_mode(trial.begin, trial.end) && trial.free_radius() < 1.0 - neutral_margin && newton(trial, result) &&
      trial.free_radius() < 1.0 - neutral_margin) {
    period = std::move(trial);
    return true;
  }
  period = map_.from(period.begin, Monodromy::without);
  const bool found = integrate(period, 10.0 * options_.tolerance, options_.max_periods, result);
  if (found) period = map_.from(period.begin, Monodromy::with);
  return found;
}

/// An orbit without sticking that attracts every motion is found without integrating any; Newton's method then has
/// nothing left to do.
bool OrbitFinder::begin_on_sliding_orbit(ForcingPeriod& period) {
  const std::optional<SlidingOrbit> orbit = may_coexist_ ? std::nullopt : sliding_orbit(model_);
  if (!orbit) return false;
  const std::optional<State> start = start_of(*orbit, model_);
  if (!start) return false;
  period.begin = *start;
  // Newton's method will find nothing left to do: one walk along the orbit is enough.
  account_.emplace(model_, options_.full_account);
  searched_ += orbit->certificate;
  return true;
}

void OrbitFinder::describe(SteadyState& result) {
  if (account_) return account_->write(result);
  account_for_orbit(model_, map_, options_.full_account, result);
}

void OrbitFinder::find(SteadyState& result) {
  ForcingPeriod period;
  if (!begin_on_sliding_orbit(period)) {
    period = map_.from_start(model_.initial.position, model_.initial.velocity, Monodromy::without);
    period = map_.next(Monodromy::without);
    result.transient_periods = 2;
    // Where orbits may coexist Newton could land on another one than the motion approaches.
    if (may_coexist_) integrate(period, near_orbit, periods_to_near_orbit, result);
  }
  // A motion that depends on its past has no state that Newton's method could change: the transient is integrated.
  const bool has_past = map_.engine().has_past();
  bool found =
      has_past ? integrate(period, options_.tolerance, options_.max_periods, result) : newton(period, result);
  const bool attracting = found && (has_past || period.radius() < 1.0 - neutral_margin);
  if (!attracting && map_.outcome().ok()) {
    account_.reset();
    found = integrate_to_orbit(period, result);
    if (found && period.moves && period.radius() >= 1.0 - neutral_margin) {
      result.warnings.emplace_back(
          "not unique: a Floquet multiplier lies on the unit circle, so that neighbouring orbits are steady too; "
          "this is "
          "the one approached from the initial state");
    }
  }
  if (!map_.outcome().ok()) {
    result.outcome = map_.outcome();
  } else if (!found) {
    result.outcome = failure(period);
  }
  result.start = period.begin;
  if (found && !has_past) result.multipliers = period.multipliers();
}

}  // namespace

bool SteadyState::stable() const {
  return std::all_of(multipliers.begin(), multipliers.end(),
                     [](const std::complex<double>& value) { return std::abs(value) < 1.0 + on_circle; });
}

SteadyState steady_state(const Model& model, const SteadyStateOptions& options) {
  valid_harmonic(model, "steady_state");
  SteadyState result;
  result.period = 2.0 * std::numbers::pi / model.excitation.frequency;
  for (const friction::Law& law : model.friction) {
    if (law.aperiodic().empty()) continue;
    result.outcome = {core::OutcomeKind::no_steady_state, "no steady state: " + std::string(law.aperiodic())};
    return result;
  }
  OrbitFinder finder(model, options);
  finder.find(result);
  if (result.outcome.ok()) finder.describe(result);
  result.certificate = finder.count();
  return result;
}

std::vector<Sample> one_period(const Model& model, const SteadyState& state, int count) {
  valid_harmonic(model, "one_period");
  require(count > 0 && state.period > 0.0 && state.start.memories.size() == model.friction.size(),
          "one period needs a steady state of the same model and a number of samples", "steady_state(model), > 0");
  const std::unique_ptr<Engine> engine = make_engine(model);
  engine->restart(state.start);
  Sampler sampler(count / state.period);
  Sample final;
  while (engine->periods_passed() == 0) {
    const Interval* interval = engine->next_in_period();
    if (interval == nullptr) break;
    sampler.observe(*interval);
    final = interval->at(interval->duration);
  }
  sampler.finish(final);
  return std::move(sampler.samples());
}

}  // namespace dualdamp::sim
