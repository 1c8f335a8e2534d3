#include "sim/orbits/steady_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "sim/batch/batch.hpp"
#include "sim/engine/drive.hpp"
#include "sim/engine/engine.hpp"
#include "sim/engine/smooth_engine.hpp"
#include "sim/motion/observers.hpp"
#include "sim/neutral_margin.hpp"
#include "sim/orbits/approach.hpp"
#include "sim/orbits/coexistence.hpp"
#include "sim/orbits/growth.hpp"
#include "sim/orbits/monotone_model.hpp"
#include "sim/orbits/newton.hpp"
#include "sim/orbits/orbit_account.hpp"
#include "sim/orbits/orbit_solver.hpp"
#include "sim/orbits/orbit_warnings.hpp"
#include "sim/orbits/period_map.hpp"
#include "sim/orbits/structural_damping.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

using friction::Direction;

namespace {

/// Error of a Floquet multiplier on the unit circle, under the smooth engine.
constexpr double on_circle = 1e-7;

/// Largest relative error of the only orbit with which it is accepted.
constexpr double known = 1e-6;

/// Two orbits whose peak and trough agree this well, relative to the amplitude, are mirror images.
constexpr double image = 1e-6;

/// The state at t = 0 of the steady state of an oscillator without friction.
State linear_response(const Model& model) {
  const Oscillator& o = model.oscillator;
  const Drive drive(o, model.excitation);
  State state{.x = drive.force_polynomial()[0] / o.stiffness};
  for (std::size_t j = 0; j < drive.frequencies().size(); ++j) {
    const double w = drive.frequencies()[j];
    const std::complex<double> x =
        drive.force_phasor(j) / std::complex(o.stiffness - o.mass * w * w, o.damping * w);
    state.x += x.real();
    state.v -= w * x.imag();
  }
  state.direction = state.v < 0.0 ? Direction::backward : Direction::forward;
  for (const friction::Law& law : model.friction) state.memories.push_back(law.start({}));
  return state;
}

/// Nothing moves the mass, apart from a constant force.
bool is_undriven(const Excitation& drive) {
  return drive.amplitude == 0.0 &&
         std::ranges::all_of(drive.harmonics, [](const Harmonic& harmonic) { return harmonic.amplitude == 0.0; });
}

/// Whether the law has no force on a mass at rest: it can hold it nowhere.
bool is_free_at_rest(const friction::Law& law) {
  const auto none_in = [&](Direction direction) { return law.force({}, {}, direction) == 0.0; };
  return !law.has_memory() && law.static_limit({}, {}) == 0.0 && none_in(Direction::none) &&
         none_in(Direction::forward) && none_in(Direction::backward);
}

/// Whether the law never has a force.
bool is_idle(const friction::Law& law) {
  if (!law.is_affine() || !is_free_at_rest(law)) return false;
  return std::ranges::all_of(std::array{Direction::forward, Direction::backward}, [&](Direction direction) {
    const friction::Affine force = law.affine_force({}, {}, direction);
    return force.position == 0.0 && force.velocity == 0.0 && force.rate == 0.0 && force.transient == 0.0;
  });
}

/// A motion that dies away never closes relative to its size; where it ends is known.
bool ends_in_linear_response(const Model& model) {
  return model.friction.empty() ||
         (is_undriven(model.excitation) && std::ranges::all_of(model.friction, is_free_at_rest));
}

class OrbitFinder {
 public:
  OrbitFinder(const Model& model, const SteadyStateOptions& options)
      : model_(model), options_(options), map_(model), motions_(motions_of(model)) {
    const double accuracy = map_.engine().accuracy();
    const Closure closure = closure_within(options_.tolerance, accuracy);
    options_.tolerance = closure.tolerance;
    rounding_closure_ = closure.rounding;
    map_.limit(patience_with(accuracy, options_.most_work).work);
  }

  void find(SteadyState& result);
  /// States the cost of all motions. Call it once, at the end.
  void account_for_cost(SteadyState& result) {
    add_cost(map_.engine());
    result.certificate = searched_;
    result.work = work_;
  }
  void describe(SteadyState& result);

