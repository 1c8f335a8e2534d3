#include "sim/curves/sticking_boundary.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sim/analytic/den_hartog.hpp"
#include "sim/engine/drive.hpp"
#include "sim/orbits/steady_state.hpp"
#include "sim/parallel.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

using friction::Direction;

namespace {

constexpr double precision = 1e-12;      // relative to the amplitude
constexpr double close = 1e-10;          // likewise
constexpr int patience_if_close = 1000;  // forcing periods
constexpr int max_doublings = 60;
constexpr int most_unknown = 3;     // amplitudes without a steady state in a row
constexpr int scan_steps = 32;      // in a factor of two of the amplitude
constexpr int deepest_moving = 10;  // halvings below break-away to which a mass that still moves is scanned
constexpr int blind_doublings = 5;  // above break-away, if no doubled amplitude slides
constexpr int most_failures = 8;    // amplitudes without a steady state: each may take seconds
constexpr const char* always_sticks = "the mass sticks at every amplitude";
constexpr const char* always_slides = "even the weakest drive moves the mass without a stick";

/// Force limits of all laws together at the start [N].
struct ForceLimits {
  double kinetic = 0.0;
  double holding = 0.0;
  bool coulomb = true;  ///< each law is Coulomb friction, the same in both directions
};

bool is_coulomb(const friction::Law& law, const friction::Memory& memory) {
  if (law.has_memory()) return false;
  const double kinetic = law.force(memory, {}, Direction::forward);
  return law.force(memory, {.x = 1.0, .v = 1.0}, Direction::forward) == kinetic &&
         law.force(memory, {.v = -1.0}, Direction::backward) == -kinetic &&
         law.force(memory, {}, Direction::none) == 0.0;
}

ForceLimits limits_of(const Model& model) {
  ForceLimits limits;
  for (const friction::Law& law : model.friction) {
    const friction::Memory memory = law.start({});
    limits.kinetic += law.force(memory, {}, Direction::forward);
    limits.holding += law.static_limit(memory, {});
    limits.coulomb = limits.coulomb && is_coulomb(law, memory);
  }
  return limits;
}

/// Whether one amplitude divides sticking from sliding: under Coulomb friction, viscous or structural damping and
/// one harmonic there is one motion, and it slides the better the larger the drive.
bool has_one_boundary(const Model& model, const ForceLimits& limits) {
  const Oscillator& o = model.oscillator;
  const Excitation& drive = model.excitation;
  return is_linear(o) && o.damping >= 0.0 && limits.coulomb && limits.kinetic == limits.holding &&
         drive.is_harmonic() && drive.harmonics.empty() && drive.offset == 0.0;
}

/// Nothing if the model is not Den Hartog's oscillator. A driving force acts as a base that moves by force/k.
std::optional<double> den_hartogs(const Model& model, const ForceLimits& limits) {
  const Oscillator& o = model.oscillator;
  const bool is_force = model.excitation.type == ExcitationType::force_harmonic;
  const bool his =
      has_one_boundary(model, limits) && o.loss_factor == 0.0 && (is_force || o.damper_to == DamperTo::ground);
  if (!his) return std::nullopt;
  const double zeta = damping_ratio(o);
  const double r = model.excitation.frequency / natural_frequency(o);
  const double force = limits.kinetic / analytic::non_sticking_boundary(analytic::den_hartog(zeta, r));
  return is_force ? force : force / o.stiffness;
}

/// Steady states of one model by amplitude, up to a limit of their total work.
class States {
 public:
  States(Model model, long most_work) : model_(std::move(model)), most_work_(most_work) {}

  SteadyState at(double amplitude, int max_periods = SteadyStateOptions{}.max_periods) {
    if (is_exhausted()) {
      SteadyState none;
      none.outcome = too_long();
      return none;
    }
    model_.excitation.amplitude = amplitude;
    SteadyState state = steady_state(model_, {.max_periods = max_periods,
                                              .most_work = most_work_ - work_,
                                              .detail = OrbitDetail::extremes,
                                              .others = false});
    work_ += state.work;
    return state;
  }

  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] long work() const { return work_; }
  [[nodiscard]] bool is_exhausted() const { return work_ >= most_work_; }
  /// Whether so little is left that a scan must leave it to the bisection.
  [[nodiscard]] bool ends_scan() const { return work_ >= most_work_ / 4 * 3; }
  [[nodiscard]] bool is_stopped() const { return is_stopped_; }
  [[nodiscard]] core::Outcome too_long() {
    is_stopped_ = true;
    return {core::OutcomeKind::event_limit,
            "the search for the boundary was stopped: its steady states take too long to compute"};
  }

 private:
  Model model_;
  long most_work_;
  long work_ = 0;
  bool is_stopped_ = false;
};

bool sticks(const SteadyState& state) { return !state.sticks.empty(); }

