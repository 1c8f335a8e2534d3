#include "sim/orbits/sticking_boundary.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "sim/analytic/den_hartog.hpp"
#include "sim/orbits/steady_state.hpp"
#include "sim/validate.hpp"

namespace dualdamp::sim {

using friction::Direction;

namespace {

constexpr double precision = 1e-12;
constexpr double close = 1e-10;          // likewise relative to the amplitude
constexpr int patience_if_close = 1000;  // forcing periods
constexpr int max_doublings = 60;
constexpr int most_unknown = 3;  // amplitudes without a steady state in a row

/// Force limits of all laws together at the start [N].
struct ForceLimits {
  double kinetic = 0.0;
  double holding = 0.0;
  bool coulomb = true;  ///< each law is Coulomb friction, the same in both directions
};

bool is_coulomb(const friction::Law& law, const friction::Memory& memory) {
  if (law.is_modal()) return false;
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

/// Nothing if the model is not Den Hartog's oscillator. A driving force acts as a base that moves by force/k.
std::optional<double> den_hartogs(const Model& model, const ForceLimits& limits) {
  const Oscillator& o = model.oscillator;
  const Excitation& drive = model.excitation;
  const bool is_force = drive.type == ExcitationType::force_harmonic;
  const bool his = is_linear(o) && o.damping >= 0.0 && o.loss_factor == 0.0 && limits.coulomb &&
                   limits.kinetic == limits.holding && (is_force || o.damper_to == DamperTo::ground) &&
                   drive.is_harmonic() && drive.harmonics.empty() && drive.offset == 0.0;
  if (!his) return std::nullopt;
  const double zeta = o.damping / (2.0 * std::sqrt(o.mass * o.stiffness));
  const double r = drive.frequency / natural_frequency(o);
  const double force = limits.kinetic / analytic::non_sticking_boundary(analytic::den_hartog(zeta, r));
  return is_force ? force : force / o.stiffness;
}

SteadyState at(Model& model, double amplitude, int max_periods = SteadyStateOptions{}.max_periods) {
  model.excitation.amplitude = amplitude;
  return steady_state(model, {.max_periods = max_periods, .full_account = false});
}

bool sticks(const SteadyState& state) { return !state.sticks.empty(); }

/// Where the search begins: the amplitude whose spring or drive force equals the friction. No bound: a damper to
/// the base, harmonics or an offset move the mass at less. A law without force at the start (free play) says
/// nothing.
double first_amplitude(const Model& model, const ForceLimits& limits) {
  const bool base = model.excitation.type == ExcitationType::base_harmonic;
  const double force = limits.holding > 0.0 ? limits.holding : limits.kinetic;
  if (force > 0.0) return force / (base ? model.oscillator.stiffness : 1.0);
  return model.excitation.amplitude > 0.0 ? model.excitation.amplitude : 1.0;
}

/// Two amplitudes with the boundary between them.
struct Bracket {
  double low = 0.0;   ///< the mass sticks
  double high = 0.0;  ///< it does not
  SteadyState above;  ///< at `high`
};

/// The steady state at `amplitude`, or at the next of the amplitudes `factor` apart that has one.
SteadyState next_known(Model& model, double& amplitude, double factor) {
  SteadyState state = at(model, amplitude);
  for (int i = 0; i < most_unknown && !state.outcome.ok(); ++i) {
    SteadyState next = at(model, amplitude * std::pow(factor, i + 1));
    if (!next.outcome.ok()) continue;
    amplitude *= std::pow(factor, i + 1);
    return next;
  }
  return state;
}

/// Doubles the amplitude while the mass sticks, or halves it while the mass does not. Amplitudes without a steady
/// state are passed over.
core::Outcome bracket(Model& model, double amplitude, Bracket& found) {
  SteadyState state = next_known(model, amplitude, 2.0);
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
    state = next_known(model, amplitude, up ? 2.0 : 0.5);
  }
  if (!state.outcome.ok()) return state.outcome;
  return {core::OutcomeKind::no_steady_state,
          up ? "the mass sticks at every amplitude" : "even the weakest drive moves the mass without a stick"};
}

/// Halves the bracket. Where a steady state at its middle is not found, one beside the middle will do. Motions may
/// approach their orbits ever more slowly towards the boundary: a bracket that is `close` is not worth waiting for.
core::Outcome narrow(Model& model, Bracket& found) {
  constexpr std::array<double, 3> places = {0.5, 0.4, 0.6};
  while (found.high - found.low > precision * found.high) {
    const bool is_close = found.high - found.low <= close * found.high;
    core::Outcome outcome;
    for (const double place : places) {
      const double amplitude = found.low + place * (found.high - found.low);
      SteadyState state = is_close ? at(model, amplitude, patience_if_close) : at(model, amplitude);
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

BoundaryPoint find(Model model, const ForceLimits& limits, double omega) {
  model.excitation.frequency = omega;
  BoundaryPoint point{.omega = omega};
  Bracket found;
  point.outcome = bracket(model, first_amplitude(model, limits), found);
  if (point.outcome.ok()) point.outcome = narrow(model, found);
  point.amplitude = found.high;
  point.sticks = found.low;
  point.slides = found.high;
  point.x = found.above.amplitude;
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

std::vector<BoundaryPoint> sticking_boundary(const Model& model, std::span<const double> frequencies) {
  require_in(friction::positive, "analysis.frequencies", frequencies, "rad/s");
  const ForceLimits limits = limits_of(valid_harmonic(driven(model), "sticking_boundary"));
  std::vector<BoundaryPoint> boundary;
  for (const double omega : frequencies) boundary.push_back(find(model, limits, omega));
  return boundary;
}

}  // namespace dualdamp::sim