 private:
  /// Of an engine or a solver that is used no more.
  template <class Counting>
  void add_cost(const Counting& counting) {
    searched_ += counting.count();
    work_ += counting.work();
  }
  [[nodiscard]] std::optional<State> start_of_sliding_orbit();
  [[nodiscard]] std::optional<Orbit> the_only_orbit(SteadyState& result);
  [[nodiscard]] std::optional<Orbit> only_orbit_from(const State& start, SteadyState& result);
  [[nodiscard]] State after_transient(double x, double v, SteadyState& result);
  [[nodiscard]] SteadyState outlined(const Orbit& orbit);
  [[nodiscard]] bool is_mirror_image(const SteadyState& a, const SteadyState& b) const;
  [[nodiscard]] std::optional<SteadyState> mirror_image(const SteadyState& of, OrbitSolver& solver);
  void add_mirror_images(SteadyState& result);
  void warn_of_steps(const Orbit& orbit, SteadyState& result);

  const Model& model_;
  SteadyStateOptions options_;
  PeriodMap map_;
  Motions motions_;
  /// At an end of the positions in which friction can hold the mass, where it slips by less than rounding. The
  /// motion may rest elsewhere, or approach this end for ever, by ever smaller slips.
  std::optional<Orbit> end_of_rest_;
  std::vector<SteadyState> others_;
  std::optional<OrbitAccount> account_;  ///< of the sliding orbit that Newton's method began on, if it stayed there
  core::SearchCount searched_;           ///< in addition to those of the engine
  long work_ = 0;                        ///< likewise, `Engine::work`
  double rounding_closure_ = 0.0;
  double error_ = 0.0;  ///< the largest one of the orbits (`error_of_orbit`)
};

/// The start of the orbit without sticking that attracts every motion, if batches find it: no motion is integrated.
std::optional<State> OrbitFinder::start_of_sliding_orbit() {
  const std::optional<SlidingOrbit> orbit = sliding_orbit(model_);
  if (!orbit) return std::nullopt;
  std::optional<State> start = start_of(*orbit, model_);
  if (!start) return std::nullopt;
  // Newton's method will accept this start at once, so its pass along the orbit can collect the account too.
  account_.emplace(model_, AccountParts{.detail = options_.detail});
  searched_ += orbit->certificate;
  work_ += orbit->certificate.work();
  return start;
}

State OrbitFinder::after_transient(double x, double v, SteadyState& result) {
  static_cast<void>(map_.from_start(x, v, Monodromy::without));
  result.transient_periods += 2;
  return map_.next(Monodromy::without).end;
}

std::optional<Orbit> OrbitFinder::only_orbit_from(const State& start, SteadyState& result) {
  const NewtonOptions newton{
      .omega = model_.excitation.frequency, .tolerance = options_.tolerance, .rounding = rounding_closure_};
  ForcingPeriod period = map_.from(start, Monodromy::with, account_ ? &*account_ : nullptr);
  const NewtonResult closed = close_orbit(map_, newton, period);
  result.newton_steps += closed.steps;
  result.transient_periods += closed.transient_periods;
  if (closed.steps > 0) account_.reset();
  if (closed.found && period.radius() < 1.0 - neutral_margin) return Orbit{std::move(period), 1};
  const bool only = motions_ == Motions::meet_sliding && period.moves;
  if (closed.found && only && correction_left(period, newton.omega) < known) {
    Orbit orbit{std::move(period), 1};
    if (!outlined(orbit).never_moves()) return orbit;
    end_of_rest_ = std::move(orbit);
  }
  account_.reset();
  return std::nullopt;
}

/// If motions never part, there is one orbit that attracts: Newton's method may start anywhere.
std::optional<Orbit> OrbitFinder::the_only_orbit(SteadyState& result) {
  State start;
  const InitialState& initial = model_.initial;
  if (motions_ == Motions::meet_sliding && ends_in_linear_response(model_)) {
    start = linear_response(model_);
  } else if (std::optional<State> sliding = start_of_sliding_orbit()) {
    start = *std::move(sliding);
  } else {
    start = after_transient(initial.position, initial.velocity, result);
  }
  std::optional<Orbit> orbit = only_orbit_from(start, result);
  // A motion that starts far away may need many periods to a place from which Newton's method finds the orbit.
  if (!orbit && motions_ == Motions::meet_sliding && (initial.position != 0.0 || initial.velocity != 0.0))
    orbit = only_orbit_from(after_transient(0.0, 0.0, result), result);
  return orbit;
}

void OrbitFinder::describe(SteadyState& result) {
  if (account_) return account_->write(result);
  map_.limit(std::numeric_limits<long>::max());
  const AccountParts parts{.detail = options_.detail, .sticks_by_speed = options_.sticks_by_speed};
  if (result.period_ratio == 1) {
    account_for_orbit(model_, map_, parts, result);
  } else {
    PeriodMap map(model_, result.period_ratio);
    account_for_orbit(model_, map, parts, result);
    add_cost(map.engine());
    result.warnings.emplace_back("subharmonic: the motion repeats itself after several forcing periods only");
  }
  if (options_.others) add_mirror_images(result);
  // If the mass never moves, other rest positions are not listed.
  if (result.never_moves()) std::erase_if(result.others, &OtherState::never_moves);
  if (!result.others.empty())
    result.warnings.emplace_back(
        "not the only steady state: the one that the motion approaches; others attract other motions");
}

SteadyState OrbitFinder::outlined(const Orbit& orbit) {
  PeriodMap map(model_, orbit.period_ratio);
  SteadyState state = outline_of_orbit(model_, map, orbit.period.begin, orbit.period_ratio);
  add_cost(map.engine());
  return state;
}

/// Whether the mass moves by less than steps of this accuracy resolve, although nothing holds it.
bool creeps_below_steps(const Model& model, const ForcingPeriod& period, double accuracy) {
  const auto holds = [](const friction::Law& law) { return law.holds_mass(); };
  return period.moves && std::ranges::none_of(model.friction, holds) &&
         is_below_steps(model, period.peak - period.trough, accuracy);
}

OtherState other_state(const SteadyState& state) { return {state.peak, state.trough, state.period_ratio}; }

/// Whether b is the mirror image of a in x = 0. Each of the four values may have the error of its orbit.
bool OrbitFinder::is_mirror_image(const SteadyState& a, const SteadyState& b) const {
  const double gap = std::abs(a.peak + b.trough) + std::abs(a.trough + b.peak);
  return gap <= std::max(image, 4.0 * error_) * 0.5 * (a.peak - a.trough);
}

/// Whether the drive half a forcing period later is its own mirror image, up to a constant force, which friction
/// may balance. No law makes up for harmonics of even order.
bool may_have_mirror_images(const Excitation& drive) {
  double odd = std::abs(drive.amplitude);
  double even = 0.0;
  for (const Harmonic& harmonic : drive.harmonics) {
    double& sum = harmonic.order % 2 == 0 ? even : odd;
    sum += std::abs(harmonic.amplitude);
  }
  return even <= image * odd;
}

/// The mirror image, half a forcing period later. Every symmetric model has it; whether this one does, the motion
/// that begins there tells. The laws begin anew there, which may lead to another orbit. A subharmonic motion has
/// such a place in each of its forcing periods.
std::optional<SteadyState> OrbitFinder::mirror_image(const SteadyState& of, OrbitSolver& solver) {
  const std::vector<Sample> halves = one_period(model_, of, 2 * of.period_ratio);
  for (std::size_t i = 1; i < halves.size(); i += 2) {
    const State later = solver.map_over(1).from_start(-halves[i].x, -halves[i].v, Monodromy::without).end;
    const std::optional<Orbit> found =
        of.period_ratio == 1 ? solver.near_motion_from(later) : solver.near(later, of.period_ratio);
    if (!found) continue;
    SteadyState other = outlined(*found);
    if (is_mirror_image(other, of)) return other;
  }
  return std::nullopt;
}

void OrbitFinder::add_mirror_images(SteadyState& result) {
  if (motions_ != Motions::may_part || map_.engine().has_past() || !may_have_mirror_images(model_.excitation))
    return;
  OrbitSolver solver(model_, options_.tolerance, rounding_closure_);
  solver.limit(patience_with(map_.engine().accuracy(), options_.most_work).work);
  std::vector<SteadyState> states = others_;
  states.insert(states.begin(), result);
  const std::size_t count = states.size();
  for (std::size_t i = 0; i < count; ++i) {
    const SteadyState of = states[i];
    if (of.never_moves() || is_mirror_image(of, of)) continue;
    if (std::ranges::none_of(states, [&](const SteadyState& a) { return is_mirror_image(a, of); })) {
      std::optional<SteadyState> other = mirror_image(of, solver);
      if (!other) continue;
      result.others.push_back(other_state(*other));
      states.push_back(std::move(*other));
    }
    if (i == 0) result.warnings.emplace_back("asymmetric: the mirror image of this steady state is another one");
  }
  add_cost(solver);
}

void OrbitFinder::warn_of_steps(const Orbit& orbit, SteadyState& result) {
  const bool is_exact = map_.engine().accuracy() == 0.0;
  // One of many points of a curve: a second period for each would double its cost.
  const bool is_outline = options_.detail == OrbitDetail::extremes && orbit.period_ratio == 1;
  if (is_exact || !orbit.period.moves || is_outline) return;
  PeriodMap other(with_other_steps(model_), orbit.period_ratio);
  other.limit(patience_with(other.engine().accuracy(), options_.most_work).work);
  sim::warn_of_steps(orbit.period, other, model_, result);
  add_cost(other.engine());
}

void OrbitFinder::find(SteadyState& result) {
  std::optional<Orbit> orbit;
  // Newton's method cannot change the state of a motion that depends on its past.
  const bool has_past = map_.engine().has_past();
  if (motions_ != Motions::may_part && !has_past) orbit = the_only_orbit(result);
  if (!orbit) {
    OrbitSolver solver(model_, options_.tolerance, rounding_closure_);
    Approach approach(model_, options_, map_, solver, motions_);
    orbit = approach.find(result);
    if (!orbit && end_of_rest_) {
      orbit = std::move(end_of_rest_);
      result.outcome = {};
    }
    if (orbit && motions_ == Motions::may_part && !has_past && options_.others) {
      error_ = solver.error(*orbit);
      for (const Orbit& other : other_orbits(model_, *orbit, approach.others(), solver)) {
        error_ = std::max(error_, solver.error(other));
        others_.push_back(outlined(other));
      }
    }
    result.newton_steps += solver.newton_steps();
    add_cost(solver);
  }
  if (!orbit) return;
  if (creeps_below_steps(model_, orbit->period, map_.engine().accuracy())) {
    result.outcome = {core::OutcomeKind::no_steady_state,
                      "no steady state found: the mass moves by less than steps resolve"};
    return;
  }
  for (const SteadyState& other : others_) result.others.push_back(other_state(other));
  result.period_ratio = orbit->period_ratio;
  result.period *= orbit->period_ratio;
  result.start = orbit->period.begin;
  if (has_past) return;
  result.multipliers = orbit->period.multipliers();
  warn_of_distance(orbit->period, options_.tolerance, map_.engine().accuracy(), model_.excitation.frequency,
                   result);
  warn_of_steps(*orbit, result);
}

/// That of the model without its laws, which never have a force: a mass at rest would seem to stick by them.
SteadyState without_laws(const Model& model, const SteadyStateOptions& options) {
  Model bare = model;
  bare.friction.clear();
  SteadyStateOptions of_bare = options;
  if (of_bare.from) of_bare.from->memories.clear();
  SteadyState result = steady_state(bare, of_bare);
  for (const friction::Law& law : model.friction) result.start.memories.push_back(law.start({}));
  return result;
}

}  // namespace