/// Where the direct search begins: the amplitude whose spring or drive force equals the friction. No bound: a
/// damper to the base moves the mass at less.
double first_amplitude(const Model& model, const ForceLimits& limits) {
  const bool base = model.excitation.type == ExcitationType::base_harmonic;
  return limits.holding / (base ? model.oscillator.stiffness : 1.0);
}

/// Two amplitudes with the boundary between them.
struct Bracket {
  double low = 0.0;   ///< the mass sticks
  double high = 0.0;  ///< it does not
  SteadyState above;  ///< at `high`
};

/// The steady state at `amplitude`, or at the next of the amplitudes `factor` apart that has one.
SteadyState next_known(States& states, double& amplitude, double factor) {
  SteadyState state = states.at(amplitude);
  for (int i = 0; i < most_unknown && !state.outcome.ok(); ++i) {
    SteadyState next = states.at(amplitude * std::pow(factor, i + 1));
    if (!next.outcome.ok()) continue;
    amplitude *= std::pow(factor, i + 1);
    return next;
  }
  return state;
}

/// Doubles the amplitude while the mass sticks, or halves it while the mass does not. Amplitudes without a steady
/// state are passed over.
core::Outcome bracket(States& states, double amplitude, Bracket& found) {
  SteadyState state = next_known(states, amplitude, 2.0);
  const bool up = sticks(state);
  for (int i = 0; i < max_doublings && state.outcome.ok(); ++i) {
    if (sticks(state)) {
      found.low = amplitude;
    } else {
      found.high = amplitude;
      found.above = state;
    }
    if (sticks(state) != up) return {};
    amplitude *= up ? 2.0 : 0.5;
    state = next_known(states, amplitude, up ? 2.0 : 0.5);
  }
  if (!state.outcome.ok()) return state.outcome;
  return {core::OutcomeKind::no_steady_state, up ? always_sticks : always_slides};
}

/// Halves the bracket. Where a steady state at its middle is not found, one beside the middle will do. Motions may
/// approach their orbits ever more slowly towards the boundary: a bracket that is `close` is not worth waiting for.
core::Outcome narrow(States& states, Bracket& found) {
  constexpr std::array<double, 3> places = {0.5, 0.4, 0.6};
  while (found.high - found.low > precision * found.high) {
    const bool is_close = found.high - found.low <= close * found.high;
    core::Outcome outcome;
    for (const double place : places) {
      const double amplitude = found.low + place * (found.high - found.low);
      SteadyState state = is_close ? states.at(amplitude, patience_if_close) : states.at(amplitude);
      outcome = state.outcome;
      if (!outcome.ok() && is_close) return {};
      if (!outcome.ok()) continue;
      if (sticks(state)) {
        found.low = amplitude;
      } else {
        found.high = amplitude;
        found.above = std::move(state);
      }
      break;
    }
    if (!outcome.ok()) return outcome;
  }
  return {};
}

/// Looks at amplitudes from where the mass first moves upwards, for models of which several amplitudes may divide
/// sticking from sliding.
class Scan {
 public:
  Scan(States& states, std::span<const double> asked, BoundaryPoint& point)
      : states_(states), asked_(asked), point_(point) {}

  /// The first change from sticking to sliding among the amplitudes that are looked at.
  core::Outcome bracket(const ForceLimits& limits, Bracket& found);

 private:
  enum class Motion { none, rest, sticks, slides };

  Motion motion_at(double amplitude);
  [[nodiscard]] double break_away(const ForceLimits& limits) const;
  std::optional<double> bottom_below(double amplitude);
  double top_above(double amplitude, Bracket& found);
  [[nodiscard]] std::vector<double> between(double bottom, double top) const;
  [[nodiscard]] bool gives_up() const { return failures_ >= most_failures || states_.ends_scan(); }

  States& states_;
  std::span<const double> asked_;
  BoundaryPoint& point_;
  SteadyState state_;      ///< the last one
  core::Outcome failure_;  ///< of the first amplitude without a steady state
  int failures_ = 0;
};

Scan::Motion Scan::motion_at(double amplitude) {
  state_ = states_.at(amplitude);
  if (!state_.outcome.ok()) {
    if (failures_++ == 0) failure_ = state_.outcome;
    return Motion::none;
  }
  if (!sticks(state_)) return Motion::slides;
  return state_.never_moves() ? Motion::rest : Motion::sticks;
}

/// The amplitude whose force equals the friction, if there are neither harmonics nor an offset. A law without force
/// at the start (free play) says nothing: then the largest amplitude that is asked for, or that of the model.
double Scan::break_away(const ForceLimits& limits) const {
  const Model& model = states_.model();
  Excitation unit = model.excitation;
  unit.harmonics.clear();
  unit.amplitude = 1.0;
  const double force = limits.holding > 0.0 ? limits.holding : limits.kinetic;
  if (force > 0.0) return force / std::abs(Drive(model.oscillator, unit).force_phasor(0));
  const double asked = asked_.empty() ? model.excitation.amplitude : std::ranges::max(asked_);
  return asked > 0.0 ? asked : 1.0;
}