bool SteadyState::stable() const {
  return std::all_of(multipliers.begin(), multipliers.end(),
                     [](const std::complex<double>& value) { return std::abs(value) < 1.0 + on_circle; });
}

SteadyState steady_state(const Model& model, const SteadyStateOptions& options) {
  valid_harmonic(model, "steady_state");
  if (model.oscillator.loss_factor != 0.0) return steady_state(with_viscous_equivalent(model), options);
  SteadyState result;
  result.period = core::two_pi / model.excitation.frequency;
  for (const friction::Law& law : model.friction) {
    if (law.aperiodic().empty()) continue;
    result.outcome = {core::OutcomeKind::no_steady_state, "no steady state: " + std::string(law.aperiodic())};
    return result;
  }
  const bool has_idle_laws = !model.friction.empty() && std::ranges::all_of(model.friction, is_idle);
  if (has_idle_laws && is_undriven(model.excitation)) return without_laws(model, options);
  OrbitFinder finder(model, options);
  finder.find(result);
  if (result.outcome.ok()) finder.describe(result);
  finder.account_for_cost(result);
  return result;
}

std::vector<Sample> one_period(const Model& model, const SteadyState& state, int count) {
  valid_harmonic(model, "one_period");
  if (model.oscillator.loss_factor != 0.0) return one_period(with_viscous_equivalent(model), state, count);
  require(count > 0 && state.period > 0.0 && state.start.memories.size() == model.friction.size(),
          "one period needs a steady state of the same model and a number of samples", "steady_state(model), > 0");
  const std::unique_ptr<Engine> engine = make_engine(model);
  engine->restart(state.start);
  Sampler sampler(count / state.period);
  Sample final;
  while (engine->periods_passed() < state.period_ratio) {
    const Interval* interval = engine->next_in_period();
    if (interval == nullptr) break;
    sampler.observe(*interval);
    final = interval->at(interval->duration);
  }
  sampler.finish(final);
  if (state.never_moves())  // slips below rounding are no motion
    for (Sample& sample : sampler.samples()) sample.x = state.peak, sample.v = sample.a = 0.0;
  return std::move(sampler.samples());
}

}  // namespace dualdamp::sim