/// An amplitude at which the mass never moves, or a small one at which it moves and sticks. None: the weakest drive
/// moves it without a stick.
std::optional<double> Scan::bottom_below(double amplitude) {
  for (int i = 0; i < max_doublings && !gives_up(); ++i, amplitude *= 0.5) {
    const Motion motion = motion_at(amplitude);
    if (motion == Motion::rest || (motion == Motion::sticks && i >= deepest_moving)) return amplitude;
  }
  return std::nullopt;
}

/// The first doubled amplitude that slides, with its state in `found`; an amplitude above break-away if none does.
double Scan::top_above(double amplitude, Bracket& found) {
  const double blind = std::ldexp(amplitude, blind_doublings);
  for (int i = 0; i < max_doublings && !gives_up(); ++i, amplitude *= 2.0) {
    if (motion_at(amplitude) != Motion::slides) continue;
    found.high = amplitude;
    found.above = std::move(state_);
    return amplitude;
  }
  return blind;
}

/// The amplitudes to look at, upwards: those of the scan and those that are asked for.
std::vector<double> Scan::between(double bottom, double top) const {
  std::vector<double> list;
  for (int i = 0; list.empty() || list.back() < top; ++i)
    list.push_back(bottom * std::exp2(i / double{scan_steps}));
  list.back() = top;
  std::ranges::copy_if(asked_, std::back_inserter(list), [&](double amplitude) { return amplitude > bottom; });
  std::ranges::sort(list);
  list.erase(std::ranges::unique(list).begin(), list.end());
  return list;
}

core::Outcome Scan::bracket(const ForceLimits& limits, Bracket& found) {
  const double begin = break_away(limits);
  const std::optional<double> bottom = bottom_below(begin);
  if (states_.ends_scan()) return states_.too_long();
  if (!bottom && gives_up()) return failure_;
  if (!bottom) return {core::OutcomeKind::no_steady_state, always_slides};
  const double top = top_above(begin, found);
  found.low = *bottom;
  failures_ = 0;  // those of the scan itself
  bool is_below = true;
  double seen = *bottom;
  for (const double amplitude : between(*bottom, top)) {
    if (states_.ends_scan()) {
      if (is_below) return states_.too_long();
      point_.seen_up_to = seen;
      break;
    }
    if (gives_up()) break;
    seen = amplitude;
    const Motion motion = motion_at(amplitude);
    if (motion == Motion::none) {
      point_.unknown_below += is_below ? 1 : 0;
    } else if (motion == Motion::slides) {
      if (!is_below) continue;
      is_below = false;
      found.high = amplitude;
      found.above = std::move(state_);
    } else if (is_below) {
      found.low = amplitude;
    } else {
      if (!point_.sticks_again) point_.sticks_again = {amplitude, amplitude};
      point_.sticks_again->second = amplitude;
    }
  }
  if (found.high > 0.0) return {};
  if (!failure_.ok()) return failure_;
  return {core::OutcomeKind::no_steady_state, always_sticks};
}

BoundaryPoint find(Model model, const ForceLimits& limits, double omega, std::span<const double> asked,
                   long most_work) {
  model.excitation.frequency = omega;
  BoundaryPoint point{.omega = omega};
  if (std::ranges::none_of(model.friction, &friction::Law::holds_mass)) {
    point.outcome = {core::OutcomeKind::no_steady_state, always_slides};
    return point;
  }
  States states(model, most_work);
  Bracket found;
  point.outcome = has_one_boundary(model, limits) ? bracket(states, first_amplitude(model, limits), found)
                                                  : Scan(states, asked, point).bracket(limits, found);
  if (point.outcome.ok()) point.outcome = narrow(states, found);
  point.amplitude = found.high;
  point.sticks = found.low;
  point.slides = found.high;
  point.x = found.above.amplitude;
  point.work = states.work();
  point.is_stopped = !point.outcome.ok() && states.is_stopped();
  if (point.outcome.ok()) point.closed_form = den_hartogs(model, limits);
  return point;
}

/// The model with a valid frequency and amplitude, in place of those that are set later.
Model driven(Model model) {
  model.excitation.frequency = 1.0;
  model.excitation.amplitude = 0.0;
  return model;
}

}  // namespace

std::vector<BoundaryPoint> sticking_boundary(const Model& model, std::span<const double> frequencies,
                                             std::span<const double> amplitudes, long most_work) {
  require_in(friction::positive, "analysis.frequencies", frequencies, "rad/s");
  const ForceLimits limits = limits_of(valid_harmonic(driven(model), "sticking_boundary"));
  std::vector<BoundaryPoint> boundary(frequencies.size());
  in_parts(frequencies.size(), 1, 0, [&](std::size_t first, std::size_t count) {
    for (std::size_t i = first; i < first + count; ++i)
      boundary[i] = find(model, limits, frequencies[i], amplitudes, most_work);
  });
  return boundary;
}

}  // namespace dualdamp::sim
